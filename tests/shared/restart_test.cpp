#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <map>

#include "run_helpers.h"
#include "shared/output/checkpoint_file.h"
#include "shared/output/hdf5_file.h"
#include "shared/output/run_lock.h"
#include "shared/parameters/parameter_table.h"
#include "shared/support/version.h"
#include "temporary_directory.h"

using namespace endoflow;
using Catch::Matchers::Contains;

namespace {

/// Every file of a directory with its content.
std::map<std::string, std::string> files(const std::filesystem::path& root) {
    std::map<std::string, std::string> found;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root))
        if (entry.is_regular_file()) found[entry.path().string()] = content(entry.path());
    return found;
}

void finish_run(const std::filesystem::path& root) {
    Parameters parameters;
    parameters.time.end = 1.5;
    RunFiles output(parameters, test_engine(), root, StartMode::restart);
    output.record_step(row_at(1.5));
    output.write_shape(1.5, small_curve(3));
    output.finish(ExitReason::done);
}

}  // namespace

TEST_CASE("a kill while shapes.h5 is being written loses no shape: the checkpoint has a copy") {
    const TemporaryDirectory directory;
    const auto root = directory.path() / "run";
    const auto shapes_left = [&] { return Hdf5File(root / "shapes.h5", Hdf5File::Mode::read).members("/shapes"); };
    leave_killed_run(root);
    for (const std::uintmax_t size : {0U, 100U, 1000U, 3000U}) {
        std::filesystem::resize_file(root / "shapes.h5", size);
        CHECK(refusal_to_restart(root).empty());
        CHECK(shapes_left() == std::vector<std::string>{"000000"});
    }
    std::filesystem::remove(root / "shapes.h5");
    CHECK(refusal_to_restart(root).empty());
    CHECK(shapes_left().size() == 1);
}

TEST_CASE("a history that lost rows is not continued, and not touched") {
    const TemporaryDirectory directory;
    const auto root = directory.path() / "run", file = root / "history.csv";
    leave_killed_run(root);
    const std::string whole = content(file);
    const auto second_row = whole.find("\n0.5,") + 1;
    const auto damaged = [&](const std::string& text) {
        std::ofstream(file, std::ios::trunc) << text;
        std::string message = refusal_to_restart(root);
        CHECK(content(file) == text);
        return message;
    };
    CHECK_THAT(damaged(whole.substr(0, second_row)), Contains("1 intact rows") && Contains("written 2"));
    CHECK_THAT(damaged(whole.substr(0, second_row + 4)), Contains("1 intact rows"));
    CHECK_THAT(damaged(whole.substr(0, second_row) + std::string(40, '\0') + "\n"), Contains("1 intact rows"));
    CHECK_THAT(damaged(whole.substr(0, second_row) + "0.5,nan\n" + whole.substr(second_row)),
               Contains("1 intact rows"));
    CHECK_THAT(damaged(""), Contains("its columns are not"));
    std::filesystem::remove(file);
    CHECK_THAT(refusal_to_restart(root), Contains("history.csv"));

    std::ofstream(file) << whole << "1.5,torn";
    CHECK(refusal_to_restart(root).empty());
    CHECK(content(file) == whole.substr(0, whole.find("\n1,") + 1));
}

TEST_CASE("checkpoints that are not ours, or not whole, are one clear error") {
    const TemporaryDirectory directory;
    const auto root = directory.path() / "run", file = root / "checkpoint" / "state.h5";
    leave_killed_run(root);
    const std::string whole = content(file);
    for (const double part : {0.0, 0.1, 0.5, 0.9, 0.99}) {
        std::ofstream(file, std::ios::trunc | std::ios::binary)
            << whole.substr(0, static_cast<std::size_t>(part * static_cast<double>(whole.size())));
        CHECK_THAT(refusal_to_restart(root), Contains("state.h5"));
    }
    const auto foreign_record = [&](const std::string& text) {
        Checkpoint checkpoint;
        checkpoint.time_us = 0.5;
        checkpoint.texts["run_record"] = text;
        write_checkpoint_file(root / "checkpoint", checkpoint);
        return refusal_to_restart(root);
    };
    CHECK_THAT(foreign_record("{"), Contains("damaged run record"));
    CHECK_THAT(foreign_record("[]"), Contains("run record"));
    CHECK_THAT(foreign_record("{\"engine\": 3}"), Contains("run record"));
    CHECK_THAT(foreign_record("{\"engine\": \"test\", \"restarts\": \"x\"}"), Contains("run record"));
}

TEST_CASE("a restart that asks for no more than there is changes nothing") {
    const TemporaryDirectory directory;
    const auto root = directory.path() / "run";
    leave_killed_run(root);
    const auto restart = [&](double end) {
        Parameters parameters;
        parameters.time.end = end;
        const RunFiles output(parameters, test_engine(), root, StartMode::restart);
        return output.nothing_to_do();
    };
    const auto before = files(root);
    CHECK(restart(0.01));  // before the checkpoint
    CHECK(restart(0.5));
    CHECK(restart(0.9));  // before the last row: a shorter run than the one that was killed
    CHECK(files(root) == before);
    finish_run(root);
    const auto finished = files(root);
    CHECK(restart(1.5));
    CHECK(restart(0.6));
    CHECK(files(root) == finished);
    CHECK_FALSE(restart(1.6));
}

TEST_CASE("a run that was killed between its last row and its end is completed") {
    const TemporaryDirectory directory;
    const auto root = directory.path() / "run";
    leave_killed_run(root);
    Parameters parameters;
    parameters.time.end = 1;  // the time of its last row
    CHECK_FALSE(RunFiles(parameters, test_engine(), root, StartMode::restart).nothing_to_do());
}

TEST_CASE("a restart with another problem is refused by name and changes nothing, with other output it is recorded") {
    const TemporaryDirectory directory;
    const auto root = directory.path() / "run";
    leave_killed_run(root);
    const auto before = files(root);
    const Parameters same;
    for (const ParameterRow& row : parameter_table()) {
        INFO(row.name());
        const ParameterValue old_value = row.get(same);
        Parameters changed;
        if (const auto* number = std::get_if<double>(&old_value))
            row.set(changed, *number == 0 ? 1 : 1.5 * *number);
        else if (const auto* integer = std::get_if<long long>(&old_value))
            row.set(changed, *integer + 1);
        else if (const auto* numbers = std::get_if<std::array<double, 2>>(&old_value))
            row.set(changed, std::array{numbers->front(), numbers->back() + 1});
        else if (const auto* flag = std::get_if<bool>(&old_value))
            row.set(changed, !*flag);
        else
            row.set(changed, row.choices.empty()                                      ? "other"
                             : row.choices.back() == std::get<std::string>(old_value) ? row.choices.front()
                                                                                      : row.choices.back());
        // The test's engine is the sharp one, which reads no key of the other's sections.
        if (row.free_on_restart || row.section.starts_with("phase_field")) continue;
        CHECK_THAT(refusal_to_restart(root, changed), Contains(row.name() + " = ") && Contains("cannot change"));
        CHECK(files(root) == before);
    }
    Parameters longer;
    longer.time.end = 30;
    longer.output.shape_interval = 0.1;
    longer.time.tolerance = 1e-5;
    CHECK(refusal_to_restart(root, longer).empty());
    const auto segments = nlohmann::json::parse(content(root / "run.json")).at("segments");
    REQUIRE(segments.size() == 2);
    CHECK(segments[0]["begin_us"] == 0.0);
    CHECK(segments[0]["parameters"]["time.end"] == Parameters{}.time.end);
    CHECK(segments[1]["begin_us"] == 0.5);
    CHECK(segments[1]["version"] == version());
    CHECK(segments[1]["git"] == git_description());
    CHECK(segments[1]["parameters"]["time.end"] == 30.0);
    CHECK(segments[1]["parameters"]["time.tolerance"] == 1e-5);
}

TEST_CASE("a damaged copy of the shapes never replaces intact shapes, and is named") {
    const TemporaryDirectory directory;
    const auto root = directory.path() / "run", copy = root / "checkpoint" / "shapes.h5", shapes = root / "shapes.h5";
    leave_killed_run(root);
    const std::string intact = content(copy), whole = content(shapes);
    for (const std::size_t place : {intact.size() / 4, intact.size() / 2, 3 * intact.size() / 4}) {
        INFO(place);
        std::filesystem::remove(copy);
        std::ofstream(copy, std::ios::binary) << intact.substr(0, place);
        std::ofstream(shapes, std::ios::binary | std::ios::trunc) << whole;
        CHECK(refusal_to_restart(root).empty());
        CHECK(Hdf5File(shapes, Hdf5File::Mode::read).members("/shapes").size() == 1);

        std::ofstream(shapes, std::ios::binary | std::ios::trunc) << whole.substr(0, whole.size() / 2);
        const auto before = files(root);
        CHECK_THAT(refusal_to_restart(root), Contains("checkpoint/shapes.h5: cannot"));
        CHECK(files(root) == before);
    }
}

TEST_CASE("a run's directory belongs to one run at a time") {
    const TemporaryDirectory directory;
    const auto root = directory.path() / "run";
    leave_killed_run(root);
    {
        const RunFiles holder(Parameters{}, test_engine(), root, StartMode::restart);
        const auto before = files(root);
        for (const StartMode mode : {StartMode::fresh, StartMode::restart}) {
            try {
                const RunFiles second(Parameters{}, test_engine(), root, mode);
                FAIL("no error");
            } catch (const IoError& error) {
                CHECK_THAT(error.what(),
                           Contains(root.string() + ": in use by process " + std::to_string(getpid()) + " on ") &&
                               Contains(" since 20"));
            }
        }
        CHECK(files(root) == before);
    }
    CHECK_FALSE(std::filesystem::exists(root / "lock"));
}

TEST_CASE("a lock that a killed process left behind holds nobody up, one of another host is told of") {
    const TemporaryDirectory directory;
    const RunDirectory run{directory.path()};
    std::ofstream(run.lock()) << "process 1 on " << host_name() << " since 2026-01-01T00:00:00Z";
    CHECK(RunLock(run).doubt().empty());
    std::ofstream(run.lock()) << "process 1 on elsewhere.example since 2026-01-01T00:00:00Z";
    CHECK_THAT(RunLock(run).doubt(), Contains("elsewhere.example") && Contains("no longer runs"));
}
