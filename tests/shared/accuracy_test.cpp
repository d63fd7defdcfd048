#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "run_helpers.h"
#include "shared/output/accuracy.h"
#include "temporary_directory.h"

using namespace endoflow;
using Catch::Matchers::Contains;

namespace {

EngineIdentity sharp_engine() {
    auto engine = test_engine();
    engine.history_columns = {{"energy_balance_relative", ""},
                              {"force_balance_relative", ""},
                              {"net_flux_relative", ""},
                              {"area_balance_relative", ""}};
    return engine;
}

EngineIdentity diffuse_engine(const std::string& second_column) {
    return {.name = "phase-field",
            .libraries = {},
            .history_columns = {{"energy_law_residual_pN_nm_per_us", ""}, {second_column, ""}}};
}

HistoryRow balanced_row(double time, double energy_balance = 0) {
    return row_at(time, {energy_balance, 0, 0, 0});
}

}  // namespace

TEST_CASE("a quantity that leaves its bound is one alarm in run.json, its largest value is kept through a restart") {
    const TemporaryDirectory directory;
    const auto root = directory.path() / "run";
    const auto record = [&] { return nlohmann::json::parse(content(root / "run.json")); };
    {
        RunOutput output(Parameters{}, sharp_engine(), root, StartMode::fresh);
        output.record_step(balanced_row(0.1, 5e-7));
        output.write_shape(0.1, small_curve(1));
        CHECK(record()["alarms"].empty());
        output.record_step(balanced_row(0.2, 4e-3));
        REQUIRE(record()["alarms"].size() == 1);
        output.record_step(balanced_row(0.3, 8e-3));
        output.record_step(balanced_row(0.4, 6e-3));
        Checkpoint checkpoint;
        checkpoint.time_us = 0.4;
        output.write_checkpoint(checkpoint);
    }
    RunOutput output(Parameters{}, sharp_engine(), root, StartMode::restart);
    output.record_step(balanced_row(0.5, 7e-3));
    output.finish(ExitReason::done);
    const auto alarms = record()["alarms"];
    REQUIRE(alarms.size() == 1);
    CHECK(alarms[0]["name"] == "energy-balance");
    CHECK(alarms[0]["time_us"] == 0.2);
    CHECK(alarms[0]["value"] == 4e-3);
    CHECK(alarms[0]["bound"] == 1e-3);
    CHECK_THAT(alarms[0]["remedy"].get<std::string>(), Contains("boundary_integral.elements"));
    const auto largest = record()["accuracy"]["energy-balance"];
    CHECK(largest["largest"] == 8e-3);
    CHECK(largest["time_us"] == 0.3);
}

TEST_CASE("beyond its limit a quantity stops the run under its own name") {
    const TemporaryDirectory directory;
    RunOutput output(Parameters{}, sharp_engine(), directory.path() / "run", StartMode::fresh);
    const RunOutput observer(Parameters{}, sharp_engine(), directory.path() / "run", StartMode::fresh,
                             OutputRole::observer);
    try {
        output.record_step(balanced_row(0.1, 0.6));
        FAIL("no error");
    } catch (const SolverError& error) {
        CHECK(error.name() == "energy-balance");
        CHECK_THAT(error.what(), Contains("0.6") && Contains("boundary_integral.elements"));
    }
}

TEST_CASE("rates of a row that settles after a change of the mesh say nothing, states do") {
    const TemporaryDirectory directory;
    RunOutput output(Parameters{}, sharp_engine(), directory.path() / "run", StartMode::fresh);
    HistoryRow row = balanced_row(0.1, 0.6);
    row.settling = true;
    CHECK_NOTHROW(output.record_step(row));
    row.time_us = 0.2;
    row.settling = false;
    CHECK_THROWS_AS(output.record_step(row), SolverError);
}

TEST_CASE("a membrane that stretches freely need not grow by what flows in") {
    const auto grows_by_itself = [](const Parameters& p) {
        const TemporaryDirectory directory;
        RunOutput output(p, sharp_engine(), directory.path() / "run", StartMode::fresh);
        output.record_step(row_at(0.1, {0, 0, 0, 0.98}));
    };
    Parameters stretches;
    stretches.membrane.inextensible = false;
    CHECK_NOTHROW(grows_by_itself(stretches));
    CHECK_THROWS_AS(grows_by_itself(Parameters{}), SolverError);
}

TEST_CASE("drifts count from the first row, residuals of the energy law add up over time") {
    const AccuracyWatch watch(Parameters{}, diffuse_engine("thickness_error_max"));
    RunRecord record;
    HistoryRow row = row_at(0, {0, 0});
    row.membrane.bending_energy = 1000;
    row.membrane.molecule_mass = 50;
    CHECK(watch.look_at(row, record).empty());
    row.time_us = row.step_us = 0.5;
    row.extra = {12, 0};  // 6 of 1000 pN nm
    row.membrane.molecule_mass = 50.1;
    const auto drift = watch.look_at(row, record);
    REQUIRE(drift.size() == 1);
    CHECK(drift[0].name == "mass-drift");
    CHECK(drift[0].value == Approx(2e-3));
    row.time_us = 1;
    const auto law = watch.look_at(row, record);
    REQUIRE(law.size() == 1);
    CHECK(law[0].name == "energy-law");
    CHECK(law[0].value == Approx(12e-3));
}

TEST_CASE("the energy law is seen against the largest energy, that of the edge included") {
    const AccuracyWatch watch(Parameters{}, diffuse_engine("line_energy_pN_nm"));
    RunRecord record;
    HistoryRow row = row_at(0, {0, 4000});  // a domain that costs its edge alone
    row.membrane.bending_energy = 1;
    CHECK(watch.look_at(row, record).empty());
    row.time_us = row.step_us = 0.5;
    row.membrane.bending_energy = 1999;
    row.extra = {200, 3001};
    const auto law = watch.look_at(row, record);
    REQUIRE(law.size() == 1);
    CHECK(law[0].value == Approx(0.02));
    row.membrane.bending_energy = 0;
    row.extra = {0, 1000};
    CHECK(watch.look_at(row, record).empty());
    CHECK(record["accuracy"]["energy-law"]["largest"].get<double>() == Approx(0.02));
}

TEST_CASE("the energy law of a flat membrane that a force begins to pull is seen against the force's work") {
    const AccuracyWatch watch(Parameters{}, diffuse_engine("load_power_pN_nm_per_us"));
    RunRecord record;
    HistoryRow row = row_at(0, {0, 0});
    CHECK(watch.look_at(row, record).empty());
    row.time_us = row.step_us = 1e-3;
    row.membrane.bending_energy = 0.01;
    row.extra = {1e4, 7e6};  // 10 pN nm is a thousand times the energy, and a 700th of the work
    CHECK(watch.look_at(row, record).empty());
    CHECK(record["accuracy"]["energy-law"]["largest"].get<double>() == Approx(1.0 / 700));
    row.extra = {2e5, -7e6};  // the work of both signs: 14 000 pN nm
    CHECK(watch.look_at(row, record).size() == 1);
    CHECK(record["accuracy"]["energy-law"]["largest"].get<double>() == Approx(0.015));
}

TEST_CASE("what is lost of a membrane at rest is seen against the level of rest") {
    Parameters bare;
    bare.membrane.bending_stiffness = bare.membrane.bending_stiffness_coated = 100;  // β = 50 pN nm, as printed
    const AccuracyWatch watch(bare, diffuse_engine("thickness_error_max"));
    RunRecord record;
    HistoryRow row = row_at(0, {0, 0});
    row.membrane.bending_energy = 1e-13;
    row.membrane.molecule_mass = 1e-12;
    CHECK(watch.look_at(row, record).empty());
    row.time_us = row.step_us = 1;
    row.extra = {1e-12, 0};  // ten times the energy
    row.membrane.molecule_mass = 2e-12;
    CHECK(watch.look_at(row, record).empty());
    CHECK(record["accuracy"]["energy-law"]["largest"].get<double>() == Approx(1e-12 / 50));
    CHECK(record["accuracy"]["mass-drift"]["largest"].get<double>() < 1e-12);
    row.extra = {1, 0};  // a fiftieth of β is a motion
    CHECK(watch.look_at(row, record).size() == 1);
}

TEST_CASE("a membrane that may stretch raises no alarm of strain") {
    HistoryRow row = balanced_row(0.1);
    row.area_strain_max = 0.5;
    for (const Dynamics dynamics : {Dynamics::flow, Dynamics::geometric}) {
        Parameters parameters;
        parameters.fluid.dynamics = dynamics;
        RunRecord record;
        CHECK(AccuracyWatch(parameters, sharp_engine()).look_at(row, record).size() ==
              (dynamics == Dynamics::flow ? 1 : 0));
    }
}

TEST_CASE("a layer that is thick for its neck is an alarm of scheme `production`, and never the end") {
    RunRecord record;
    const HistoryRow thin = row_at(0.1, {0, 0.086}), thick = row_at(0.2, {0, 0.13}), thicker = row_at(0.3, {0, 5});
    Parameters parameters;
    const AccuracyWatch watch(parameters, diffuse_engine("layer_at_neck_relative"));
    CHECK(watch.look_at(thin, record).empty());
    const auto alarms = watch.look_at(thick, record);
    REQUIRE(alarms.size() == 1);
    CHECK(alarms[0].name == "layer-at-neck");
    CHECK_NOTHROW(watch.look_at(thicker, record));
    parameters.phase_field.scheme = PhaseFieldScheme::paper;
    RunRecord printed;
    CHECK(AccuracyWatch(parameters, diffuse_engine("layer_at_neck_relative")).look_at(thick, printed).empty());
}

TEST_CASE("every bound is below its limit, names what to change, and belongs to an engine") {
    for (const AccuracyBound& bound : accuracy_bounds()) {
        INFO(bound.engine << " " << bound.name);
        CHECK(bound.bound < bound.limit);
        CHECK_FALSE(bound.remedy.empty());
        CHECK((bound.engine == "boundary-integral" || bound.engine == "phase-field"));
        CHECK_THAT(render_accuracy_markdown(), Contains("`" + bound.name + "`"));
    }
}

TEST_CASE("the documentation's tables of bounds and of the columns that all histories have are the program's") {
    const std::string page = content(ENDOFLOW_DOCS "/outputs.md");
    CHECK_THAT(page, Contains(render_accuracy_markdown()));
    CHECK_THAT(page, Contains(columns_as_markdown(all_columns({}))));
}
