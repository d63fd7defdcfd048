// What the drivers of all engines share: when output is due, and what happens to a neck.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "shared/geometry/meridian.h"
#include "shared/model/time_scale.h"
#include "shared/output/neck_events.h"
#include "shared/output/output_plan.h"
#include "shared/output/output_size.h"

using namespace endoflow;

namespace {

Parameters intervals(double shapes, double fields) {
    Parameters parameters;
    parameters.output.shape_interval = shapes;
    parameters.output.field_interval = fields;
    return parameters;
}

/// When shapes are due in a run up to `end` that nobody told how often.
std::vector<double> chosen_times(double end, double start = 0) {
    Parameters parameters = intervals(0, 0);
    parameters.time.end = end;
    OutputPlan plan(parameters, start);
    std::vector<double> times;
    plan.shapes_until(end, [&](double due) { times.push_back(due); });
    return times;
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

TEST_CASE("some 400 shapes are due, ever further apart, whatever the run's length", "[driver]") {
    for (double end = 0.1; end < 1e6; end *= 1.37) {
        INFO(end);
        const std::vector<double> times = chosen_times(end);
        // 393 to 426 (output_plan.cpp).
        CHECK(times.size() > 380);
        CHECK(times.size() < 440);
        for (std::size_t i = 2; i < times.size(); ++i) CHECK(times[i] - times[i - 1] >= times[i - 1] - times[i - 2]);
        CHECK(end - times.back() < end / 140);
        const auto early = std::lower_bound(times.begin(), times.end(), end / 100) - times.begin();
        CHECK(early > 30);  // a tenth of the shapes in a hundredth of the time: √time, less the power of two
    }
}

TEST_CASE("no shapes are closer than the first step, of which the first one is at most one long", "[driver]") {
    const double first = first_step(Parameters{});
    for (const double end : {1e-7, 1e-4, 1e-3, 20.0}) {
        const std::vector<double> times = chosen_times(end);
        CHECK(times.size() <= static_cast<std::size_t>(2 * end / first) + 1);
        if (end > first) CHECK(times.front() <= first);
        for (std::size_t i = 1; i < times.size(); ++i) CHECK(times[i] - times[i - 1] > first / 2);
    }
}

TEST_CASE("a longer run's shapes are a shorter one's, too, and a restart goes on with them", "[driver]") {
    const std::vector<double> all = chosen_times(20), few = chosen_times(0.01), more = chosen_times(1.3);
    const auto up_to = [](const std::vector<double>& times, double end) {
        return std::vector<double>(times.begin(), std::upper_bound(times.begin(), times.end(), end));
    };
    const auto holds = [](const std::vector<double>& outer, const std::vector<double>& inner) {
        return std::includes(outer.begin(), outer.end(), inner.begin(), inner.end());
    };
    CHECK(holds(few, up_to(all, 0.01)));
    CHECK(holds(more, up_to(all, 1.3)));
    CHECK(holds(few, up_to(more, 0.01)));
    for (const double start : {1e-9, 0.00123, 0.5, 0.5 * (1 + 1e-14), 7.77, 19.9}) {
        INFO(start);
        std::vector<double> rest(all.begin(), all.end());
        rest.erase(rest.begin(),
                   std::find_if(rest.begin(), rest.end(), [&](double time) { return later(time, start); }));
        CHECK(chosen_times(20, start) == rest);
    }
}

TEST_CASE("an event between two shapes delays none that is chosen", "[driver]") {
    OutputPlan plan(intervals(0, 0), 0);
    std::vector<double> times;
    for (const double event : {0.0011, 0.00333, 0.7, 0.71, 12.3456})
        plan.shape_at(event, [&](double due) {
            if (due != event) times.push_back(due);
        });
    const std::vector<double> due = chosen_times(20);
    CHECK(times == std::vector<double>(due.begin(), due.begin() + static_cast<std::ptrdiff_t>(times.size())));
}

TEST_CASE("what a run writes is foreseen, and said when it is more than a gigabyte", "[driver]") {
    Parameters parameters;
    CHECK(much_output(parameters, "boundary-integral").empty());
    CHECK(expected_output(parameters, "boundary-integral").field_files == 40);
    parameters.time.end = 2000;
    parameters.output.shape_interval = 0.05;
    parameters.output.field_interval = 0;
    const OutputSize size = expected_output(parameters, "boundary-integral");
    CHECK(size.shapes == 40008);
    CHECK(size.field_files == 0);
    CHECK_THAT(much_output(parameters, "boundary-integral"),
               Catch::Matchers::Contains("GB until 2000 µs: 40008 shapes, 0 files of fields"));
    CHECK(expected_output(parameters, "boundary-integral", 1999.9).shapes == 2);  // of a restart near the end
    parameters.output.shape_interval = 0;
    CHECK(much_output(parameters, "boundary-integral").empty());
    CHECK(expected_output(parameters, "boundary-integral").bytes < size.bytes / 90);
    parameters.output.field_interval = 0.1;
    CHECK_THAT(much_output(parameters, "phase-field"), Catch::Matchers::Contains("20000 files of fields"));
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
