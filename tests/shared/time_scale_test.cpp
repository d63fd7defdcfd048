#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "shared/model/rest.h"
#include "shared/model/time_scale.h"

using namespace endoflow;

TEST_CASE("the structure's length is the smallest one that the model has, whatever the box") {
    Parameters p;
    CHECK(length_of_structure(p) == Approx(14.1).epsilon(1e-8));  // H0 = 1/14.1 nm, C = 2 H0
    p.domain.radius = 400;
    CHECK(length_of_structure(p) == Approx(14.1).epsilon(1e-8));
    p.membrane.spontaneous_curvature = -p.membrane.spontaneous_curvature;
    CHECK(length_of_structure(p) == Approx(14.1).epsilon(1e-8));
    p.membrane.spontaneous_curvature = 0;
    CHECK(length_of_structure(p) == 400);
    p.membrane.rim_tension = 0.1;  // β = 600 pN nm, as printed
    CHECK(length_of_structure(p) == Approx(std::sqrt(3000)));
    p.membrane.pole_force = 100;
    CHECK(length_of_structure(p) == Approx(12 * std::numbers::pi));
    p.membrane.coat_force = -200;
    CHECK(length_of_structure(p) == Approx(6 * std::numbers::pi));
    p.fluid.pressure_difference = -600;
    CHECK(length_of_structure(p) == Approx(1));
    p = {};
    p.membrane.spontaneous_curvature = 0;
    p.molecules.coupling = Coupling::energetic;
    CHECK(length_of_structure(p) == 18);
    p.molecules.coupling = Coupling::none;
    p.domain.kind = DomainKind::free_space;
    CHECK(length_of_structure(p) == 40);
}

TEST_CASE("first and longest steps do not hang on the box, and scale with the structure's time") {
    Parameters p;
    CHECK(structure_time(p) == Approx(0.011 * std::pow(14.1, 3) / 600).epsilon(1e-8));
    CHECK(first_step(p) == Approx(1e-5).epsilon(1e-4));
    CHECK(longest_step(p) == Approx(0.2).epsilon(1e-4));
    const double first = first_step(p), longest = longest_step(p);
    p.domain.radius = 240;
    CHECK(first_step(p) == first);
    CHECK(longest_step(p) == longest);
    p.fluid.viscosity_extracellular *= 3;
    p.fluid.viscosity_intracellular *= 3;
    CHECK(first_step(p) == Approx(3 * first));
    p.molecules.exchange = Exchange::edge;
    p.molecules.edge_speed = 1e-3;
    CHECK(longest_step(p) == Approx(0.02 * 14.1 / 1e-3).epsilon(1e-8));
    p.time.initial_step = 1e-7;
    p.time.max_step = 0.5;
    CHECK(first_step(p) == 1e-7);
    CHECK(longest_step(p) == 0.5);
}

TEST_CASE("the level of rest has the case's units, and a floor is the largest of what it is given") {
    Parameters p;
    const RestLevel rest = rest_level(p);
    CHECK(rest.energy == 600);
    CHECK(rest.power == Approx(1e-7 * 600 / structure_time(p)));
    CHECK(rest.speed == Approx(1e-7 * 14.1 / structure_time(p)).epsilon(1e-8));
    CHECK(rest.force == Approx(1e-7 * 600 / 14.1).epsilon(1e-8));
    CHECK(rest.length == length_of_structure(p));
    CHECK(rest.area == Approx(std::numbers::pi * 1.44));
    CHECK(rest_floor(2, 1e3, 1) == 2);
    CHECK(rest_floor(2, 1e10, 1) == 10);
    CHECK(rest_floor(2, 1e3, 3) == 3);
    p.domain.radius = 1000;
    CHECK(rest_level(p).power == rest.power);
}
