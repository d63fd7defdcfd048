#include "boundary_integral/modes/noise_ensemble.h"

#include <cmath>

#include "boundary_integral/evolution/observation.h"
#include "boundary_integral/modes/thermal_noise.h"
#include "boundary_integral/support/parallel.h"

namespace endoflow::boundary_integral {

namespace {

constexpr double member_tolerance = 1e-3;  // of a step, nm: a thousandth of what fluctuates

}  // namespace

NoiseEnsemble::NoiseEnsemble(const AlongRun& run, double temperature, unsigned int seed) : run_(run), random_(seed) {
    const MembraneSpace& membrane = run.dynamics().space();
    const MembraneState start = run.dynamics().unpack(run.trajectory().state(0.0));
    const BasePoints flat = base_points(membrane, flat_bare_membrane(membrane, start, run.parameters()),
                                        membrane_energy(run.parameters()), run.surroundings().viscosities());
    const ModeSpace& space = run.surroundings().space(0);
    const double upwards = flat.points.front().curve.normal_z;
    root_ = upwards * displacement_values(space, membrane.axial().greville_points()) *
            equilibrium_root(space, flat, boltzmann_constant * temperature);
}

Eigen::VectorXd NoiseEnsemble::random_start() {
    const MembraneDynamics& dynamics = run_.dynamics();
    MembraneState state = dynamics.unpack(run_.trajectory().state(0.0));
    Eigen::VectorXd numbers(root_.cols());
    for (double& number : numbers) number = normal_(random_);
    const Eigen::VectorXd heights = root_ * numbers;
    state.z += Interpolation(dynamics.space().axial())({heights.begin(), heights.end()});
    return dynamics.packed(state);
}

void NoiseEnsemble::add(std::size_t members, const std::vector<double>& times) {
    std::vector<Eigen::VectorXd> starts;
    for (std::size_t i = 0; i < members; ++i) starts.push_back(random_start());
    const std::size_t before = this->members();
    heights_.resize(before + members);
    necks_.resize(before + members);
    const MembraneDynamics& dynamics = run_.dynamics();
    const MembraneSpace& space = dynamics.space();
    const int threads = thread_count(run_.parameters().boundary_integral.threads);
    parallel_parts(static_cast<Index>(members), threads, [&](Index begin, Index end) {
        for (Index i = begin; i < end; ++i) {
            const auto member = static_cast<std::size_t>(i);
            const BaseTrajectory trajectory(dynamics, run_.parameters(),
                                            {starts[member], times.back(), member_tolerance});
            for (const double time : times) {
                const MembraneState state = dynamics.unpack(trajectory.state(time));
                heights_[before + member].push_back(space.axial().basis(0.0).evaluate(state.z) -
                                                    run_.parameters().domain.membrane_height);
                necks_[before + member].push_back(neck_radius(find_neck(space, state)));
            }
        }
    });
}

SampleSpread NoiseEnsemble::spread(const Table& values, std::size_t time) {
    double sum = 0.0, squares = 0.0;
    for (const auto& row : values) sum += row[time];
    const auto count = static_cast<double>(values.size());
    const double mean = sum / count;
    for (const auto& row : values) squares += std::pow(row[time] - mean, 2);
    return {mean, std::sqrt(squares / (count - 1.0))};
}

}  // namespace endoflow::boundary_integral
