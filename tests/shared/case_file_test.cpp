#include "shared/case/case_file.h"

#include <catch2/catch.hpp>
#include <fstream>

#include "shared/support/error.h"
#include "temporary_directory.h"

using namespace endoflow;
using Catch::Matchers::Contains;

namespace {

Parameters parse(const std::string& text, const std::vector<std::string>& overrides = {}) {
    return parse_case(text, "case.toml", overrides);
}

std::string message_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
    try {
        (void)parse(text, overrides);
    } catch (const InputError& error) {
        CHECK(error.code() == ExitCode::bad_input);
        return error.what();
    }
    return "no error";
}

}  // namespace

TEST_CASE("an empty case file is the paper's standard case") {
    const Parameters p = parse("");
    CHECK(p.molecules.patch_radius == 36);
    CHECK(p.domain.radius == 80);
    CHECK(p.fluid.viscosity_intracellular == 1e-2);
    CHECK(p.membrane.curvature_convention == CurvatureConvention::as_printed);
    CHECK(p.time.end == 20);
}

TEST_CASE("a case file sets numbers, integers, booleans, choices and strings") {
    const Parameters p = parse(
        "[case]\nname = 'x'\n[molecules]\npatch_radius = 40\ntransport = \"fickian\"\n[fluid]\ninertia = true\n"
        "[boundary_integral]\nelements = 90\n");
    CHECK(p.case_.name == "x");
    CHECK(p.molecules.patch_radius == 40);
    CHECK(p.molecules.transport == Transport::fickian);
    CHECK(p.fluid.inertia);
    CHECK(p.boundary_integral.elements == 90);
}

TEST_CASE("overrides come last and may leave strings unquoted") {
    const Parameters p = parse("[time]\nend = 3\n", {"time.end=0.5", "membrane.curvature_convention=consistent",
                                                     "molecules.transport=\"advection\""});
    CHECK(p.time.end == 0.5);
    CHECK(p.membrane.curvature_convention == CurvatureConvention::consistent);
    CHECK(p.molecules.transport == Transport::advection);
}

TEST_CASE("a wrong case says where, what, and what is allowed") {
    CHECK_THAT(message_of("[molecules]\npatch_radus = 3\n"),
               Contains("case.toml:2:1") && Contains("did you mean \"molecules.patch_radius\""));
    CHECK_THAT(message_of("[membran]\n"), Contains("case.toml:1:") && Contains("did you mean \"membrane\""));
    CHECK_THAT(message_of("[time]\nend = \"long\"\n"), Contains("case.toml:2:7") && Contains("a number"));
    CHECK_THAT(message_of("[domain]\nradius = -1\n"), Contains("domain.radius = -1") && Contains("> 0"));
    CHECK_THAT(message_of("[domain]\nradius = inf\n"), Contains("out of bounds"));
    CHECK_THAT(message_of("[domain]\nradius = nan\n"), Contains("out of bounds"));
    CHECK_THAT(message_of("[fluid]\ndynamics = \"fast\"\n"), Contains("\"flow\", \"geometric\""));
    CHECK_THAT(message_of("[boundary_integral]\nelements = 60.5\n"), Contains("an integer"));
    CHECK_THAT(message_of("[time]\nend = [1, 2, 3]\n"), Contains("time.end must be a number"));
    CHECK_THAT(message_of("[time\n"), Contains("case.toml:") && Contains("not valid TOML"));
    CHECK_THAT(message_of("time = 3\n"), Contains("must be a section"));
    CHECK_THAT(message_of("", {"time.end"}), Contains("section.key=value"));
    CHECK_THAT(message_of("", {"time.ned=3"}), Contains("did you mean \"time.end\""));
    CHECK_THAT(message_of("", {"fluid.patch_radius=3"}), Contains("did you mean \"molecules.patch_radius\""));
    CHECK_THAT(message_of("[molecules]\npatch_radius = 90\n"), Contains("smaller than domain.radius"));
    CHECK_THAT(message_of("[domain]\nmembrane_height = 159\n"), Contains("membrane_height"));
}

TEST_CASE("a case file that is not there, or no file, is bad input") {
    const TemporaryDirectory directory;
    CHECK_THROWS_AS(read_case(directory.path() / "none.toml", {}), InputError);
    CHECK_THROWS_AS(read_case(directory.path(), {}), InputError);
    std::ofstream(directory.path() / "large.toml") << std::string(2 << 20, '#');
    CHECK_THROWS_AS(read_case(directory.path() / "large.toml", {}), InputError);
}
