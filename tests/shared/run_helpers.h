#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "shared/output/atomic_file.h"
#include "shared/output/run_files.h"
#include "shared/support/error.h"

// What the tests of a run's directory write into it.

namespace endoflow {

inline std::string content(const std::filesystem::path& file) {
    return read_file(file, 1 << 20);
}

inline HistoryRow row_at(double time, std::vector<std::optional<double>> extra = {7}) {
    HistoryRow row;
    row.time_us = time;
    row.extra = std::move(extra);
    return row;
}

inline MembraneCurve small_curve(double scale) {
    const std::vector<double> x{0, scale, 2 * scale};
    return {x, x, x, x, x, x, x, x};
}

inline EngineIdentity test_engine() {
    return {.name = "boundary-integral",
            .libraries = {{"test", "1.0"}},
            .history_columns = {{"own_nm", "what the test writes"}}};
}

/// A run of three rows and two shapes with its checkpoint at 0.5 µs, left as by a kill.
inline void leave_killed_run(const std::filesystem::path& root) {
    RunFiles output(Parameters{}, test_engine(), root, StartMode::fresh);
    output.write_shape(0, small_curve(1));
    output.record_step(row_at(0.25));
    output.record_step(row_at(0.5));
    Checkpoint checkpoint;
    checkpoint.time_us = 0.5;
    output.write_checkpoint(checkpoint);
    output.record_step(row_at(1.0));
    output.write_shape(1, small_curve(2));
}

inline std::string refusal_to_restart(const std::filesystem::path& root, const Parameters& parameters = {}) {
    try {
        const RunFiles output(parameters, test_engine(), root, StartMode::restart);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

}  // namespace endoflow
