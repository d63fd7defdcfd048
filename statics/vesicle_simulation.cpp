#include "statics/vesicle_simulation.h"

#include <numbers>

#include "shared/output/phase_timer.h"
#include "shared/support/error.h"
#include "shared/support/interruption.h"
#include "statics/sampled_curve.h"
#include "statics/state_writer.h"
#include "statics/vesicle_case.h"

namespace endoflow::statics {

namespace {

/// What one vesicle says of itself.
struct VesicleRecord {
    const VesicleState& state;
    const MembraneCurve& curve;
    const BranchPoint& place;        // on a branch
    std::optional<double> followed;  // value of the branch's parameter

    [[nodiscard]] double reduced_energy() const {
        return state.bending_energy() / (8 * std::numbers::pi * state.membrane.stiffness());
    }
};

const std::vector<OwnColumn<VesicleRecord>>& own_vesicle_columns() {
    using R = VesicleRecord;
    static const std::vector<OwnColumn<R>> columns{
        {"reduced_volume", "V over that of the sphere of the same area",
         [](const R& r) { return r.state.membrane.reduced_volume(); }},
        {"reduced_energy", "E over that of a sphere, 8πβ", [](const R& r) { return r.reduced_energy(); }},
        {"pressure_pN_per_nm2", "inside minus outside", [](const R& r) { return r.state.pressure(); }},
        {"tension_pN_per_nm", "λ, the same everywhere", [](const R& r) { return r.state.tension(); }},
        {"pole_distance_nm", "height of the upper pole above the lower one",
         [](const R& r) { return r.curve.z.front() - r.curve.z.back(); }},
        {"branch_length", "arc length along the branch, in units of the problem's scales",
         [](const R& r) { return r.place.arc_length; }},
        {"folds_passed", "folds of the branch before this shape",
         [](const R& r) { return static_cast<double>(r.place.folds_before); }},
        {followed_value.name, followed_value.meaning, [](const R& r) { return r.followed; }},
    };
    return columns;
}

/// Writes a vesicle of the case; `place` and `followed` say where on a branch it lies.
Json write_vesicle(StateWriter& writer, const Parameters& parameters, const VesicleState& state,
                   const BranchPoint& place, std::optional<double> followed) {
    const MembraneCurve curve =
        sampled_curve(state, GaussRule(Resolution{}.points), parameters.domain.membrane_height, curve_points);
    const VesicleRecord record{state, curve, place, followed};
    Json figures = writer.write(curve, bending_model(parameters, 0), own_values(own_vesicle_columns(), record));
    figures["reduced_volume"] = state.membrane.reduced_volume();
    figures["reduced_energy"] = record.reduced_energy();
    figures["pressure_pN_per_nm2"] = state.pressure();
    figures["tension_pN_per_nm"] = state.tension();
    return figures;
}

ExitReason write_branch(const Parameters& parameters, const Request& request, const VesicleState& state,
                        StateWriter& writer) {
    const Request::Continuation& continuation = *request.continuation;
    const std::string& key = continuation.key;
    const double begin = number_of(parameters, key);
    const auto named = [&](double value) {
        Parameters changed = parameters;
        find_parameter(key)->set(changed, value);
        return changed;
    };
    const auto membrane = [&](double value) { return vesicle_case(named(value)).membrane; };
    const auto visit = [&](const BranchPoint& point) {
        const double value = point.solution.parameter;
        write_vesicle(writer, named(value), {membrane(value), point.solution, {}, 0}, point, value);
        return interruption_signal() == 0;
    };
    const auto branch = continue_vesicle(state, membrane, begin, continuation.end, visit, request.resolution);
    if (!branch)
        throw SolverError("no-convergence", "Newton's method failed at the first point of the branch",
                          "choose another parameter or start from another case");
    if (interruption_signal() != 0) return ExitReason::interrupted;
    describe_branch(writer, key, find_parameter(key)->unit, begin, *branch, to_string(branch->end));
    return ExitReason::done;
}

}  // namespace

std::vector<ColumnText> vesicle_columns() {
    return texts_of(own_vesicle_columns());
}

ExitReason simulate_vesicle(const Parameters& parameters, const Request& request, RunOutput& output) {
    const VesicleCase wanted = vesicle_case(parameters);
    std::optional<VesicleState> state;
    {
        const PhaseTimer timer(output, "search");
        state = find_vesicle(wanted.membrane, request.family.value_or(wanted.family), request.resolution);
    }
    const PhaseTimer timer(output, request.continuation ? "branch" : "output");
    output.note("relative_error", state->relative_error);
    output.note("elements", state->solution.elements());
    StateWriter writer(output);
    if (request.continuation) return write_branch(parameters, request, *state, writer);
    const Json figures =
        write_vesicle(writer, parameters, *state, {state->solution, state->solution, 0, 0}, std::nullopt);
    output.note("stationary_state", figures);
    print_figures(figures);
    return ExitReason::done;
}

}  // namespace endoflow::statics
