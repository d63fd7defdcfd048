#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "shared/geometry/observables.h"

namespace endoflow {

/// One accepted time step.
struct HistoryRow {
    double time_us = 0;
    double step_us = 0;
    Observables membrane;
    double area_strain_max = 0;
    double wall_s = 0;
    std::vector<std::optional<double>> extra;  ///< the engine's own columns, in the order it named them
    bool settling = false;  ///< the mesh has just changed: what that left relaxes, and rates are those of that
};

/// A column that the histories of all engines have. Its name ends in its unit.
struct HistoryColumn {
    std::string name;
    std::string meaning;
    std::optional<double> (*value)(const HistoryRow&);  ///< empty where there is none (no neck)
    bool of_shape = false;                              ///< measured on the membrane's shape: a key of events, too
};

/// The shared columns in file order: header, readers, the keys of events and documentation follow this table.
[[nodiscard]] const std::vector<HistoryColumn>& common_history_columns();

/// Names and values of the columns that are of the shape.
[[nodiscard]] std::vector<std::pair<std::string, std::optional<double>>> shape_values(const ShapeMeasures& shape);

/// A column that one engine alone has: its value in what that engine has to say of a step. An engine's table of these
/// is what its header, its rows and the documentation are made from.
template <class Step>
struct OwnColumn {
    std::string name;  // ends in its unit
    std::string meaning;
    std::function<std::optional<double>(const Step&)> value;  // empty where there is none (no walls)
};

/// What a reader is told of a column.
struct ColumnText {
    std::string name;  // ends in its unit
    std::string meaning;
};

template <class Column>
[[nodiscard]] std::vector<ColumnText> texts_of(const std::vector<Column>& columns) {
    std::vector<ColumnText> texts;
    for (const Column& column : columns) texts.push_back({column.name, column.meaning});
    return texts;
}

/// HistoryRow::extra of a step.
template <class Step>
[[nodiscard]] std::vector<std::optional<double>> own_values(const std::vector<OwnColumn<Step>>& columns,
                                                            const Step& step) {
    std::vector<std::optional<double>> values;
    for (const OwnColumn<Step>& column : columns) values.push_back(column.value(step));
    return values;
}

/// All columns of the history of an engine with these of its own, in file order.
[[nodiscard]] std::vector<ColumnText> all_columns(const std::vector<ColumnText>& own_columns);

/// The lines of a Markdown table of name and meaning, as the documentation has it.
[[nodiscard]] std::string columns_as_markdown(const std::vector<ColumnText>& columns);

/// Whether the history of an engine with these columns of its own has this one.
[[nodiscard]] bool has_column(const std::string& column, const std::vector<ColumnText>& own_columns);

/// The value of a column, shared or one of the engine's own; empty where the row has none. Throws std::logic_error
/// when there is no such column.
[[nodiscard]] std::optional<double> value_of(const std::string& column, const HistoryRow& row,
                                             const std::vector<ColumnText>& own_columns);

}  // namespace endoflow
