#include "boundary_integral/modes/recorded_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "boundary_integral/evolution/observation.h"
#include "shared/case/case_file.h"
#include "shared/model/loads.h"
#include "shared/model/maturation.h"
#include "shared/output/hdf5_file.h"
#include "shared/output/run_record.h"
#include "shared/support/error.h"

namespace endoflow::boundary_integral {

namespace {

/// Appends SECTION.KEY=VALUE of a section and of the sections within it.
void add_overrides(const std::string& section, const RunRecord& keys, std::vector<std::string>& overrides) {
    for (const auto& [key, value] : keys.items()) {
        const std::string name = fmt::format("{}.{}", section, key);
        if (value.is_object())
            add_overrides(name, value, overrides);
        else
            overrides.push_back(name + "=" + value.dump());  // JSON scalars and arrays are those of TOML
    }
}

std::vector<std::string> as_overrides(const RunRecord& record) {
    std::vector<std::string> overrides;
    for (const auto& [section, keys] : record.at("parameters").items()) add_overrides(section, keys, overrides);
    return overrides;
}

/// The linearised membrane is inextensible, in fluid, and no force pulls at its pole, coat or neck.
void require_modelled(const Parameters& p, const std::string& source) {
    if (p.fluid.dynamics != Dynamics::flow || !p.membrane.inextensible)
        throw InputError(source + ": modes are those of an inextensible membrane in fluid");
    require_no_maturation(p, "modes of a run");
    if (loads_of(p).vertical() || loads_of(p).collar_force != 0)
        throw InputError(
            source +
            ": modes of a membrane under membrane.pole_force, membrane.coat_force or membrane.collar_force are "
            "not modelled: the force rides on the material, whose displacement along the membrane the modes do not "
            "follow");
}

std::string group(std::size_t index) {
    return fmt::format("/shapes/{:06d}", index);
}

}  // namespace

RecordedRun::RecordedRun(const std::filesystem::path& directory) {
    const RunDirectory run{directory};
    const std::string source = run.record().string();
    const RunRecord record = read_record(run);
    if (record.at("engine") != "boundary-integral") {
        throw IoError(source + ": modes are those of a run of the boundary-integral engine");
    }
    shapes_ = run.shapes();
    const Hdf5File file(shapes_, Hdf5File::Mode::read);
    const std::size_t count = file.members("/shapes").size();
    if (count == 0) throw IoError(shapes_.string() + ": holds no shape");
    std::size_t points = 0;
    for (std::size_t i = 0; i < count; ++i) {
        times_.push_back(file.read_number_attribute(group(i), "time"));
        points = std::max(points, file.read_array(group(i) + "/r").size());
    }
    parameters_ = parse_case("", source, as_overrides(record));
    require_modelled(parameters_, source);
    parameters_.boundary_integral.elements = static_cast<int>((points - 1) / at(shape_points_per_element));
}

RecordedShape RecordedRun::shape(std::size_t index) const {
    const Hdf5File file(shapes_, Hdf5File::Mode::read);
    return {file.read_array(group(index) + "/r"), file.read_array(group(index) + "/z")};
}

}  // namespace endoflow::boundary_integral
