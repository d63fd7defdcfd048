#include "boundary_integral/modes/mode_files.h"

#include <fmt/format.h>

#include <complex>

#include "boundary_integral/modes/spectrum.h"
#include "shared/output/atomic_file.h"

namespace endoflow::boundary_integral {

namespace {

constexpr std::size_t fastest = 3;  // of each mode at each time

}  // namespace

ModeFiles::ModeFiles(const std::filesystem::path& directory, const AlongRun& run)
    : directory_(directory),
      run_(run),
      points_(meridian_points(run.dynamics().space())),
      shapes_(directory / "eigenshapes.h5", Hdf5File::Mode::create) {
    shapes_.create_group("/times");
    if (const auto budding = run.trajectory().budding()) shapes_.write_attribute("/times", "budding_us", *budding);
}

std::vector<double> ModeFiles::add(const PerturbationGrowth& growth) {
    const Moment& moment = growth.moment();
    group_ = fmt::format("/times/{:06d}", count_++);
    shapes_.create_group(group_);
    shapes_.write_attribute(group_, "time", moment.time);
    write_meridian(shapes_, group_, run_, moment);
    std::vector<double> largest;
    for (int mode = run_.first_mode(); mode <= run_.last_mode(); ++mode) {
        largest.push_back(write_mode(mode, moment, moment.rates_of(mode)));
        write_perturbations(mode, growth);
    }
    return largest;
}

void ModeFiles::finish() {
    shapes_.flush();
    write_file_atomically(directory_ / "modes.csv", rates_);
    write_file_atomically(directory_ / "perturbations.csv", perturbations_);
}

void ModeFiles::write(const std::string& name, const Eigen::VectorXd& column) {
    shapes_.write_array(name, {column.data(), column.data() + column.size()});
}

void write_meridian(Hdf5File& file, const std::string& group, const AlongRun& run, const Moment& moment) {
    const MembraneSpace& space = run.dynamics().space();
    std::vector<double> r, z, n_r, n_z, c;
    for (const double xi : meridian_points(space)) {
        const BasePoint p = base_point(space, moment.membrane->base(), run.surroundings().viscosities(), xi);
        r.push_back(xi == 0.0 ? 0.0 : p.curve.r);
        z.push_back(p.curve.z);
        n_r.push_back(p.curve.normal_r);
        n_z.push_back(p.curve.normal_z);
        c.push_back(p.c);
    }
    file.write_array(group + "/r", r);
    file.write_array(group + "/z", z);
    file.write_array(group + "/normal_r", n_r);
    file.write_array(group + "/normal_z", n_z);
    file.write_array(group + "/c", c);
}

// Returns the largest growth rate.
double ModeFiles::write_mode(int mode, const Moment& moment, const ModeRates& rates) {
    const ModeSpace& space = run_.surroundings().space(mode);
    const std::vector<Eigenmode> modes = fastest_modes(normal_rates(*moment.membrane, mode, rates), fastest);
    const Eigen::MatrixXd displacement = displacement_values(space, points_);
    const std::string name = fmt::format("{}/mode_{}", group_, mode);
    for (std::size_t rank = 0; rank < modes.size(); ++rank) {
        const Eigenmode& eigenmode = modes[rank];
        const Eigen::VectorXcd values = displacement * eigenmode.shape.head(rates.displacements);
        Index peak = 0;
        values.cwiseAbs().maxCoeff(&peak);
        const CurvePoint p = base_point(run_.dynamics().space(), moment.membrane->base(),
                                        run_.surroundings().viscosities(), points_[static_cast<std::size_t>(peak)])
                                 .curve;
        rates_ += fmt::format("{:.9g},{},{},{:.9g},{:.9g},{:.6g},{:.6g}\n", moment.time, mode, rank,
                              eigenmode.rate.real(), eigenmode.rate.imag(), p.r, p.z);
        if (rank > 0) continue;
        // The largest displacement is 1 nm, real.
        const std::complex<double> scale = 1.0 / values[peak];
        const Eigen::VectorXcd c =
            concentration_values(space, points_) * eigenmode.shape.tail(eigenmode.shape.size() - rates.displacements);
        shapes_.create_group(name);
        shapes_.write_attribute(name, "growth_per_us", eigenmode.rate.real());
        shapes_.write_attribute(name, "frequency_rad_per_us", eigenmode.rate.imag());
        write(name + "/w", (scale * values).real());
        write(name + "/w_imaginary", (scale * values).imag());
        write(name + "/c", (scale * c).real());
    }
    return modes.front().rate.real();
}

void ModeFiles::write_perturbations(int mode, const PerturbationGrowth& growth) {
    const std::string name = fmt::format("{}/mode_{}", group_, mode);
    const Eigen::MatrixXd displacement = displacement_values(run_.surroundings().space(mode), points_);
    const auto values = [&](const Perturbation& p) { return displacement * p.y.head(displacement.cols()); };
    for (const Perturbation& p : growth.perturbations(mode)) {
        perturbations_ += fmt::format("{:.9g},{},{},{:.6g},{:.6g},{}\n", growth.moment().time, mode, p.initial, p.peak,
                                      p.rms, p.gain ? fmt::format("{:.6g}", *p.gain) : "");
        if (p.initial == "worst") write(name + "/worst", values(p));
    }
    write(name + "/worst_at_start", values(growth.worst_at_start(mode)));
}

}  // namespace endoflow::boundary_integral
