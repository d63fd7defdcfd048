#include "boundary_integral/modes/noise_files.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "boundary_integral/modes/mode_files.h"
#include "shared/output/atomic_file.h"

namespace endoflow::boundary_integral {

namespace {

constexpr const char* table_header =
    "time_us,height_nm,height_rms_nm,height_inherited_nm,neck_radius_nm,neck_rms_nm,neck_inherited_nm,"
    "sideways_rms_nm,sideways_inherited_nm,ellipticity_rms,ellipticity_inherited,neck_ellipticity_rms,"
    "neck_ellipticity_inherited\n";

std::string cells(const Spread& spread) {
    return fmt::format(",{:.6g},{:.6g}", spread.total, spread.inherited);
}

}  // namespace

NoiseFiles::NoiseFiles(const std::filesystem::path& directory, const AlongRun& run, double temperature)
    : directory_(directory),
      run_(run),
      temperature_(temperature),
      shapes_(directory / "noise.h5", Hdf5File::Mode::create),
      table_(table_header),
      modes_("time_us,mode,rms_nm,inherited_nm\n") {
    shapes_.create_group("/times");
}

void NoiseFiles::add(const NoiseGrowth& growth) {
    const Moment& moment = growth.moment();
    const NoisyShape shape = growth.shape();
    table_ += fmt::format("{:.9g},{:.9g}", moment.time, shape.height) + cells(shape.height_spread);
    if (const auto& bud = shape.bud) {
        table_ += fmt::format(",{:.9g}", bud->neck_radius) + cells(bud->neck) + cells(bud->sideways) +
                  cells(bud->ellipticity) + cells(bud->neck_ellipticity);
    } else {
        table_ += ",,,,,,,,,";
    }
    table_ += "\n";
    const std::string group = fmt::format("/times/{:06d}", count_++);
    shapes_.create_group(group);
    shapes_.write_attribute(group, "time", moment.time);
    write_meridian(shapes_, group, run_, moment);
    for (int mode = 0; mode <= run_.last_mode(); ++mode) {
        modes_ += fmt::format("{:.9g},{}", moment.time, mode) + cells(growth.rms(mode)) + "\n";
        const auto along = growth.displacement(mode);
        const char* names[] = {"rms", "inherited"};
        for (std::size_t i = 0; i < along.size(); ++i) {
            shapes_.write_array(fmt::format("{}/{}_{}", group, names[i], mode),
                                {along[i].data(), along[i].data() + along[i].size()});
        }
    }
    if (run_.trajectory().budding() == moment.time) at_budding_ = shape;
}

void NoiseFiles::finish(const NoiseGrowth& growth) {
    nlohmann::ordered_json record = {{"temperature_K", temperature_}, {"budding_us", nullptr},
                                     {"budding_spread_us", nullptr},  {"budding_spread_inherited_us", nullptr},
                                     {"linear_until_us", nullptr},    {"followed_to_us", growth.moment().time}};
    if (at_budding_ && at_budding_->bud) {
        const NoisyShape::Bud& bud = *at_budding_->bud;
        record["budding_us"] = *run_.trajectory().budding();
        record["budding_spread_us"] = bud.neck.total / std::abs(bud.neck_rate);
        record["budding_spread_inherited_us"] = bud.neck.inherited / std::abs(bud.neck_rate);
    }
    if (const auto end = growth.linear_until()) record["linear_until_us"] = *end;
    shapes_.flush();
    write_file_atomically(directory_ / "noise.csv", table_);
    write_file_atomically(directory_ / "noise_modes.csv", modes_);
    write_file_atomically(directory_ / "noise.json", record.dump(2) + "\n");
}

}  // namespace endoflow::boundary_integral
