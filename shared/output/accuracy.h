#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "shared/model/rest.h"
#include "shared/output/history_file.h"
#include "shared/output/run_record.h"
#include "shared/parameters/parameters.h"

namespace endoflow {

/// How a quantity that says how accurate a run is follows from a column of its history.
enum class AccuracyMeasure {
    value,       ///< |column|
    rate,        ///< |column| too, but that of a settling row says nothing
    drift,       ///< |column − its first value| / the larger one of its first value and the area of rest_level()
    accumulated  ///< |∫ column dt| / the largest one of the membrane's largest energy, bending and edge, the loads'
                 ///< work ∫ |power| dt, both so far, and the energy of rest_level()
};

/// A quantity that is small in an accurate run, and how large it may get.
struct AccuracyBound {
    std::string name;
    std::string engine;
    std::string column;  // of history.csv
    AccuracyMeasure measure;
    double bound;  // beyond it the run raises an alarm
    double limit;  // beyond it the run is not a solution any more and stops
    std::string meaning;
    std::string remedy;
    std::function<bool(const Parameters&)> applies = {};  // empty: to every case
    std::string asked_for = {};                           // section.key of the parameter that is the bound in a run
};

/// All bounds of all engines; the table in docs/outputs.md is this one.
[[nodiscard]] const std::vector<AccuracyBound>& accuracy_bounds();

/// That of the sharp engine with this name in a case. Throws std::out_of_range when there is none.
[[nodiscard]] const AccuracyBound& sharp_bound(const std::string& name, const Parameters& parameters);

/// The bounds as a Markdown table.
[[nodiscard]] std::string render_accuracy_markdown();

/// A quantity that left its bound: run.json's `alarms`.
struct Alarm {
    std::string name;
    double time_us;  // when it first did
    double value;
    double bound;
    std::string meaning;
    std::string remedy;

    /// One line: what is how large, when, and what to change.
    [[nodiscard]] std::string describe() const;
};

/// From an entry of run.json's `alarms`. Throws RunRecord::exception when one of its members is not there.
[[nodiscard]] Alarm alarm_of(const RunRecord& entry);

/// Follows the quantities of one run. What it must remember stands in the run's record (`accuracy`: for each quantity
/// its largest value, when that was, bound and limit; `alarms`), so a restart goes on from there.
class AccuracyWatch {
  public:
    AccuracyWatch(const Parameters& parameters, const EngineIdentity& engine);

    /// Looks at a row; returns the alarms it raises. Throws SolverError named as the quantity that exceeds its limit.
    std::vector<Alarm> look_at(const HistoryRow& row, RunRecord& record) const;

    /// The same for a quantity that is in no column; `bound.column` and `bound.measure` do not matter.
    static std::optional<Alarm> look_at(const AccuracyBound& bound, double time_us, double value, RunRecord& record);

  private:
    [[nodiscard]] double measured(const AccuracyBound& bound, const HistoryRow& row, RunRecord& memory) const;

    std::vector<AccuracyBound> bounds_;
    std::vector<ColumnText> columns_;
    RestLevel rest_;
};

}  // namespace endoflow
