#include "statics/state_writer.h"

#include <fmt/format.h>

#include "shared/geometry/observables.h"
#include "shared/support/console.h"

namespace endoflow::statics {

Json StateWriter::write(const MembraneCurve& curve, const BendingModel& bending,
                        std::vector<std::optional<double>> extra) {
    const Observables seen = measure(curve, bending);
    HistoryRow row;
    row.time_us = count_;
    row.step_us = count_ == 0 ? 0 : 1;
    row.membrane = seen;
    row.extra = std::move(extra);
    output_.record_step(row);
    output_.write_shape(count_, curve);
    ++count_;
    Json figures = {{"membrane_area_nm2", seen.membrane_area},
                    {"curve_length_nm", curve.s.back()},
                    {"bending_energy_pN_nm", seen.bending_energy}};
    if (seen.neck) {
        figures["neck_radius_nm"] = seen.neck->radius;
        figures["bud_diameter_nm"] = seen.neck->lateral_diameter;
    }
    return figures;
}

void print_figures(const Json& figures) {
    for (const auto& [name, value] : figures.items())
        say(stdout, fmt::format("  {:<28} {:.9g}\n", name, value.get<double>()));
}

Json describe_folds(const std::vector<Fold>& folds, const std::string& key) {
    Json list = Json::array();
    for (const Fold& fold : folds) list.push_back({{"parameter", key}, {"value", fold.parameter()}});
    return list;
}

void describe_branch(const StateWriter& writer, const std::string& key, const std::string& unit, double begin,
                     const Branch& branch, const std::string& ended_because) {
    const double end = branch.last.solution.parameter;
    writer.output().note("branch", {{"parameter", key},
                                    {"unit", unit},
                                    {"begin", begin},
                                    {"end", end},
                                    {"ended_because", ended_because},
                                    {"points", writer.count()},
                                    {"folds", describe_folds(branch.folds, key)}});
    for (const Fold& fold : branch.folds)
        say(stdout, fmt::format("fold at {} = {:.9g} {}\n", key, fold.parameter(), unit));
    say(stdout,
        fmt::format("branch in {}: {} points, {} at {:.9g} {}\n", key, writer.count(), ended_because, end, unit));
}

}  // namespace endoflow::statics
