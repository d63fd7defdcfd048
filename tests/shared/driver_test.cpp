// What the drivers of all engines share: when output is due, and what happens to a neck.

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "shared/geometry/meridian.h"
#include "shared/output/neck_events.h"
#include "shared/output/output_plan.h"

using namespace endoflow;

namespace {

OutputParameters intervals(double shapes, double fields) {
    OutputParameters output;
    output.shape_interval = shapes;
    output.field_interval = fields;
    return output;
}

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("shapes are due early, then at multiples, at the same times whatever the steps were", "[driver]") {
    const double step = GENERATE(0.2, 0.07, 0.013);
    OutputPlan plan(intervals(0.1, 0), 0);
    std::vector<double> times;
    for (double time = 0; time < 0.2; time += step)
        plan.shapes_until(std::min(0.2, time + step), [&](double due) { times.push_back(due); });
    const std::vector<double> due{0.1 / 256, 0.1 / 128, 0.1 / 64, 0.1 / 32, 0.1 / 16,
                                  0.1 / 8,   0.1 / 4,   0.1 / 2,  0.1,      0.2};
    REQUIRE(times.size() == due.size());
    for (std::size_t i = 0; i < due.size(); ++i) CHECK(times[i] == Approx(due[i]).epsilon(1e-12));
}

TEST_CASE("a shape of an event is written once and delays none that is due", "[driver]") {
    OutputPlan plan(intervals(0.1, 0.25), 0.2);
    std::vector<double> shapes, fields;
    const auto shape = [&](double time) { shapes.push_back(time); };
    plan.shape_at(0.37, shape);
    plan.shape_at(0.37, shape);
    plan.shapes_until(0.4 * (1 - 1e-14), shape);  // 0.4 up to round-off
    plan.shape_at(0.4, shape);
    CHECK(shapes == std::vector<double>{0.1 * 3, 0.37, 0.1 * 4});
    plan.fields_until(0.6, [&](double time) { fields.push_back(time); });
    plan.fields_at(0.6, [&](double time) { fields.push_back(time); });
    CHECK(fields == std::vector<double>{0.25, 0.5, 0.6});
    CHECK(plan.next_fields() == 0.75);
}

TEST_CASE("no fields are due where there is no interval", "[driver]") {
    OutputPlan plan(intervals(0.1, 0), 0);
    CHECK(plan.next_fields() == infinity);
}

TEST_CASE("a neck buds once and closes later", "[driver]") {
    NeckEvents events({}, 0.5);
    const auto radius = [](double time) { return time < 0.1 ? infinity : 20 * (1 - time); };
    CHECK(events.within(0, 0.5, radius).empty());
    const auto budding = events.within(0.5, 0.8, radius);
    REQUIRE(budding.size() == 1);
    CHECK(budding[0].name == "budding");
    CHECK(budding[0].time == Approx(1 - budding_neck_radius / 20).epsilon(1e-14));
    CHECK_FALSE(budding[0].ends_run);
    CHECK(events.within(0.8, 0.9, radius).empty());
    const auto closing = events.within(0.9, 1, radius);
    REQUIRE(closing.size() == 1);
    CHECK(closing[0].name == "neck_closed");
    CHECK(closing[0].time == Approx(1 - 0.5 / 20).epsilon(1e-14));
    CHECK(closing[0].ends_run == ExitReason::neck_closed);
}

TEST_CASE("budding ends the run where that is asked for, also after a restart", "[driver]") {
    OutputParameters output;
    output.stop_at_budding = true;
    NeckEvents events(output, 0);
    const auto in_one_step = [](double time) { return time < 0.3 ? infinity : 0.0; };  // a neck that closes at once
    const auto found = events.within(0, 1, in_one_step);
    REQUIRE(found.size() == 1);
    CHECK(found[0].time == Approx(0.3).epsilon(1e-14));
    CHECK(found[0].ends_run == ExitReason::budded);
    NeckEvents continued(output, 0);
    continued.restore(true);
    const auto closed = continued.within(0, 1, in_one_step);
    REQUIRE(closed.size() == 1);
    CHECK(closed[0].name == "neck_closed");
}
