#include "shared/output/history_columns.h"

#include <algorithm>
#include <stdexcept>

namespace endoflow {

const std::vector<HistoryColumn>& common_history_columns() {
    using R = HistoryRow;
    using Value = std::optional<double>;
    constexpr bool of_shape = true;
    static const std::vector<HistoryColumn> columns{
        {"time_us", "time at the end of the step", [](const R& r) -> Value { return r.time_us; }},
        {"step_us", "length of the step", [](const R& r) -> Value { return r.step_us; }},
        {"neck_radius_nm", "narrowest place between the bud's widest place and the rim; empty without a neck",
         [](const R& r) { return r.membrane.neck ? Value(r.membrane.neck->radius) : Value(); }, of_shape},
        {"bud_diameter_nm", "lateral diameter of the bud above the neck; empty without a neck",
         [](const R& r) { return r.membrane.neck ? Value(r.membrane.neck->lateral_diameter) : Value(); }, of_shape},
        {"bud_height_nm",
         "z of the point farthest from the rim's plane, less the rim's: > 0 for a bud into the cell, < 0 for one out "
         "of it; "
         "of a vesicle its extent in z",
         [](const R& r) -> Value { return r.membrane.bud_height; }, of_shape},
        {"membrane_area_nm2", "area inside the domain; grows as membrane flows in",
         [](const R& r) -> Value { return r.membrane.membrane_area; }, of_shape},
        {"bending_energy_pN_nm", "(S), or (D) of the diffuse membrane",
         [](const R& r) -> Value { return r.membrane.bending_energy; }},
        {"molecule_mass_nm2", "∫ c dA, conserved without exchange",
         [](const R& r) -> Value { return r.membrane.molecule_mass; }},
        {"area_strain_max", "largest local change of area of the material",
         [](const R& r) -> Value { return r.area_strain_max; }},
        {"volume_extracellular_nm3",
         "volume gained against the flat plane, < 0 under a bud out of the cell; of a vesicle what it encloses",
         [](const R& r) -> Value { return r.membrane.extracellular_volume; }, of_shape},
        {"wall_s", "wall time since the start", [](const R& r) -> Value { return r.wall_s; }},
    };
    return columns;
}

std::vector<std::pair<std::string, std::optional<double>>> shape_values(const ShapeMeasures& shape) {
    HistoryRow row;
    static_cast<ShapeMeasures&>(row.membrane) = shape;
    std::vector<std::pair<std::string, std::optional<double>>> values;
    for (const HistoryColumn& column : common_history_columns())
        if (column.of_shape) values.emplace_back(column.name, column.value(row));
    return values;
}

std::vector<ColumnText> all_columns(const std::vector<ColumnText>& own_columns) {
    std::vector<ColumnText> all = texts_of(common_history_columns());
    all.insert(all.end(), own_columns.begin(), own_columns.end());
    return all;
}

std::string columns_as_markdown(const std::vector<ColumnText>& columns) {
    std::string text = "| column | what |\n| --- | --- |\n";
    for (const ColumnText& column : columns) {
        text += "| `" + column.name + "` | ";
        for (const char c : column.meaning) text += c == '|' ? std::string("\\|") : std::string(1, c);
        text += " |\n";
    }
    return text;
}

bool has_column(const std::string& column, const std::vector<ColumnText>& own_columns) {
    const std::vector<ColumnText> all = all_columns(own_columns);
    return std::any_of(all.begin(), all.end(), [&](const ColumnText& entry) { return entry.name == column; });
}

std::optional<double> value_of(const std::string& column, const HistoryRow& row,
                               const std::vector<ColumnText>& own_columns) {
    for (const HistoryColumn& common : common_history_columns())
        if (common.name == column) return common.value(row);
    const auto own = std::find_if(own_columns.begin(), own_columns.end(),
                                  [&](const ColumnText& entry) { return entry.name == column; });
    if (own == own_columns.end()) throw std::logic_error("history.csv has no column " + column);
    return row.extra.at(static_cast<std::size_t>(own - own_columns.begin()));
}

}  // namespace endoflow
