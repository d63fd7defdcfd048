#include "boundary_integral/modes/recorded_run.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <string>

#include "shared/case/case_file.h"
#include "shared/output/atomic_file.h"
#include "shared/output/hdf5_file.h"
#include "shared/output/run_directory.h"
#include "shared/output/run_record.h"
#include "shared/support/error.h"

namespace endoflow::boundary_integral {

namespace {

constexpr std::size_t points_per_element = 8;
constexpr std::uintmax_t largest_record = 1U << 26U;
constexpr double largest_misfit = 1e-8;  // nm, of stored points against the spline through them

/// Appends SECTION.KEY=VALUE of a section and of the sections within it.
void add_overrides(const std::string& section, const RunRecord& keys, std::vector<std::string>& overrides) {
    for (const auto& [key, value] : keys.items()) {
        const std::string name = fmt::format("{}.{}", section, key);
        if (value.is_object())
            add_overrides(name, value, overrides);
        else
            overrides.push_back(name + "=" + value.dump());  // JSON scalars are those of TOML
    }
}

std::vector<std::string> as_overrides(const RunRecord& record) {
    std::vector<std::string> overrides;
    for (const auto& [section, keys] : record.at("parameters").items()) add_overrides(section, keys, overrides);
    return overrides;
}

/// The linearised membrane is inextensible, in fluid, and bears no load.
void require_modelled(const Parameters& p, const std::string& source) {
    if (p.fluid.dynamics != Dynamics::flow || !p.membrane.inextensible)
        throw InputError(source + ": modes are those of an inextensible membrane in fluid");
    if (p.membrane.rim_tension != 0 || p.membrane.pole_force != 0 || p.fluid.pressure_difference != 0)
        throw InputError(source +
                         ": modes of a membrane under a load (membrane.rim_tension, membrane.pole_force, "
                         "fluid.pressure_difference) are not modelled");
}

std::string group(std::size_t index) {
    return fmt::format("/shapes/{:06d}", index);
}

Eigen::VectorXd fitted(const SplineSpace& splines, const std::vector<double>& values) {
    std::vector<double> points;
    for (std::size_t i = 0; i < values.size(); ++i) {
        points.push_back(static_cast<double>(i) / static_cast<double>(values.size() - 1));
    }
    const Eigen::Map<const Eigen::VectorXd> right(values.data(), static_cast<Index>(values.size()));
    const Eigen::MatrixXd matrix = collocation_matrix(splines, points);
    Eigen::VectorXd coefficients = matrix.householderQr().solve(right);
    if ((matrix * coefficients - right).cwiseAbs().maxCoeff() > largest_misfit) {
        throw IoError("shapes.h5: the points of a shape are not those of the sharp engine's splines");
    }
    return coefficients;
}

}  // namespace

RecordedRun::RecordedRun(const std::filesystem::path& directory) {
    const RunDirectory run{directory};
    const std::string source = run.record().string();
    const RunRecord record = parse_record(read_file(run.record(), largest_record), source);
    if (record.at("engine") != "boundary-integral") {
        throw IoError(source + ": modes are those of a run of the boundary-integral engine");
    }
    shapes_ = run.shapes();
    const Hdf5File file(shapes_, Hdf5File::Mode::read);
    const std::size_t count = file.members("/shapes").size();
    if (count == 0) throw IoError(shapes_.string() + ": holds no shape");
    for (std::size_t i = 0; i < count; ++i) times_.push_back(file.read_number_attribute(group(i), "time"));
    parameters_ = parse_case("", source, as_overrides(record));
    require_modelled(parameters_, source);
    parameters_.boundary_integral.elements =
        static_cast<int>((file.read_array(group(0) + "/r").size() - 1) / points_per_element);
}

MembraneState RecordedRun::state(const MembraneSpace& space, std::size_t index) const {
    const Hdf5File file(shapes_, Hdf5File::Mode::read);
    const auto column = [&](const char* name) { return file.read_array(group(index) + "/" + name); };
    return {fitted(space.radial(), column("r")), fitted(space.axial(), column("z")),
            fitted(space.axial(), column("c"))};
}

}  // namespace endoflow::boundary_integral
