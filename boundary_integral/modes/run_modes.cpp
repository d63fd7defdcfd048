#include "boundary_integral/modes/run_modes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "boundary_integral/evolution/membrane_dynamics.h"
#include "boundary_integral/modes/engine_state.h"
#include "boundary_integral/modes/linearised_membrane.h"
#include "boundary_integral/modes/recorded_run.h"
#include "boundary_integral/modes/spectrum.h"
#include "shared/output/atomic_file.h"
#include "shared/output/hdf5_file.h"
#include "shared/support/error.h"

namespace endoflow::boundary_integral {

namespace {

constexpr std::size_t fastest = 3;       // of each mode at each time
constexpr Index points_per_element = 8;  // of eigenshapes, as of the run's shapes

/// Indices of the shapes nearest to `count` times that are evenly spread from the first shape's to the last one's.
std::vector<std::size_t> chosen(const std::vector<double>& times, std::size_t count) {
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < count; ++i) {
        const double part = count == 1 ? 1.0 : static_cast<double>(i) / static_cast<double>(count - 1);
        const double wanted = times.front() + part * (times.back() - times.front());
        const auto nearest =
            std::ranges::min_element(times, {}, [wanted](double time) { return std::abs(time - wanted); });
        const auto index = static_cast<std::size_t>(nearest - times.begin());
        if (result.empty() || result.back() != index) result.push_back(index);
    }
    return result;
}

class Analysis {
  public:
    Analysis(const ModesRequest& request, const std::function<void(const std::string&)>& progress)
        : request_(request),
          progress_(progress),
          run_(request.run),
          dynamics_(run_.parameters()),
          surroundings_(run_.parameters(), dynamics_.space(), request.last_mode),
          shapes_(request.directory / "eigenshapes.h5", Hdf5File::Mode::create) {
        shapes_.create_group("/times");
    }

    void execute() {
        std::size_t number = 0;
        for (const std::size_t index : chosen(run_.times(), request_.times)) {
            time_ = run_.times()[index];
            const MembraneState state = run_.state(dynamics_.space(), index);
            const Evaluation e = dynamics_.evaluate(state_vector(dynamics_, state));
            const LinearisedMembrane membrane(run_.parameters(), surroundings_, engine_state(dynamics_, e));
            group_ = fmt::format("/times/{:06d}", number++);
            shapes_.create_group(group_);
            shapes_.write_attribute(group_, "time", time_);
            write_base(membrane);
            std::string line = fmt::format("t = {:.6g} µs   growth, 1/µs:", time_);
            for (int mode = request_.first_mode; mode <= request_.last_mode; ++mode) {
                line += fmt::format("  {}: {:.4g}", mode, treat(mode, membrane));
            }
            progress_(line);
        }
        shapes_.flush();
        write_file_atomically(request_.directory / "modes.csv", spectrum_);
    }

  private:
    const ModesRequest& request_;
    const std::function<void(const std::string&)>& progress_;
    RecordedRun run_;
    MembraneDynamics dynamics_;
    Surroundings surroundings_;
    Hdf5File shapes_;
    double time_ = 0.0;
    std::string group_;
    std::string spectrum_ = "time_us,mode,rank,growth_per_us,frequency_rad_per_us,peak_r_nm,peak_z_nm\n";

    [[nodiscard]] std::vector<double> points() const {
        const Index count = points_per_element * dynamics_.space().elements();
        std::vector<double> result;
        for (Index i = 0; i <= count; ++i) result.push_back(static_cast<double>(i) / static_cast<double>(count));
        return result;
    }

    void write_base(const LinearisedMembrane& membrane) {
        std::vector<double> r, z, n_r, n_z, c;
        for (const double xi : points()) {
            const BasePoint p = base_point(dynamics_.space(), membrane.base(), surroundings_.viscosities(), xi);
            r.push_back(xi == 0.0 ? 0.0 : p.curve.r);
            z.push_back(p.curve.z);
            n_r.push_back(p.curve.normal_r);
            n_z.push_back(p.curve.normal_z);
            c.push_back(p.c);
        }
        shapes_.write_array(group_ + "/r", r);
        shapes_.write_array(group_ + "/z", z);
        shapes_.write_array(group_ + "/normal_r", n_r);
        shapes_.write_array(group_ + "/normal_z", n_z);
        shapes_.write_array(group_ + "/c", c);
    }

    // Writes the spectrum of one mode; returns the largest growth rate.
    double treat(int mode, const LinearisedMembrane& membrane) {
        const ModeRates rates = membrane.rates(mode);
        const std::vector<Eigenmode> modes = fastest_modes(normal_rates(membrane, mode, rates), fastest);
        for (std::size_t k = 0; k < modes.size(); ++k) record(mode, k, modes[k], rates.displacements, membrane);
        return modes.front().rate.real();
    }

    void record(int mode, std::size_t rank, const Eigenmode& eigenmode, Index displacements,
                const LinearisedMembrane& membrane) {
        const ModeSpace& space = surroundings_.space(mode);
        const Eigen::VectorXcd w = space.displacement_expansion() * eigenmode.shape.head(displacements);
        const Eigen::VectorXcd c =
            space.scalar().expansion() * eigenmode.shape.tail(eigenmode.shape.size() - displacements);
        const std::vector<double> xi = points();
        const Eigen::MatrixXd at_points = collocation_matrix(space.vertical(), xi);
        const Eigen::VectorXcd values = at_points * w, concentrations = at_points * c;
        Index peak = 0;
        values.cwiseAbs().maxCoeff(&peak);
        // The largest displacement is 1 nm, real.
        const std::complex<double> scale = 1.0 / values[peak];
        const BasePoint p = base_point(dynamics_.space(), membrane.base(), surroundings_.viscosities(),
                                       xi[static_cast<std::size_t>(peak)]);
        spectrum_ += fmt::format("{:.9g},{},{},{:.9g},{:.9g},{:.6g},{:.6g}\n", time_, mode, rank, eigenmode.rate.real(),
                                 eigenmode.rate.imag(), p.curve.r, p.curve.z);
        if (rank > 0) return;
        const std::string name = fmt::format("{}/mode_{}", group_, mode);
        shapes_.create_group(name);
        shapes_.write_attribute(name, "growth_per_us", eigenmode.rate.real());
        shapes_.write_attribute(name, "frequency_rad_per_us", eigenmode.rate.imag());
        const auto write = [&](const char* what, const Eigen::VectorXd& column) {
            shapes_.write_array(name + "/" + what, {column.data(), column.data() + column.size()});
        };
        write("w", (scale * values).real());
        write("w_imaginary", (scale * values).imag());
        write("c", (scale * concentrations).real());
    }
};

}  // namespace

void write_modes(const ModesRequest& request, const std::function<void(const std::string&)>& progress) {
    if (request.first_mode < 1 || request.last_mode < request.first_mode || request.last_mode > 16) {
        throw InputError("--modes: FIRST:LAST with 1 <= FIRST <= LAST <= 16");
    }
    if (request.times < 1) throw InputError("--times: at least 1");
    std::filesystem::create_directories(request.directory);
    Analysis(request, progress).execute();
}

}  // namespace endoflow::boundary_integral
