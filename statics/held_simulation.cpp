#include "statics/held_simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shared/output/phase_timer.h"
#include "shared/support/interruption.h"
#include "statics/neck_work.h"
#include "statics/shape_integrals.h"
#include "statics/shape_record.h"

namespace endoflow::statics {

namespace {

/// Change of 𝒢 and of the force when every element is cut in two, relative to them.
double relative_error_of(const HeldState& state, const Resolution& resolution) {
    const auto fine = refined_held(state, resolution);
    if (!fine)
        throw SolverError("no-held-neck",
                          fmt::format("Newton's method failed on the refined mesh at {:.6g} nm", state.held.radius),
                          "give --elements another number");
    const GaussRule rule(resolution.points);
    const Loads loads = loads_of(state.held.stationary.parameters);
    const auto potential = [&](const HeldState& of) {
        return shape_integrals(of.held.stationary, joined(of.point.solution, rule), rule).potential(loads);
    };
    const double here = potential(state);
    return std::max(std::abs((potential(*fine) - here) / here),
                    std::abs(fine->force() - state.force()) / std::max(std::abs(state.force()), 1.0));
}

/// What the branch says of the work that scission takes.
Json describe_work(const NeckWork& work, const Parameters& parameters) {
    const double thermal = parameters.molecules.thermal_energy;
    const Barrier& barrier = work.barrier();
    return {{"barrier_pN_nm", barrier.height},
            {"barrier_kT", barrier.height / thermal},
            {"barrier_from_nm", barrier.from_radius},
            {"barrier_to_nm", barrier.to_radius},
            {"strongest_constriction_pN", work.strongest_constriction()},
            {"scission_energy_pN_nm", 4 * std::numbers::pi * parameters.membrane.gaussian_stiffness}};
}

}  // namespace

ExitReason simulate_hold(const Parameters& parameters, const Request& request, RunOutput& output) {
    const Parameters solved = resolved(parameters, request);
    const Request::Hold& hold = *request.hold;
    const HeldState first = [&] {
        const PhaseTimer timer(output, "search");
        const HeldState found = find_held_neck(solved, request.resolution);
        return hold.begin ? held_at(found, *hold.begin, request.resolution) : widest_held(found, request.resolution);
    }();
    const PhaseTimer timer(output, "branch");
    StateWriter writer(output);
    output.note("molecules", molecules_are_frozen(parameters) ? "frozen in the material" : "in equilibrium");
    output.note("molecule_mass", request.disc_mass ? "of a disc of the patch radius" : "of the initial profile");

    NeckWork work(hold.end);
    HeldState last = first;
    const auto write = [&](const HeldState& state) {
        const GaussRule rule(request.resolution.points);
        const BranchPoint whole{
            joined(state.point.solution, rule), {}, state.point.arc_length, state.point.folds_before};
        write_state(writer, parameters, solved, whole, {state.held.radius, HoldRecord{state.force(), work.to(state)}});
        last = state;
        return interruption_signal() == 0;
    };
    const HeldBranch found = follow_radius(first, hold.end, write, request.resolution);
    if (interruption_signal() != 0) return ExitReason::interrupted;
    const bool arrived = !found.fault && found.branch.end == BranchEnd::reached_target;
    describe_branch(writer, "neck_radius", "nm", first.held.radius, found.branch,
                    arrived ? to_string(found.branch.end) : held_failure(found, hold.end).name());
    const Json figures = describe_work(work, parameters);
    output.note("held_neck", figures);
    output.note("elements", last.point.solution.elements());
    print_figures(figures);
    output.note("relative_error", relative_error_of(last, request.resolution));
    if (!arrived) throw held_failure(found, hold.end);
    return ExitReason::done;
}

}  // namespace endoflow::statics
