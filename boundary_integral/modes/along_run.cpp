#include "boundary_integral/modes/along_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "boundary_integral/support/parallel.h"
#include "shared/support/error.h"

namespace endoflow::boundary_integral {

namespace {

constexpr double step_error = 1e-6;        // nm, and of the concentration
constexpr double largest_distance = 0.25;  // nm; a run's own error at the default tolerance is some 0.01 nm
constexpr Index pieces_per_element = 8;

double distance_to_segment(double r, double z, const CurvePoint& a, const CurvePoint& b) {
    const double dr = b.r - a.r, dz = b.z - a.z;
    const double part = std::clamp(((r - a.r) * dr + (z - a.z) * dz) / (dr * dr + dz * dz), 0.0, 1.0);
    return std::hypot(r - a.r - part * dr, z - a.z - part * dz);
}

// Largest distance of a shape's points from the curve.
double farthest(const RecordedShape& shape, const MembraneSpace& space, const MembraneState& state) {
    std::vector<CurvePoint> curve;
    const Index count = pieces_per_element * space.elements();
    for (Index i = 0; i <= count; ++i) {
        const double xi = static_cast<double>(i) / static_cast<double>(count);
        curve.push_back(curve_point(space.radial().basis(xi), space.axial().basis(xi), state));
    }
    double largest = 0.0;
    for (std::size_t i = 0; i < shape.r.size(); ++i) {
        double closest = 1e300;
        for (std::size_t k = 1; k < curve.size(); ++k) {
            closest = std::min(closest, distance_to_segment(shape.r[i], shape.z[i], curve[k - 1], curve[k]));
        }
        largest = std::max(largest, closest);
    }
    return largest;
}

}  // namespace

AlongRun::AlongRun(const RecordedRun& run, int first_mode, int last_mode)
    : parameters_(run.parameters()),
      first_mode_(first_mode),
      dynamics_(parameters_),
      surroundings_(parameters_, dynamics_.space(), last_mode),
      trajectory_(dynamics_, parameters_, {dynamics_.initial_vector(), run.times().back(), step_error}) {
    for (std::size_t i = 0; i < run.times().size(); ++i) {
        const double time = run.times()[i];
        const double distance = farthest(run.shape(i), dynamics_.space(), dynamics_.unpack(trajectory_.state(time)));
        if (!(distance <= largest_distance)) {
            throw SolverError(
                "modes-off-the-run",
                fmt::format("the shape at t = {:.6g} µs is {:.3g} nm away from the motion of its case", time, distance),
                "repeat the run with more elements or a smaller time.tolerance");
        }
        distance_ = std::max(distance_, distance);
    }
}

void AlongRun::for_modes(int first_mode, const std::function<void(int mode, std::size_t index)>& work) const {
    const int threads = thread_count(parameters_.boundary_integral.threads);
    parallel_parts(last_mode() - first_mode + 1, threads, [&](Index begin, Index end) {
        for (Index k = begin; k < end; ++k) work(first_mode + static_cast<int>(k), static_cast<std::size_t>(k));
    });
}

Moment AlongRun::moment(double time, int first_mode) const {
    Moment result{time, first_mode, dynamics_.evaluate(time, trajectory_.state(time)), nullptr, {}};
    result.membrane =
        std::make_unique<LinearisedMembrane>(parameters_, surroundings_, base_state(dynamics_, result.evaluation));
    result.rates.resize(static_cast<std::size_t>(last_mode() - first_mode) + 1);
    for_modes(first_mode, [&](int mode, std::size_t k) { result.rates[k] = result.membrane->rates(mode); });
    return result;
}

std::vector<LinearRate> AlongRun::mesh_rates(const Moment& moment) const {
    std::vector<LinearRate> result(moment.rates.size());
    for_modes(moment.first_mode, [&](int mode, std::size_t k) {
        result[k] = mesh_rate(*moment.membrane, surroundings_.space(mode), moment.rates[k],
                              moment.evaluation.relative_velocity, parameters_.molecules.interface_width);
    });
    return result;
}

}  // namespace endoflow::boundary_integral
