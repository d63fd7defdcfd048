// Runs whose resolution is chosen: as accurate as asked for, more elements on the way, the same when continued.

#include <algorithm>

#include "runs.h"

namespace {

using namespace endoflow;
using namespace endoflow::boundary_integral::testing;

double budding_time(const fs::path& directory) {
    return record_of(directory)["events"]["budding"]["time_us"].get<double>();
}

Parameters to_budding(double end) {
    Parameters parameters;
    parameters.time.end = end;
    parameters.output.stop_at_budding = true;
    parameters.output.field_interval = 0;
    return parameters;
}

// An edge so narrow that its first elements last 0.12 µs.
constexpr double elements_last = 0.12, end_of_refined = 0.13;  // µs

Parameters short_of_elements() {
    Parameters parameters = to_budding(end_of_refined);
    parameters.molecules.interface_width = 0.15;
    parameters.fluid.viscosity_intracellular = 1e-3;
    return parameters;
}

}  // namespace

TEST_CASE("the standard case is as accurate as asked for, without any override", "[run]") {
    const ScratchDirectory scratch("accuracy");
    CHECK(run(to_budding(1), scratch.path) == ExitReason::budded);
    CHECK(budding_time(scratch.path) == Approx(0.8259243).epsilon(1e-3));
    const auto record = record_of(scratch.path);
    CHECK(record["alarms"].empty());
    CHECK(record["accuracy"]["resolution"]["largest"].get<double>() < 1e-3);
    CHECK(record["notes"]["time_tolerance"] == 1e-4);
    const Table history = read_table(scratch.path / "history.csv");
    check_never_rising_energy(history);
    const double mass = history.front().at("molecule_mass_nm2");
    for (const auto& row : history) {
        CHECK(std::abs(row.at("molecule_mass_nm2") / mass - 1) < 1e-11);
        CHECK(row.at("force_balance_relative") < 1e-10);
    }
}

TEST_CASE("a run that needs more elements gets them, and loses nothing", "[run]") {
    const ScratchDirectory scratch("refined");
    run(short_of_elements(), scratch.path);
    const auto record = record_of(scratch.path);
    const auto counts = record["notes"]["elements_from"];
    REQUIRE(counts.size() > 1);
    CHECK(counts.back()["elements"] == record["notes"]["elements"]);
    for (std::size_t i = 1; i < counts.size(); ++i) {
        CHECK(counts[i]["elements"] > counts[i - 1]["elements"]);
        CHECK(counts[i]["time_us"] > counts[i - 1]["time_us"]);
    }
    CHECK(record["accuracy"]["resolution"]["largest"].get<double>() < 1e-3);
    const Table history = read_table(scratch.path / "history.csv");
    // Where c is interpolated at the limit of what the elements resolve, Cahn-Hilliard smooths it afterwards and knows
    // nothing of bending: the energy rises by up to the square of the accuracy asked for, 10⁻³, in each of three steps.
    for (std::size_t i = 1; i < history.size(); ++i)
        CHECK(history[i].at("bending_energy_pN_nm") < history[i - 1].at("bending_energy_pN_nm") * (1 + 1e-6));
    const double mass = history.front().at("molecule_mass_nm2");
    for (const auto& row : history) CHECK(std::abs(row.at("molecule_mass_nm2") / mass - 1) < 1e-11);
    CHECK(record["steps"]["accepted"] == record["notes"]["integrator"]["steps"]);
}

TEST_CASE("a run that gets more elements goes on from a checkpoint as if it had not been interrupted", "[run]") {
    const ScratchDirectory whole("whole-refined"), parts("parts-refined");
    Parameters parameters = short_of_elements();
    parameters.boundary_integral.restart_interval = 25;
    run(parameters, whole.path);
    const double middle = 0.5 * (elements_last + end_of_refined);
    for (const double end : {0.05, middle, end_of_refined}) {
        parameters.time.end = end;
        run(parameters, parts.path, end > 0.05 ? StartMode::restart : StartMode::fresh);
    }
    CHECK(record_of(whole.path)["notes"]["elements_from"].size() > 1);
    CHECK(record_of(parts.path)["notes"]["elements_from"] == record_of(whole.path)["notes"]["elements_from"]);
    const Table a = read_table(whole.path / "history.csv"), b = read_table(parts.path / "history.csv");
    REQUIRE(a.size() == b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        for (const auto& [column, value] : a[i]) {
            CAPTURE(i, column);
            if (column != "wall_s") CHECK(b[i].at(column) == value);
        }
    }
}

TEST_CASE("a run that is less accurate than asked for says so", "[run]") {
    const ScratchDirectory scratch("inaccurate");
    Parameters parameters = to_budding(1e-3);
    parameters.boundary_integral.elements = 16;
    run(parameters, scratch.path);
    const auto alarms = record_of(scratch.path)["alarms"];
    const auto alarm = std::ranges::find_if(alarms, [](const auto& one) { return one["name"] == "resolution"; });
    REQUIRE(alarm != alarms.end());
    CHECK((*alarm)["bound"] == parameters.boundary_integral.accuracy);
}
