// Modes of a finished run, from its directory.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "boundary_integral/modes/noise_ensemble.h"
#include "boundary_integral/modes/noise_growth.h"
#include "boundary_integral/modes/perturbation_growth.h"
#include "boundary_integral/modes/run_modes.h"
#include "boundary_integral/modes/spectrum.h"
#include "boundary_integral/modes/thermal_noise.h"
#include "boundary_integral/simulation.h"
#include "shared/output/hdf5_file.h"
#include "shared/output/run_files.h"
#include "shared/support/error.h"

namespace {

using namespace endoflow;
using namespace endoflow::boundary_integral;
namespace fs = std::filesystem;

struct ScratchDirectory {
    fs::path path = fs::temp_directory_path() / "endoflow-modes-test";
    ScratchDirectory() { fs::remove_all(path); }
    ~ScratchDirectory() { fs::remove_all(path); }
};

Parameters short_run() {
    Parameters parameters;
    parameters.boundary_integral.elements = 40;
    parameters.molecules.interface_width = 5;
    parameters.time.end = 0.2;
    parameters.output.shape_interval = 0.05;
    parameters.output.field_interval = 0;
    return parameters;
}

// growth_per_us of the fastest eigenmode, by (time, mode) in the file's order.
std::vector<double> growth_rates(const fs::path& file) {
    std::ifstream stream(file);
    std::vector<double> rates;
    std::string line;
    std::getline(stream, line);
    while (std::getline(stream, line)) {
        std::istringstream cells(line);
        std::vector<std::string> values;
        for (std::string cell; std::getline(cells, cell, ',');) values.push_back(cell);
        if (values[2] == "0") rates.push_back(std::stod(values[3]));
    }
    return rates;
}

}  // namespace

TEST_CASE("the modes of a run's directory are those of its shapes", "[modes]") {
    const ScratchDirectory scratch;
    const Parameters parameters = short_run();
    {
        RunFiles output(parameters, identity(parameters), scratch.path, StartMode::fresh);
        output.finish(simulate(parameters, output));
    }
    const RecordedRun run(scratch.path);
    REQUIRE(run.times().size() == 13);  // at the start, eight within the first interval, at four multiples of it
    CHECK(run.parameters().boundary_integral.elements == 40);

    std::size_t lines = 0;
    write_modes({scratch.path, scratch.path / "modes", 1, 2, 3, 1e-2}, [&](const std::string&) { ++lines; });
    CHECK(lines == 5);  // how far the record is, three times, how many steps
    const std::vector<double> rates = growth_rates(scratch.path / "modes" / "modes.csv");
    REQUIRE(rates.size() == 6);
    for (const double rate : rates) CHECK(std::isfinite(rate));
    const Hdf5File shapes(scratch.path / "modes" / "eigenshapes.h5", Hdf5File::Mode::read);
    CHECK(shapes.read_number_attribute("/times/000002", "time") == Approx(0.2));
    CHECK(shapes.read_number_attribute("/times/000002/mode_2", "growth_per_us") == Approx(rates[5]).epsilon(1e-7));
    const std::vector<double> w = shapes.read_array("/times/000002/mode_2/w");
    CHECK(w.size() == 321);
    CHECK(*std::max_element(w.begin(), w.end()) == Approx(1).epsilon(1e-12));  // largest displacement: 1 nm, real
}

TEST_CASE("perturbations of a run's start: the worst is worse than any other", "[modes]") {
    const ScratchDirectory scratch;
    const Parameters parameters = short_run();
    {
        RunFiles output(parameters, identity(parameters), scratch.path, StartMode::fresh);
        output.finish(simulate(parameters, output));
    }
    const AlongRun run(RecordedRun(scratch.path), 1, 2);
    CHECK(run.distance() < 0.01);  // a tenth of it are chords instead of arcs; the run's tolerance is 1e-4 nm a step
    PerturbationGrowth growth(run, 1e-2);
    for (const Perturbation& p : growth.perturbations(2)) {
        if (p.initial == "coat") continue;  // no displacement
        CHECK(p.peak == Approx(initial_amplitude).epsilon(1e-9));
        CHECK(p.gain.value() == Approx(1).epsilon(1e-9));
    }
    growth.advance(0.02);
    for (const int mode : {1, 2}) {
        const std::vector<Perturbation> perturbations = growth.perturbations(mode);
        REQUIRE(perturbations.size() == 5);
        const Perturbation& worst = perturbations.back();
        CHECK(worst.initial == "worst");
        for (const Perturbation& p : perturbations) {
            if (p.gain) CHECK(*p.gain <= *worst.gain * (1 + 1e-9));
        }
        CHECK(growth.worst_at_start(mode).peak == Approx(initial_amplitude).epsilon(1e-9));
    }
}

TEST_CASE("thermal noise about a run: from equilibrium on, carried by the propagator", "[modes]") {
    const ScratchDirectory scratch;
    Parameters parameters = short_run();
    parameters.time.end = 0.05;
    {
        RunFiles output(parameters, identity(parameters), scratch.path, StartMode::fresh);
        output.finish(simulate(parameters, output));
    }
    const AlongRun run(RecordedRun(scratch.path), 1, 2);
    constexpr double temperature = 310;
    NoiseGrowth noise(run, temperature, 1e-2);
    // k_B T times the compliance of a clamped plate at its middle, R^2/(16 pi beta); its kink there is a spline's.
    const double compliance = std::pow(parameters.domain.radius, 2) /
                              (16 * std::numbers::pi * BendingModel(parameters.membrane).stiffness(0).value);
    CHECK(noise.shape().height_spread.total ==
          Approx(std::sqrt(boltzmann_constant * temperature * compliance)).epsilon(1e-3));
    CHECK_FALSE(noise.shape().bud);

    std::vector<Eigen::MatrixXd> start;
    for (const int mode : {1, 2}) start.push_back(noise.values()[static_cast<std::size_t>(mode)].inherited_root);
    LinearPropagation propagation([&](double time) { return run.mesh_rates(run.moment(time, 1)); }, 0.0, start,
                                  first_propagation_step, 1e-3);
    noise.advance(0.02);
    propagation.advance(0.02);
    for (const int mode : {1, 2}) {
        const Covariance& covariance = noise.values()[static_cast<std::size_t>(mode)];
        const Eigen::MatrixXd& root = propagation.rates()[static_cast<std::size_t>(mode) - 1].root;
        const Eigen::MatrixXd& expected = propagation.values()[static_cast<std::size_t>(mode) - 1];
        // A step's tolerance, over some ten steps of order 3.
        CHECK((root * (covariance.inherited_root - expected)).norm() < 1e-2 * (root * expected).norm());
        CHECK(noise.rms(mode).total > noise.rms(mode).inherited);
    }

    // So small an amplitude moves linearly: with the same normal numbers both ways give the same heights.
    constexpr double cold = 0.1;
    NoiseGrowth linear(run, cold, 1e-3);
    linear.advance(0.02);
    NoiseEnsemble ensemble(run, cold, 7);
    constexpr std::size_t members = 4;
    ensemble.add(members, {0.0, 0.02});
    const Eigen::MatrixXd& root = linear.values()[0].inherited_root;
    const NoisyQuantity height = pole_height(run.surroundings(), linear.moment().membrane->base());
    const Eigen::RowVectorXd row = height.row * root.topRows(height.row.size());
    std::mt19937_64 random(7);
    std::normal_distribution<double> normal;
    Eigen::VectorXd heights(members);
    for (double& value : heights) {
        Eigen::VectorXd numbers(row.size());
        for (double& number : numbers) number = normal(random);
        value = row.dot(numbers);
    }
    const double expected = std::sqrt((heights.array() - heights.mean()).square().sum() / (members - 1));
    CHECK(ensemble.height(1).deviation == Approx(expected).epsilon(0.02));  // steps of 1e-3 nm, and of the propagator
    CHECK(ensemble.height(1).mean - linear.shape().height == Approx(heights.mean()).margin(0.02 * expected));
    CHECK_FALSE(std::isfinite(ensemble.neck(0).mean));
}

TEST_CASE("what the noise of a run's directory writes, and what it refuses", "[modes]") {
    const ScratchDirectory scratch;
    Parameters parameters = short_run();
    parameters.time.end = parameters.output.shape_interval = 1e-3;
    {
        RunFiles output(parameters, identity(parameters), scratch.path, StartMode::fresh);
        output.finish(simulate(parameters, output));
    }
    const fs::path result = scratch.path / "modes";
    const auto written = [&](int last, double temperature) {
        write_modes({scratch.path, result, 1, last, 2, 1e-2, temperature, 2}, [](const std::string&) {});
    };
    CHECK_THROWS_AS(written(1, 310), InputError);
    CHECK_THROWS_AS(written(2, -3), InputError);
    written(2, 310);
    std::ifstream table(result / "noise.csv");
    std::string header, first;
    std::getline(table, header);
    std::getline(table, first);
    CHECK(std::count(header.begin(), header.end(), ',') == std::count(first.begin(), first.end(), ','));
    CHECK(first.substr(first.size() - 9) == ",,,,,,,,,");  // no neck
    std::ifstream ensemble(result / "noise_ensemble.csv");
    std::getline(ensemble, header);
    std::getline(ensemble, first);
    CHECK(first.substr(0, 4) == "0,2,");
    CHECK(std::count(header.begin(), header.end(), ',') == std::count(first.begin(), first.end(), ','));
    const Hdf5File shapes(result / "noise.h5", Hdf5File::Mode::read);
    CHECK(shapes.read_array("/times/000001/rms_0").size() == 321);
    CHECK(shapes.read_array("/times/000001/rms_0").back() == 0.0);  // at the rim
}

TEST_CASE("a run whose membrane a force pulls has no modes, one under tension and pressure has", "[modes]") {
    const ScratchDirectory scratch;
    Parameters parameters = short_run();
    parameters.time.end = parameters.output.shape_interval = 1e-3;
    parameters.membrane.rim_tension = 0.1;
    parameters.fluid.pressure_difference = 1e-3;
    const auto recorded = [&](const char* name) {
        {
            RunFiles output(parameters, identity(parameters), scratch.path / name, StartMode::fresh);
            output.finish(simulate(parameters, output));
        }
        return RecordedRun(scratch.path / name);
    };
    CHECK(recorded("loaded").parameters().membrane.rim_tension == 0.1);
    parameters.membrane.pole_force = 5;
    CHECK_THROWS_AS(recorded("pulled"), InputError);
    std::swap(parameters.membrane.pole_force, parameters.membrane.coat_force);
    CHECK_THROWS_AS(recorded("coat pulled"), InputError);
}

TEST_CASE("a directory without a sharp run has no modes", "[modes]") {
    const ScratchDirectory scratch;
    CHECK_THROWS_AS(RecordedRun(scratch.path), IoError);
    CHECK_THROWS_AS(write_modes({scratch.path, scratch.path / "modes", 0, 8, 3}, [](const std::string&) {}),
                    InputError);
}

TEST_CASE("the fastest modes of a matrix", "[modes]") {
    // Rates -1, 2 and the pair 0.5 +- 3 i.
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(4, 4);
    matrix.diagonal() << -1, 2, 0.5, 0.5;
    matrix(2, 3) = -3;
    matrix(3, 2) = 3;
    matrix(0, 1) = 5;
    const std::vector<Eigenmode> modes = fastest_modes(matrix, 2);
    REQUIRE(modes.size() == 2);
    CHECK(std::abs(modes[0].rate - 2.0) < 1e-13);
    CHECK(std::abs(modes[1].rate - std::complex<double>(0.5, 3)) < 1e-13);
    CHECK((matrix * modes[1].shape - modes[1].rate * modes[1].shape).norm() < 1e-13);
}
