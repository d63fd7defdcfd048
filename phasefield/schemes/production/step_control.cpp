#include "phasefield/schemes/production/step_control.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "phasefield/layer/constants.h"
#include "shared/model/time_scale.h"
#include "shared/support/error.h"

namespace endoflow::phasefield::production {

namespace {

constexpr double default_tolerance = constant("default_tolerance");
constexpr double first_order_part = constant("first_order_part");
constexpr double error_part = constant("error_part");
constexpr double safety = constant("safety");
constexpr double largest_growth = constant("largest_growth");
constexpr double after_hard_step = constant("after_hard_step");
constexpr double tolerated_excess = constant("tolerated_excess");
constexpr double smallest_step = constant("smallest_step");
constexpr double longer_steps = constant("longer_steps");
constexpr double retry = constant("retry");

/// By which the next step may be longer, as far as error and motion go.
double growth(const TriedStep& tried) {
    double factor = tried.early ? 1 : largest_growth;
    const double wrong = std::max(tried.wrong_position, tried.wrong_molecules);  // 0 lets it grow as far as it may
    factor = std::min(factor, safety * std::pow(wrong, -1 / (1 + static_cast<double>(tried.order))));
    return tried.motion > 0 ? std::min(factor, safety / tried.motion) : factor;
}

}  // namespace

double step_tolerance(const Parameters& p) {
    return error_part * time_tolerance(p, default_tolerance);
}

double position_tolerance(const Parameters& p) {
    return step_tolerance(p) * 2 * std::numbers::pi * length_of_structure(p);
}

double first_implicit_step(const Parameters& p) {
    return p.time.initial_step > 0 ? p.time.initial_step : first_order_part * first_step(p);
}

std::string rejection(const TriedStep& tried) {
    if (!tried.finite) return "the energy is not a number";
    if (tried.motion > 1) return "motion of " + std::to_string(tried.motion * largest_motion) + " ε";
    if (tried.wrong_position > tolerated_excess)
        return "error of the position " + std::to_string(tried.wrong_position) + " times the allowed one";
    if (tried.wrong_molecules > tolerated_excess)
        return "error of the molecules " + std::to_string(tried.wrong_molecules) + " times the allowed one";
    return {};
}

double step_after(const TriedStep& tried, double planned, const Parameters& p) {
    double factor = growth(tried);
    if (tried.hard && tried.tau > longest_step(p)) factor = std::min(factor, after_hard_step);
    const double next = tried.tau < planned && factor >= 1 ? std::max(planned, factor * tried.tau) : factor * tried.tau;
    // At rest, where membrane and molecules change by less than the error that a step may have, that alone limits it.
    const double longest =
        p.time.max_step > 0 ? p.time.max_step : std::max(longer_steps * longest_step(p), tried.tau / tried.change);
    return std::min(next, longest);
}

double step_instead(const TriedStep& tried, double time, const Parameters& p) {
    const double smaller = std::clamp(growth(tried), retry * retry, retry) * tried.tau;
    if (smaller < smallest_step * first_implicit_step(p))
        throw SolverError("step-size-underflow", "no acceptable time step at t = " + std::to_string(time) + " µs",
                          "use a smaller phase_field.cell_size or a larger phase_field.production.profile_relaxation");
    return smaller;
}

}  // namespace endoflow::phasefield::production
