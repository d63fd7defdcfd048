#include "shared/parameters/parameter_table.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "shared/case/case_file.h"
#include "shared/parameters/parameter_rendering.h"
#include "shared/support/error.h"
#include "shared/support/nearest_word.h"

using namespace endoflow;

TEST_CASE("every row is complete and its default is allowed") {
    std::set<std::string> names;
    for (const auto& row : parameter_table()) {
        INFO(row.name());
        CHECK(names.insert(row.name()).second);
        CHECK_FALSE(row.meaning.empty());
        Parameters p;
        CHECK_NOTHROW(set_parameter(p, row, row.default_value(), "default"));
    }
}

TEST_CASE("the annotated default case reads back as the defaults") {
    const Parameters p = parse_case(render_parameters_toml(Parameters{}), "generated", {});
    for (const auto& row : parameter_table()) {
        INFO(row.name());
        CHECK(row.get(p) == row.default_value());
    }
}

TEST_CASE("every numeric key refuses values that are not finite or outside its bounds") {
    for (const auto& row : parameter_table()) {
        INFO(row.name());
        if (!std::holds_alternative<double>(row.default_value())) continue;
        Parameters p;
        for (const double bad : {NAN, INFINITY, -INFINITY})
            CHECK_THROWS_AS(set_parameter(p, row, bad, "t"), InputError);
        if (std::isfinite(row.bounds.highest))
            CHECK_THROWS_AS(set_parameter(p, row, std::nextafter(row.bounds.highest, INFINITY), "t"), InputError);
        if (std::isfinite(row.bounds.lowest))
            CHECK_THROWS_AS(set_parameter(p, row, std::nextafter(row.bounds.lowest, -INFINITY), "t"), InputError);
    }
}

TEST_CASE("values are written so that TOML reads them back unchanged") {
    CHECK(to_toml(true) == "true");
    CHECK(to_toml(20.0) == "20.0");
    CHECK(to_toml(std::array{20.0, 0.5}) == "[20.0, 0.5]");
    CHECK(to_toml(0.0709219858) == "0.0709219858");
    CHECK(to_toml(std::string("a \"b\"\n")) == "\"a \\\"b\\\"\\u000a\"");
}

TEST_CASE("the nearest known word is found, far ones are not suggested") {
    CHECK(edit_distance("abc", "acb") == 1);
    CHECK(edit_distance("", "abc") == 3);
    CHECK(nearest_word("tolerence", {"tolerance", "end"}).value() == "tolerance");
    CHECK_FALSE(nearest_word("zzzzzz", {"tolerance", "end"}).has_value());
}

TEST_CASE("two numbers are read from a file and from --set, and stand in JSON as an array") {
    const std::string force = "[membrane]\ncoat_force = 10\n";
    const Parameters p = parse_case(force + "coat_force_ring = [40, 60.5]\n", "case.toml", {});
    CHECK(p.membrane.coat_force_ring == std::array{40.0, 60.5});
    CHECK(parameters_to_json(p)["membrane"]["coat_force_ring"] == std::array{40.0, 60.5});
    const Parameters set = parse_case(force, "case.toml", {"membrane.coat_force_ring=[50,70]"});
    CHECK(set.membrane.coat_force_ring == std::array{50.0, 70.0});
}

TEST_CASE("a section within a section is an object within an object, and --set finds it") {
    const Parameters p = parse_case("[phase_field]\nepsilon = 2\n[phase_field.paper]\nmax_motion = 0.5\n", "case.toml",
                                    {"phase_field.production.tension_leak=0.02"});
    CHECK(p.phase_field.epsilon == 2);
    CHECK(p.phase_field.paper.max_motion == 0.5);
    const auto json = parameters_to_json(p);
    for (const auto& row : parameter_table()) {
        INFO(row.name());
        REQUIRE(find_value(json, row) != nullptr);
        std::visit([&](const auto& value) { CHECK(*find_value(json, row) == value); }, row.get(p));
    }
    CHECK(json["phase_field"]["paper"]["max_motion"] == 0.5);
    CHECK(json["phase_field"]["production"]["tension_leak"] == 0.02);
}
