#include "shared/output/history_columns.h"

#include <algorithm>
#include <stdexcept>

namespace endoflow {

std::optional<double> HistoryColumn::value_in(const HistoryRow& row) const {
    return std::visit([&](auto pointer) { return std::optional<double>(row.*pointer); }, member);
}

const std::vector<HistoryColumn>& common_history_columns() {
    using R = HistoryRow;
    static const std::vector<HistoryColumn> columns{
        {"time_us", "time at the end of the step", &R::time_us},
        {"step_us", "length of the step", &R::step_us},
        {"neck_radius_nm", "narrowest place between the bud's widest place and the rim; empty without a neck",
         &R::neck_radius_nm},
        {"bud_diameter_nm", "lateral diameter of the bud above the neck; empty without a neck", &R::bud_diameter_nm},
        {"bud_height_nm", "highest point above the rim", &R::bud_height_nm},
        {"membrane_area_nm2", "area inside the domain; grows as membrane flows in", &R::membrane_area_nm2},
        {"bending_energy_pN_nm", "(S), or (D) of the diffuse membrane", &R::bending_energy_pN_nm},
        {"molecule_mass_nm2", "∫ c dA, conserved without exchange", &R::molecule_mass_nm2},
        {"area_strain_max", "largest local change of area of the material", &R::area_strain_max},
        {"volume_extracellular_nm3", "volume gained against the flat plane", &R::volume_extracellular_nm3},
        {"wall_s", "wall time since the start", &R::wall_s},
    };
    return columns;
}

bool has_column(const std::string& column, const std::vector<std::string>& own_columns) {
    const auto& common = common_history_columns();
    return std::any_of(common.begin(), common.end(), [&](const auto& entry) { return entry.name == column; }) ||
           std::find(own_columns.begin(), own_columns.end(), column) != own_columns.end();
}

std::optional<double> value_of(const std::string& column, const HistoryRow& row,
                               const std::vector<std::string>& own_columns) {
    for (const HistoryColumn& common : common_history_columns())
        if (common.name == column) return common.value_in(row);
    const auto own = std::find(own_columns.begin(), own_columns.end(), column);
    if (own == own_columns.end()) throw std::logic_error("history.csv has no column " + column);
    return row.extra.at(static_cast<std::size_t>(own - own_columns.begin()));
}

}  // namespace endoflow
