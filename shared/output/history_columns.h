#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace endoflow {

/// One accepted time step. Values that do not exist (no neck) stay empty.
struct HistoryRow {
    double time_us = 0;
    double step_us = 0;
    std::optional<double> neck_radius_nm;
    std::optional<double> bud_diameter_nm;
    double bud_height_nm = 0;
    double membrane_area_nm2 = 0;
    double bending_energy_pN_nm = 0;
    double molecule_mass_nm2 = 0;
    double area_strain_max = 0;
    double volume_extracellular_nm3 = 0;
    double wall_s = 0;
    std::vector<double> extra;  // the engine's own columns, in the order it named them
};

/// A column that the histories of all engines have. Its name ends in its unit.
struct HistoryColumn {
    std::string name;
    std::string meaning;
    std::variant<double HistoryRow::*, std::optional<double> HistoryRow::*> member;

    [[nodiscard]] std::optional<double> value_in(const HistoryRow& row) const;
};

/// The shared columns in file order: header, readers and documentation follow this table.
[[nodiscard]] const std::vector<HistoryColumn>& common_history_columns();

/// A column that one engine alone has: its value in what that engine has to say of a step. An engine's table of these
/// is what its header, its rows and the documentation are made from.
template <class Step>
struct OwnColumn {
    std::string name;  // ends in its unit
    std::string meaning;
    double (*value)(const Step&);
};

template <class Column>
[[nodiscard]] std::vector<std::string> names_of(const std::vector<Column>& columns) {
    std::vector<std::string> names;
    for (const Column& column : columns) names.push_back(column.name);
    return names;
}

/// HistoryRow::extra of a step.
template <class Step>
[[nodiscard]] std::vector<double> own_values(const std::vector<OwnColumn<Step>>& columns, const Step& step) {
    std::vector<double> values;
    for (const OwnColumn<Step>& column : columns) values.push_back(column.value(step));
    return values;
}

/// The lines of a Markdown table of name and meaning, as docs/outputs.md has it.
template <class Column>
[[nodiscard]] std::string columns_as_markdown(const std::vector<Column>& columns) {
    std::string text = "| column | what |\n| --- | --- |\n";
    for (const Column& column : columns) text += "| `" + column.name + "` | " + column.meaning + " |\n";
    return text;
}

/// Whether the history of an engine with these columns of its own has this one.
[[nodiscard]] bool has_column(const std::string& column, const std::vector<std::string>& own_columns);

/// The value of a column, shared or one of the engine's own; empty where the row has none. Throws std::logic_error
/// when there is no such column.
[[nodiscard]] std::optional<double> value_of(const std::string& column, const HistoryRow& row,
                                             const std::vector<std::string>& own_columns);

}  // namespace endoflow
