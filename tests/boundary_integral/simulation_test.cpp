// Whole runs through a run directory: the stored early motion and events of the standard case, restart, failure.

#include "runs.h"
#include "shared/support/error.h"

namespace {

using namespace endoflow;
using namespace endoflow::boundary_integral::testing;

struct ReferenceValue {
    double time, value, uncertainty;
};

/// dynamics.csv by quantity; the budding time has no time.
std::map<std::string, ReferenceValue> reference_of_the_standard_case() {
    std::ifstream stream(ENDOFLOW_REFERENCE_DIR "/dynamics.csv");
    std::map<std::string, ReferenceValue> values;
    for (std::string line; std::getline(stream, line);) {
        if (line.starts_with('#') || line.starts_with("quantity")) continue;
        std::istringstream cells(line);
        std::string quantity, time, value, uncertainty;
        std::getline(std::getline(std::getline(cells, quantity, ','), time, ','), value, ',') >> uncertainty;
        values[quantity] = {time.empty() ? 0 : std::stod(time), std::stod(value), std::stod(uncertainty)};
    }
    return values;
}

/// The run ends with the error of this name, whose message names the remedy.
void check_that_it_stops(const Parameters& parameters, const std::filesystem::path& directory, const std::string& name,
                         const std::string& remedy) {
    try {
        run(parameters, directory);
        FAIL("the run must not go on");
    } catch (const SolverError& error) {
        CHECK(error.name() == name);
        CHECK(std::string(error.what()).find(remedy) != std::string::npos);
    }
}

}  // namespace

TEST_CASE("the early motion of the standard case is the reference's", "[run]") {
    const ScratchDirectory scratch("early");
    CHECK(run(standard(60, 0.0125), scratch.path) == ExitReason::done);
    const Table history = read_table(scratch.path / "history.csv");
    const double flat_area = std::acos(-1.0) * 80 * 80;
    int compared = 0;
    for (const auto& row : read_table(ENDOFLOW_REFERENCE_DIR "/early.csv")) {
        const double time = row.at("time_us");
        if (time > 0.0125) break;
        CAPTURE(time);
        ++compared;
        // The reference has about three digits (its first row fewer); linear interpolation between our steps costs
        // 1e-3.
        CHECK(at_time(history, "membrane_area_nm2", time) - flat_area ==
              Approx(row.at("area_gain_nm2")).epsilon(0.005));
        CHECK(at_time(history, "volume_extracellular_nm3", time) ==
              Approx(row.at("extracellular_volume_gain_nm3")).epsilon(0.005));
        CHECK(at_time(history, "bending_energy_pN_nm", time) == Approx(row.at("bending_energy_pN_nm")).epsilon(0.002));
        CHECK(at_time(history, "bud_height_nm", time) == Approx(row.at("max_height_nm")).epsilon(0.01));
    }
    CHECK(compared == 6);
    check_never_rising_energy(history);
    for (const auto& row : history) {
        CHECK(row.at("molecule_mass_nm2") == Approx(history.front().at("molecule_mass_nm2")).epsilon(1e-12));
        CHECK(row.at("force_balance_relative") < 1e-8);
        CHECK(row.at("area_strain_max") < 1e-3);
    }
}

TEST_CASE("a run mirrored in the rim's plane has mirrored measures", "[run]") {
    const ScratchDirectory scratch("inwards"), other_scratch("outwards");
    Parameters parameters = standard(48, 0.05), mirrored = parameters;
    mirrored.membrane.spontaneous_curvature *= -1;
    std::swap(mirrored.fluid.viscosity_extracellular, mirrored.fluid.viscosity_intracellular);
    CHECK(run(parameters, scratch.path) == ExitReason::done);
    CHECK(run(mirrored, other_scratch.path) == ExitReason::done);
    const Table history = read_table(scratch.path / "history.csv"),
                other_history = read_table(other_scratch.path / "history.csv");
    CHECK(history.back().at("bud_height_nm") > 10);
    // The two differ by round-off, some 1e-11 of the first small heights.
    for (const double time : {1e-4, 1e-3, 0.01, 0.05}) {
        CAPTURE(time);
        const auto check = [&](const char* column, double sign) {
            CHECK(at_time(other_history, column, time) == Approx(sign * at_time(history, column, time)).epsilon(1e-9));
        };
        check("bud_height_nm", -1);
        check("volume_extracellular_nm3", -1);
        check("membrane_area_nm2", 1);
        check("bending_energy_pN_nm", 1);
        check("molecule_mass_nm2", 1);
    }
}

TEST_CASE("the standard case buds when and how the reference says", "[run]") {
    const ScratchDirectory scratch("standard");
    CHECK(run(standard(72, 1), scratch.path) == ExitReason::done);
    const Table history = read_table(scratch.path / "history.csv");
    const auto budding = record_of(scratch.path)["events"]["budding"];
    CHECK(budding["neck_radius_nm"].get<double>() == Approx(5).epsilon(1e-9));
    const auto reference = reference_of_the_standard_case();
    REQUIRE(reference.size() == 4);
    const auto check = [&](const char* quantity, double ours, double margin) {
        const ReferenceValue& theirs = reference.at(quantity);
        CHECK(ours == Approx(theirs.value).margin(theirs.uncertainty + margin));
    };
    const auto column = [&](const char* quantity, const char* name) {
        return at_time(history, name, reference.at(quantity).time);
    };
    // Margins: what 72 elements differ from 80 and more (budding 3e-4 µs), and linear interpolation between steps.
    check("budding_time_us", budding["time_us"].get<double>(), 0.003);
    check("membrane_area_nm2", column("membrane_area_nm2", "membrane_area_nm2"), 2);
    check("neck_radius_nm", column("neck_radius_nm", "neck_radius_nm"), 0.02);
    check("lateral_diameter_nm", column("lateral_diameter_nm", "bud_diameter_nm"), 0.02);
    check_never_rising_energy(history);
    for (const auto& row : history) {
        CHECK(row.at("molecule_mass_nm2") == Approx(history.front().at("molecule_mass_nm2")).epsilon(1e-10));
        CHECK(row.at("force_balance_relative") < 1e-8);
    }
}

TEST_CASE("with the consistent convention the patch does not bud", "[run]") {
    const ScratchDirectory scratch("consistent");
    Parameters parameters = standard(48, 1);
    parameters.membrane.curvature_convention = CurvatureConvention::consistent;
    CHECK(run(parameters, scratch.path) == ExitReason::done);
    for (const auto& row : read_table(scratch.path / "history.csv")) CHECK(row.count("neck_radius_nm") == 0);
    CHECK(!record_of(scratch.path)["events"].contains("budding"));
}

TEST_CASE("a restarted run makes the rows it would have made", "[run]") {
    const ScratchDirectory whole("whole"), halves("halves");
    Parameters parameters = standard(32, 0.02);
    parameters.boundary_integral.restart_interval = 8;
    run(parameters, whole.path);
    parameters.time.end = 0.01;
    run(parameters, halves.path);
    const double resumed_at = latest_checkpoint_time(halves.path);
    CHECK(resumed_at > 0.005);
    CHECK(resumed_at < 0.01);
    parameters.time.end = 0.02;
    run(parameters, halves.path, StartMode::restart);
    const Table a = read_table(whole.path / "history.csv"), b = read_table(halves.path / "history.csv");
    REQUIRE(a.size() == b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        for (const auto& [column, value] : a[i]) {
            if (column == "wall_s") continue;
            CAPTURE(i, column);
            // The same operations on the same numbers.
            CHECK(b[i].at(column) == value);
        }
    }
}

TEST_CASE("the number of threads does not matter", "[run][threads]") {
    const auto history_with = [](int threads) {
        const ScratchDirectory scratch("threads");
        Parameters parameters = standard(32, 0.005);
        parameters.boundary_integral.threads = threads;
        run(parameters, scratch.path);
        CHECK(record_of(scratch.path)["threads"] == threads);
        return read_table(scratch.path / "history.csv");
    };
    const Table one = history_with(1);
    for (const int threads : {2, 3}) {
        CAPTURE(threads);
        const Table several = history_with(threads);
        REQUIRE(several.size() == one.size());
        for (std::size_t i = 0; i < one.size(); ++i) {
            for (const auto& [column, value] : one[i]) {
                CAPTURE(i, column);
                // Sums do not go over the borders between the threads' parts: the same operations on the same numbers.
                if (column != "wall_s") CHECK(several[i].at(column) == value);
            }
        }
    }
}

TEST_CASE("a restart after budding goes on through it", "[run]") {
    const ScratchDirectory whole("whole-budding"), halves("halves-budding");
    Parameters parameters = standard(32, 0.9);
    parameters.boundary_integral.restart_interval = 40;
    run(parameters, whole.path);
    parameters.output.stop_at_budding = true;
    CHECK(run(parameters, halves.path) == ExitReason::budded);
    parameters.output.stop_at_budding = false;
    CHECK(run(parameters, halves.path, StartMode::restart) == ExitReason::done);
    const auto a = read_table(whole.path / "history.csv").back(), b = read_table(halves.path / "history.csv").back();
    for (const auto& [column, value] : a) {
        if (column != "wall_s") CHECK(b.at(column) == value);
    }
    CHECK(record_of(halves.path)["events"]["budding"] == record_of(whole.path)["events"]["budding"]);
}

TEST_CASE("a collar sits down where the neck is when it is 10 nm wide, and narrows it faster", "[run]") {
    const ScratchDirectory free("free-neck"), whole("collared"), halves("collared-halves");
    Parameters parameters = standard(32, 0.9);
    parameters.output.stop_at_budding = true;
    run(parameters, free.path);
    parameters.membrane.collar_force = 20;
    parameters.boundary_integral.restart_interval = 60;
    CHECK(run(parameters, whole.path) == ExitReason::budded);
    const auto events = record_of(whole.path)["events"], without = record_of(free.path)["events"];
    const double placed = events["collar"]["time_us"];
    CHECK(events["collar"]["neck_radius_nm"].get<double>() == Approx(10).epsilon(1e-9));
    // Until then both runs are the same.
    CHECK_FALSE(without.contains("collar"));
    const Table rows = read_table(whole.path / "history.csv"), unloaded = read_table(free.path / "history.csv");
    // From then on the collar's power is that of the loads, and the neck is narrower at every time. The
    // balance of energies is as without it.
    double unbalanced = 0;
    for (const auto& row : unloaded) unbalanced = std::max(unbalanced, row.at("energy_balance_relative"));
    for (const auto& row : rows) {
        const double time = row.at("time_us"), power = row.at("load_power_pN_nm_per_us");
        if (time <= placed * (1 + 1e-9)) {
            CHECK(power == 0);
        } else {
            CHECK(power > 0);
            CHECK(row.at("energy_balance_relative") <= unbalanced);
            if (time > placed * 1.001) CHECK(row.at("neck_radius_nm") < at_time(unloaded, "neck_radius_nm", time));
        }
    }
    CHECK(events["budding"]["time_us"].get<double>() < without["budding"]["time_us"].get<double>());
    // A run that is continued after the collar sits knows where. Its first end cuts no step before.
    parameters.time.end = placed + 0.05;
    CHECK(run(parameters, halves.path) == ExitReason::done);
    CHECK(latest_checkpoint_time(halves.path) == placed);
    parameters.time.end = 0.9;
    CHECK(run(parameters, halves.path, StartMode::restart) == ExitReason::budded);
    const auto b = read_table(halves.path / "history.csv").back();
    for (const auto& [column, value] : rows.back()) {
        if (column != "wall_s") CHECK(b.at(column) == value);
    }
}

TEST_CASE("fields are written at their interval, also after a restart", "[run][threads]") {
    const ScratchDirectory whole("whole-fields"), halves("halves-fields");
    Parameters parameters = standard(32, 0.002);
    parameters.output.field_interval = 0.0005;
    parameters.boundary_integral.field_spacing = 20;
    parameters.boundary_integral.threads = 2;
    parameters.boundary_integral.restart_interval = 8;
    run(parameters, whole.path);
    parameters.time.end = 0.0012;
    run(parameters, halves.path);
    parameters.time.end = 0.002;
    run(parameters, halves.path, StartMode::restart);
    const auto read = [](const fs::path& file) {
        std::ifstream stream(file);
        return std::string(std::istreambuf_iterator<char>(stream), {});
    };
    CHECK(read(whole.path / "fields.pvd") == read(halves.path / "fields.pvd"));
    CHECK(fs::exists(whole.path / "fields" / "fields_000004.vtu"));
    CHECK(!fs::exists(whole.path / "fields" / "fields_000005.vtu"));
    CHECK(read(whole.path / "fields" / "fields_000002.vtu") == read(halves.path / "fields" / "fields_000002.vtu"));

    parameters.output.field_interval = 0;
    run(parameters, whole.path);
    CHECK(!fs::exists(whole.path / "fields.pvd"));
}

TEST_CASE("a membrane that comes too near a wall stops the run with a name and a remedy", "[run]") {
    const ScratchDirectory scratch("wall");
    Parameters parameters = standard(32, 1);
    parameters.domain.height = 90;
    check_that_it_stops(parameters, scratch.path, "membrane-near-wall", "domain.height");
}

TEST_CASE("a stiffness that is negative beside the coat stops the run with a name and a remedy", "[run]") {
    const ScratchDirectory scratch("stiffness");
    Parameters parameters = standard(32, 1);
    parameters.membrane.bending_stiffness_coated = 1e5;  // b(c) < 0 for c < -1/999
    check_that_it_stops(parameters, scratch.path, "negative-stiffness", "membrane.constitutive_law");
    CHECK(read_table(scratch.path / "history.csv").size() > 3);
}

TEST_CASE("without a fluid the standard case pinches off and ends well", "[run]") {
    const ScratchDirectory scratch("geometric");
    Parameters parameters = standard(60, 30);
    parameters.fluid.dynamics = Dynamics::geometric;
    parameters.output.shape_interval = 5;
    CHECK(run(parameters, scratch.path) == ExitReason::neck_closed);
    const auto events = record_of(scratch.path)["events"];
    CHECK(events["neck_closed"]["neck_radius_nm"].get<double>() == Approx(0.5).epsilon(1e-9));
    CHECK(events["budding"]["time_us"].get<double>() < events["neck_closed"]["time_us"].get<double>());
    const Table history = read_table(scratch.path / "history.csv");
    CHECK(history.back().at("neck_radius_nm") == Approx(0.5).epsilon(1e-9));
    for (const auto& row : history) {
        CHECK(row.at("molecule_mass_nm2") == Approx(history.front().at("molecule_mass_nm2")).epsilon(1e-10));
    }
}

TEST_CASE("a prolate vesicle relaxes at constant area and volume", "[run]") {
    const ScratchDirectory scratch("vesicle");
    Parameters parameters = standard(40, 10);
    parameters.domain.kind = DomainKind::free_space;
    parameters.molecules.patch_radius = 1e4;  // coated everywhere
    parameters.membrane.bending_stiffness_coated = 100;
    parameters.membrane.spontaneous_curvature = 0;
    parameters.fluid.viscosity_intracellular = GENERATE(1e-3, 1e-2);
    parameters.output.shape_interval = 5;
    CHECK(run(parameters, scratch.path) == ExitReason::done);
    const Table history = read_table(scratch.path / "history.csv");
    const double area = history.front().at("membrane_area_nm2");
    const double volume = history.front().at("volume_extracellular_nm3");
    for (const auto& row : history) {
        CHECK(row.at("membrane_area_nm2") == Approx(area).epsilon(1e-6));
        CHECK(row.at("volume_extracellular_nm3") == Approx(volume).epsilon(1e-6));
        CHECK(row.count("neck_radius_nm") == 0);
    }
    for (std::size_t i = 1; i < history.size(); ++i) {
        const double before = history[i - 1].at("bending_energy_pN_nm"), after = history[i].at("bending_energy_pN_nm");
        const double stretch = history[i].at("membrane_area_nm2") / history[i - 1].at("membrane_area_nm2") - 1;
        // Near equilibrium what is left of the energy's change is the tension times the area's drift.
        CHECK(after < before * (1 + 1e-12 + 5 * std::abs(stretch)));
    }
    CHECK(history.back().at("bending_energy_pN_nm") < 0.999 * history.front().at("bending_energy_pN_nm"));
}

TEST_CASE("what the engine does not offer is refused as input", "[run]") {
    const ScratchDirectory scratch("refused");
    Parameters parameters = standard(32, 0.001);
    parameters.fluid.inertia = true;
    CHECK_THROWS_AS(run(parameters, scratch.path), InputError);

    parameters.fluid.inertia = false;
    parameters.domain.kind = DomainKind::free_space;
    parameters.domain.spheroid_polar_axis = parameters.domain.spheroid_equatorial_axis = 50;
    CHECK_THROWS_AS(run(parameters, scratch.path), InputError);
}
