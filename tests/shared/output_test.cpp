#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "run_helpers.h"
#include "shared/output/atomic_file.h"
#include "shared/output/checkpoint.h"
#include "shared/output/checkpoint_file.h"
#include "shared/output/hdf5_file.h"
#include "shared/output/live_line.h"
#include "shared/output/output_plan.h"
#include "shared/output/run_files.h"
#include "shared/output/run_observer.h"
#include "shared/output/shapes_file.h"
#include "shared/support/console.h"
#include "shared/support/error.h"
#include "temporary_directory.h"

using namespace endoflow;
using Catch::Matchers::Contains;

TEST_CASE("files are replaced whole or not at all") {
    const TemporaryDirectory directory;
    const auto file = directory.path() / "a.txt";
    write_file_atomically(file, "one");
    write_file_atomically(file, "two");
    CHECK(content(file) == "two");
    CHECK_THROWS_AS(write_file_atomically(directory.path() / "none" / "a.txt", "x"), IoError);
    CHECK_THROWS_AS(read_file(file, 2), IoError);
    CHECK_THROWS_AS(read_file(directory.path() / "none", 2), IoError);
}

TEST_CASE("history.csv has named columns, empty cells for what does not exist, and continues after a crash") {
    const TemporaryDirectory directory;
    const auto file = directory.path() / "history.csv";
    const std::vector<ColumnText> own = test_engine().history_columns;
    {
        HistoryFile history(file, own);
        auto row = row_at(0.5);
        history.append(row);
        row.time_us = 1;
        row.membrane.neck = Neck{12.5, 0, 0};
        history.append(row);
        history.append(row_at(1.5));
    }
    std::ofstream(file, std::ios::app) << "2.0,torn";
    {
        HistoryFile history(file, own, read_kept_history(file, own, 1.0));
        history.append(row_at(1.25));
    }
    std::istringstream lines(content(file));
    std::string header, first, second, third, fourth;
    std::getline(lines, header);
    std::getline(lines, first);
    std::getline(lines, second);
    std::getline(lines, third);
    CHECK(header.rfind("time_us,step_us,neck_radius_nm,", 0) == 0);
    CHECK_THAT(header, Catch::Matchers::EndsWith("wall_s,own_nm"));
    CHECK(first.rfind("0.5,0,,", 0) == 0);
    CHECK(second.rfind("1,0,12.5,", 0) == 0);
    CHECK(third.rfind("1.25,", 0) == 0);
    CHECK_FALSE(std::getline(lines, fourth));
    CHECK_THROWS_AS(read_kept_history(file, {{"other", ""}}, 1.0), IoError);
}

TEST_CASE("no value that is not finite reaches a file") {
    const TemporaryDirectory directory;
    HistoryFile history(directory.path() / "history.csv", test_engine().history_columns);
    CHECK_THROWS_AS(history.append(row_at(NAN)), SolverError);
    CHECK_THROWS_AS(history.append(row_at(1, {INFINITY})), SolverError);
    ShapesFile shapes(directory.path() / "shapes.h5");
    auto curve = small_curve(1);
    curve.c[1] = NAN;
    CHECK_THROWS_AS(shapes.append(0, curve), SolverError);
    CHECK(shapes.count() == 0);
}

TEST_CASE("shapes.h5 holds every column with its unit, and a restart drops what came later") {
    const TemporaryDirectory directory;
    const auto file = directory.path() / "shapes.h5";
    {
        ShapesFile shapes(file);
        for (const double time : {0.0, 0.1, 0.2}) shapes.append(time, small_curve(1 + time));
    }
    ShapesFile continued(file, 0.1);
    CHECK(continued.count() == 2);
    continued.append(0.15, small_curve(9));
    const Hdf5File hdf5(file, Hdf5File::Mode::read);
    CHECK(hdf5.members("/shapes") == std::vector<std::string>{"000000", "000001", "000002"});
    CHECK(hdf5.members("/shapes/000001") ==
          std::vector<std::string>{"c", "kappa", "lambda", "r", "s", "u_r", "u_z", "z"});
    CHECK(hdf5.read_number_attribute("/shapes/000002", "time") == 0.15);
    CHECK(hdf5.read_text_attribute("/shapes/000002/lambda", "unit") == "pN/nm");
    CHECK(hdf5.read_array("/shapes/000002/r") == std::vector<double>{0, 9, 18});
}

TEST_CASE("a checkpoint comes back bit by bit, the one before serves when it is damaged") {
    const TemporaryDirectory directory;
    Checkpoint checkpoint;
    checkpoint.time_us = 0.1;
    checkpoint.scalars["step"] = 1.0 / 3;
    checkpoint.arrays["x"] = {1e-300, -0.0, 3.14};
    checkpoint.arrays["empty"] = {};
    checkpoint.texts["text"] = "µs\n\"";
    CHECK_FALSE(read_checkpoint_file(directory.path()).has_value());
    write_checkpoint_file(directory.path(), checkpoint);
    checkpoint.time_us = 0.2;
    write_checkpoint_file(directory.path(), checkpoint);
    const auto latest = read_checkpoint_file(directory.path());
    REQUIRE(latest.has_value());
    CHECK(latest->time_us == 0.2);
    CHECK(latest->scalars == checkpoint.scalars);
    CHECK(latest->arrays == checkpoint.arrays);
    CHECK(latest->texts == checkpoint.texts);
    CHECK_THROWS_AS(latest->array("none"), IoError);

    std::filesystem::resize_file(directory.path() / "state.h5", 100);
    CHECK(read_checkpoint_file(directory.path())->time_us == 0.1);
    std::ofstream(directory.path() / "state.previous.h5") << "foreign";
    CHECK_THROWS_AS(read_checkpoint_file(directory.path()), IoError);
}

TEST_CASE("how a run goes on says what must change for another end, and from where") {
    const auto sharp = test_engine();
    auto diffuse = sharp, branch = sharp;
    diffuse.name = "phase-field";
    branch.row_order = RowOrder::along_a_branch;
    const Parameters p;
    CHECK(way_on(ExitReason::done, sharp, p, 1) == "; continue with --restart");
    CHECK_THAT(way_on(ExitReason::budded, sharp, p, 1), Contains("output.stop_at_budding = false"));
    CHECK_THAT(way_on(ExitReason::neck_closed, sharp, p, 1),
               Contains("boundary_integral.neck_closed_radius below 0.5 nm"));
    CHECK(way_on(ExitReason::neck_closed, diffuse, p, 1).empty());  // a membrane that came apart stays so
    CHECK_THAT(way_on(ExitReason::interrupted, sharp, p, 0.04), Contains("--restart, which goes on from t = 0.04 µs"));
    CHECK(way_on(ExitReason::done, branch, p, 1).empty());
}

TEST_CASE("events after the point from which a run goes on are forgotten") {
    RunRecord record = {{"events", {{"budding", {{"time_us", 0.8}}}, {"neck_closed", {{"time_us", 2.3}}}}}};
    forget_events_after(record, 0.8);
    CHECK(record["events"].contains("budding"));
    CHECK_FALSE(record["events"].contains("neck_closed"));
}

TEST_CASE("a record says in words what was resolved") {
    RunRecord sharp = new_record(Parameters{}, test_engine());
    CHECK(resolution_in_words(sharp) == "elements as the accuracy asks");
    sharp["notes"] = {
        {"elements", 72}, {"time_tolerance", 1e-4}, {"elements_from", {{{"elements", 54}}, {{"elements", 72}}}}};
    sharp["accuracy"]["resolution"] = {{"largest", 2e-4}};
    CHECK(resolution_in_words(sharp) ==
          "72 elements at the end, 54 at the start, time tolerance 0.0001; relative accuracy 0.001 asked for, 2.0e-04 "
          "reached");
    sharp["engine"] = "statics";
    CHECK(resolution_in_words(sharp) == "72 elements");
    sharp["engine"] = "phase-field";
    CHECK(resolution_in_words(sharp) == "layer of ε = 1.2 nm");
    sharp["notes"]["cell_size_nm"] = 0.625;
    CHECK(resolution_in_words(sharp) == "layer of ε = 1.2 nm on cells of 0.625 nm");
}

TEST_CASE("a run's directory: record, events, restart, and an earlier run that is kept") {
    const TemporaryDirectory directory;
    Parameters parameters;
    parameters.time.end = 2;
    const auto root = directory.path() / "run";
    const auto record = [&] { return nlohmann::json::parse(content(root / "run.json")); };
    {
        RunFiles output(parameters, test_engine(), root, StartMode::fresh);
        CHECK(record()["state"] == "running");
        output.record_step(row_at(0.5));
        output.write_shape(0.5, small_curve(1));
        output.count_rejected_step();
        output.record_event("budding", 0.45, {Neck{5, 60, 0}, 80, 2e4, 1e5});
        output.record_event("budding", 0.46, {});
        output.record_event("neck_closed", 0.5, {{}, 82, 3e4, 2e5});
        Checkpoint checkpoint;
        checkpoint.time_us = 0.5;
        output.write_checkpoint(checkpoint);
        output.record_step(row_at(1.0));
    }
    {
        RunFiles output(parameters, test_engine(), root, StartMode::restart);
        REQUIRE(output.restart_point().has_value());
        CHECK(output.restart_point()->time_us == 0.5);
        const RunObserver observer(parameters, test_engine(), root, true);
        CHECK(observer.restart_point()->time_us == 0.5);
        output.record_step(row_at(2.0));
        output.finish(ExitReason::done);
    }
    const auto final_record = record();
    CHECK(final_record["state"] == "finished");
    CHECK(final_record["exit_reason"] == "done");
    CHECK(final_record["steps"]["accepted"] == 2);
    CHECK(final_record["steps"]["rejected"] == 1);
    CHECK(final_record["restarts"] == 1);
    CHECK(final_record["events"]["budding"] == nlohmann::json({{"time_us", 0.45},
                                                               {"neck_radius_nm", 5},
                                                               {"bud_diameter_nm", 60},
                                                               {"bud_height_nm", 80},
                                                               {"membrane_area_nm2", 2e4},
                                                               {"volume_extracellular_nm3", 1e5}}));
    CHECK(final_record["events"]["neck_closed"]["neck_radius_nm"].is_null());
    CHECK(final_record["events"]["neck_closed"]["bud_height_nm"] == 82);
    CHECK(final_record["parameters"]["molecules"]["patch_radius"] == 36.0);
    CHECK(final_record["provenance"]["libraries"].contains("hdf5"));
#ifdef __clang__
    CHECK_THAT(final_record["provenance"]["compiler"].get<std::string>(), Contains("Clang"));
#else
    CHECK_THAT(final_record["provenance"]["compiler"].get<std::string>(), Contains("GNU"));
#endif

    std::ofstream(root / "movie.mp4") << "drawn from the earlier run";
    RunFiles(parameters, test_engine(), root, StartMode::fresh).finish(ExitReason::done);
    CHECK(nlohmann::json::parse(content(root / "earlier/1/run.json")) == final_record);
    CHECK(std::filesystem::exists(root / "earlier/1/movie.mp4"));
    CHECK(!std::filesystem::exists(root / "movie.mp4"));
    CHECK_THROWS_AS(RunFiles(parameters, test_engine(), directory.path() / "empty", StartMode::restart), IoError);
    auto other = test_engine();
    other.name = "phase-field";
    CHECK_THROWS_AS(RunFiles(parameters, other, root / "earlier/1", StartMode::restart), IoError);
}

TEST_CASE("files that stand in a new run's directory are not written over") {
    const TemporaryDirectory directory;
    std::ofstream(directory.path() / "log.txt") << "of somebody else";
    std::filesystem::create_directory(directory.path() / "checkpoint");  // of a start that was killed: nothing to keep
    RunFiles(Parameters{}, test_engine(), directory.path(), StartMode::fresh).finish(ExitReason::done);
    CHECK(content(directory.path() / "earlier/1/log.txt") == "of somebody else");
    CHECK(!std::filesystem::exists(directory.path() / "earlier/1/checkpoint"));
}

TEST_CASE("a directory that cannot be made is one clear error") {
    const TemporaryDirectory directory;
    std::ofstream(directory.path() / "file") << "x";
    try {
        const RunFiles output(Parameters{}, test_engine(), directory.path() / "file" / "run", StartMode::fresh);
        FAIL("no error");
    } catch (const IoError& error) {
        CHECK(error.code() == ExitCode::io);
        CHECK_THAT(error.what(), Contains("file/run"));
    }
}

TEST_CASE("durations read like a clock") {
    CHECK(format_duration(42) == "0:42");
    CHECK(format_duration(727) == "12:07");
    CHECK(format_duration(11100) == "3:05:00");
    CHECK(format_duration(NAN) == "?");
}

TEST_CASE("the live line fits a terminal of 80 columns, and mu is one of them") {
    HistoryRow row = row_at(12.34567e-5);
    row.step_us = 1.2345e-7;
    row.membrane.neck = Neck{12.345678, 0, 0};
    row.area_strain_max = 1.2345e-10;
    const std::string line = live_text(row, 123.45678, 35999);
    CHECK(std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xc0) != 0x80; }) < 80);
    CHECK_THAT(line, Contains("neck 12.35 nm") && Contains("left 9:59:59"));
}

TEST_CASE("a narrower terminal gets the beginning of the live line, cut between characters") {
    CHECK(clipped("t 1 µs", 5) == "t 1 µ");
    CHECK(clipped("t 1 µs", 4) == "t 1 ");
    CHECK(clipped("t 1 µs", 6) == "t 1 µs");
    CHECK(clipped("t 1 µs", 0) == "t 1 µs");
}

TEST_CASE("checkpoints are frequent while they are cheap, and cost at most a fiftieth of the time") {
    CHECK(checkpoint_pause(30, 0) == 2);     // the first one
    CHECK(checkpoint_pause(30, 0.1) == 10);  // 1 %
    CHECK(checkpoint_pause(30, 0.5) == 30);  // as wanted: between 1 and 2 %
    CHECK(checkpoint_pause(30, 2.4) == 120);
    CHECK(checkpoint_pause(1, 2.4) == 120);
    CHECK(checkpoint_pause(0, 2.4) == 0);
}
