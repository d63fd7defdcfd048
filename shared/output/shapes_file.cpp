#include "shared/output/shapes_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "shared/output/hdf5_file.h"
#include "shared/output/output_plan.h"
#include "shared/output/shape_columns.h"
#include "shared/support/error.h"
#include "shared/support/version.h"

namespace endoflow {

namespace {

std::string group_name(int index) {
    return fmt::format("/shapes/{:06d}", index);
}

}  // namespace

int count_shapes(const std::filesystem::path& file, double last_time_us) {
    const Hdf5File hdf5(file, Hdf5File::Mode::read);
    int count = 0;
    for (const auto& name : hdf5.members("/shapes")) {
        const std::string group = "/shapes/" + name;
        if (later(hdf5.read_number_attribute(group, "time"), last_time_us)) continue;
        for (const auto& column : shape_columns) (void)hdf5.read_array(group + "/" + column.name);
        ++count;
    }
    return count;
}

ShapesFile::ShapesFile(const std::filesystem::path& file) : path_(file) {
    Hdf5File hdf5(file, Hdf5File::Mode::create);
    hdf5.write_attribute("/", "written_by", written_by());
    hdf5.create_group("/shapes");
    for (const auto& column : shape_columns)
        hdf5.write_attribute("/shapes", fmt::format("{}_unit", column.name), column.unit);
    hdf5.flush();
}

ShapesFile::ShapesFile(const std::filesystem::path& file, double last_time_us) : path_(file) {
    Hdf5File hdf5(file, Hdf5File::Mode::extend);
    for (const auto& name : hdf5.members("/shapes")) {
        const std::string group = "/shapes/" + name;
        const double time = hdf5.read_number_attribute(group, "time");
        if (later(time, last_time_us))
            hdf5.remove(group);
        else
            times_.push_back(time);
    }
    hdf5.flush();
}

void ShapesFile::append(double time_us, const MembraneCurve& curve) {
    require_finite(curve);
    Hdf5File hdf5(path_, Hdf5File::Mode::extend);
    const std::string group = group_name(count());
    hdf5.create_group(group);
    hdf5.write_attribute(group, "time", time_us);
    hdf5.write_attribute(group, "time_unit", "us");
    for (const auto& column : shape_columns) {
        const std::string name = group + "/" + column.name;
        hdf5.write_array(name, curve.*column.values);
        hdf5.write_attribute(name, "unit", column.unit);
        hdf5.write_attribute(name, "meaning", column.meaning);
    }
    hdf5.flush();
    times_.push_back(time_us);
}

int ShapesFile::count_until(double time_us) const {
    return static_cast<int>(
        std::count_if(times_.begin(), times_.end(), [&](double time) { return !later(time, time_us); }));
}

}  // namespace endoflow
