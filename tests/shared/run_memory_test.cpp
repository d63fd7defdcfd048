#include <catch2/catch.hpp>
#include <cmath>

#include "run_helpers.h"
#include "shared/output/run_memory.h"
#include "temporary_directory.h"

using namespace endoflow;

namespace {

/// What an engine may say in a run of two rows, to any output.
void speak(RunOutput& output) {
    output.write_shape(0, small_curve(1));
    auto row = row_at(0.5);
    row.membrane.neck = Neck{12.5, 0, 0};
    output.record_step(row);
    output.count_rejected_step();
    output.record_event("budding", 0.45, {Neck{5, 60, 0}, 80, 2e4, 1e5});
    output.record_event("budding", 0.46, {});
    output.note("elements", 8);
    output.add_phase_time("rates", 1, 2);
    output.add_phase_time("rates", 1, 2);
    output.record_step(row_at(1));
    Checkpoint checkpoint;
    checkpoint.time_us = 1;
    output.write_checkpoint(checkpoint);
    output.finish(ExitReason::done);
}

/// history.csv without wall_s, the last column but the engine's own one.
std::string without_wall_times(const std::string& history) {
    std::istringstream lines(history);
    std::string kept;
    for (std::string line; std::getline(lines, line);) {
        const auto own = line.rfind(','), wall = line.rfind(',', own - 1);
        kept += line.substr(0, wall) + line.substr(own) + "\n";
    }
    return kept;
}

}  // namespace

TEST_CASE("memory keeps what a run's directory holds") {
    const TemporaryDirectory directory;
    RunMemory memory(Parameters{}, test_engine());
    RunFiles files(Parameters{}, test_engine(), directory.path() / "run", StartMode::fresh);
    speak(memory);
    speak(files);
    const auto written = nlohmann::json::parse(content(directory.path() / "run/run.json"));
    const auto kept = nlohmann::json::parse(memory.record().dump());
    for (const char* key : {"engine", "state", "exit_reason", "parameters", "time_us", "steps", "phases", "columns",
                            "events", "accuracy", "alarms", "notes"})
        CHECK(kept.at(key) == written.at(key));
    CHECK(without_wall_times(memory.history()) == without_wall_times(content(directory.path() / "run/history.csv")));
    REQUIRE(memory.shapes().size() == 1);
    CHECK(memory.shapes()[0].curve.r == small_curve(1).r);
    REQUIRE(memory.checkpoint());
    CHECK(RunMemory(Parameters{}, test_engine(), memory.checkpoint()).restart_point()->time_us == 1);
}

TEST_CASE("memory takes no number that is not one, and raises alarms") {
    RunMemory memory(Parameters{}, test_engine());
    CHECK_THROWS_AS(memory.record_step(row_at(NAN)), SolverError);
    auto curve = small_curve(1);
    curve.c[1] = NAN;
    CHECK_THROWS_AS(memory.write_shape(0, curve), SolverError);
    CHECK(memory.shapes().empty());
    const AccuracyBound bound{.name = "test-bound",
                              .engine = "boundary-integral",
                              .column = "",
                              .measure = {},
                              .bound = 1,
                              .limit = 3,
                              .meaning = "what it is",
                              .remedy = "what to do"};
    memory.watch(bound, 0.1, 2);
    memory.watch(bound, 0.2, 2.5);
    REQUIRE(memory.warnings().size() == 1);
    CHECK_THAT(memory.warnings()[0], Catch::Matchers::Contains("what to do"));
    CHECK(memory.record()["alarms"].size() == 1);
    CHECK_THROWS_AS(memory.watch(bound, 0.3, 4), SolverError);
}
