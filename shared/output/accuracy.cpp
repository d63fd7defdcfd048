#include "shared/output/accuracy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "shared/parameters/parameter_table.h"
#include "shared/support/error.h"

namespace endoflow {

namespace {

/// The entry of run.json's `accuracy` for a quantity, made when it is not there.
RunRecord& entry(RunRecord& record, const AccuracyBound& bound) {
    RunRecord& found = record["accuracy"][bound.name];
    if (found.is_null()) found = {{"largest", 0.0}, {"time_us", 0.0}, {"bound", bound.bound}, {"limit", bound.limit}};
    return found;
}

std::string beyond(const std::string& meaning, double value, double allowed) {
    return fmt::format("{}: {:.2g}, allowed {:g}", meaning, value, allowed);
}

bool raised_before(const RunRecord& record, const std::string& name) {
    return record.contains("alarms") && std::any_of(record["alarms"].begin(), record["alarms"].end(),
                                                    [&](const auto& alarm) { return alarm.at("name") == name; });
}

}  // namespace

std::string Alarm::describe() const {
    return fmt::format("{} at t = {:.4g} µs: {}; {}", name, time_us, beyond(meaning, value, bound), remedy);
}

Alarm alarm_of(const RunRecord& entry) {
    return {entry.at("name"),  entry.at("time_us"), entry.at("value"),
            entry.at("bound"), entry.at("meaning"), entry.at("remedy")};
}

AccuracyWatch::AccuracyWatch(const Parameters& parameters, const EngineIdentity& engine)
    : columns_(engine.history_columns), rest_(rest_level(parameters)) {
    for (const AccuracyBound& bound : accuracy_bounds())
        if (bound.engine == engine.name && has_column(bound.column, columns_) &&
            (!bound.applies || bound.applies(parameters))) {
            bounds_.push_back(bound);
            if (!bound.asked_for.empty())
                bounds_.back().bound = std::get<double>(find_parameter(bound.asked_for)->get(parameters));
        }
}

double AccuracyWatch::measured(const AccuracyBound& bound, const HistoryRow& row, RunRecord& memory) const {
    const double value = value_of(bound.column, row, columns_).value_or(0);
    switch (bound.measure) {
        case AccuracyMeasure::value:
        case AccuracyMeasure::rate:
            return std::abs(value);
        case AccuracyMeasure::drift: {
            if (!memory.contains("first")) memory["first"] = value;
            const double first = memory["first"].get<double>();
            return std::abs(value - first) / rest_floor(std::abs(first), 0, rest_.area);
        }
        case AccuracyMeasure::accumulated: {
            const auto optional = [&](const char* column) {
                return has_column(column, columns_) ? value_of(column, row, columns_).value_or(0) : 0;
            };
            const double line = optional("line_energy_pN_nm"),
                         power = std::abs(optional("load_power_pN_nm_per_us")) +
                                 std::abs(optional("maturation_power_pN_nm_per_us")),
                         energy = std::max(memory.value("energy_pN_nm", 0.0), row.membrane.bending_energy + line),
                         work = memory.value("work_pN_nm", 0.0) + power * row.step_us,
                         sum = memory.value("sum", 0.0) + value * row.step_us;
            memory["energy_pN_nm"] = energy;
            memory["work_pN_nm"] = work;
            memory["sum"] = sum;
            return std::abs(sum) / rest_floor(std::max(energy, work), 0, rest_.energy);
        }
    }
    throw std::logic_error("no such measure of accuracy");
}

std::vector<Alarm> AccuracyWatch::look_at(const HistoryRow& row, RunRecord& record) const {
    std::vector<Alarm> alarms;
    for (const AccuracyBound& bound : bounds_) {
        if (row.settling && bound.measure == AccuracyMeasure::rate) continue;
        if (const auto alarm = look_at(bound, row.time_us, measured(bound, row, entry(record, bound)), record))
            alarms.push_back(*alarm);
    }
    return alarms;
}

std::optional<Alarm> AccuracyWatch::look_at(const AccuracyBound& bound, double time_us, double value,
                                            RunRecord& record) {
    RunRecord& seen = entry(record, bound);
    if (value > seen["largest"].get<double>()) {
        seen["largest"] = value;
        seen["time_us"] = time_us;
    }
    std::optional<Alarm> alarm;
    if (value > bound.bound && !raised_before(record, bound.name)) {
        alarm = Alarm{bound.name, time_us, value, bound.bound, bound.meaning, bound.remedy};
        record["alarms"].push_back({{"name", bound.name},
                                    {"time_us", time_us},
                                    {"value", value},
                                    {"bound", bound.bound},
                                    {"meaning", bound.meaning},
                                    {"remedy", bound.remedy}});
    }
    if (value > bound.limit)
        throw SolverError(bound.name,
                          fmt::format("{} at t = {:.6g} µs", beyond(bound.meaning, value, bound.limit), time_us),
                          bound.remedy);
    return alarm;
}

}  // namespace endoflow
