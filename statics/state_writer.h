#pragma once

#include "shared/geometry/membrane_curve.h"
#include "shared/model/bending_model.h"
#include "shared/output/run_output.h"
#include "shared/parameters/parameter_table.h"
#include "statics/continuation.h"

namespace endoflow::statics {

using Json = nlohmann::ordered_json;

/// The column of history.csv that a branch goes along, of membranes in the box and of vesicles.
inline const ColumnText followed_value{"followed_value", "of the key the branch goes along; empty without a branch"};

/// Points of the curves in shapes.h5.
inline constexpr std::size_t curve_points = 1001;

/// Stationary shapes in a run's directory: one row of history.csv and one shape for each, numbered by their `time`.
class StateWriter {
  public:
    explicit StateWriter(RunOutput& output) : output_(output) {}

    [[nodiscard]] RunOutput& output() const { return output_; }
    [[nodiscard]] int count() const { return count_; }

    /// Writes one shape, `extra` going to the engine's own columns; returns what can be measured on it.
    Json write(const MembraneCurve& curve, const BendingModel& bending, std::vector<std::optional<double>> extra);

  private:
    RunOutput& output_;
    int count_ = 0;
};

/// Prints what write() returned.
void print_figures(const Json& figures);

/// [{parameter, value}]
[[nodiscard]] Json describe_folds(const std::vector<Fold>& folds, const std::string& key);

/// Notes and prints where a branch in a parameter of this unit begins, ends and folds.
void describe_branch(const StateWriter& writer, const std::string& key, const std::string& unit, double begin,
                     const Branch& branch, const std::string& ended_because);

}  // namespace endoflow::statics
