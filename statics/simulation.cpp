#include "statics/simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "shared/case/case_checks.h"
#include "shared/model/exchange.h"
#include "shared/output/phase_timer.h"
#include "shared/parameters/parameter_table.h"
#include "shared/support/error.h"
#include "shared/support/interruption.h"
#include "shared/support/nearest_word.h"
#include "statics/held_simulation.h"
#include "statics/shape_record.h"
#include "statics/stationary_state.h"
#include "statics/vesicle_case.h"
#include "statics/vesicle_simulation.h"

namespace endoflow::statics {

namespace {

/// Parameters that a stationary shape depends on.
std::vector<std::string> continuable(const Parameters& parameters) {
    std::vector<std::string> keys{"membrane.spontaneous_curvature", "membrane.bending_stiffness",
                                  "membrane.bending_stiffness_coated"};
    if (is_vesicle(parameters)) {
        keys.insert(keys.end(), {"domain.spheroid_polar_axis", "domain.spheroid_equatorial_axis"});
    } else {
        keys.insert(keys.end(),
                    {"molecules.patch_radius", "molecules.interface_width", "domain.radius", "membrane.rim_tension"});
        keys.insert(keys.end(), load_keys.begin(), load_keys.end());
    }
    if (energetically_coupled(parameters.molecules)) keys.emplace_back("molecules.line_energy");
    return keys;
}

/// The whole text as a number; empty when it is none.
std::optional<double> number(const std::string& text) {
    char* rest = nullptr;
    const double value = std::strtod(text.c_str(), &rest);
    if (text.empty() || *rest != '\0') return std::nullopt;
    return value;
}

/// Along a branch in a load the membrane may become a tube of any length: it is followed to the top or bottom of the
/// box.
bool is_load(const std::string& key) {
    return key == "membrane.rim_tension" || std::find(load_keys.begin(), load_keys.end(), key) != load_keys.end();
}

std::string side_reached(const Parameters& parameters, const PiecewiseSolution& solution) {
    const bool upwards = solution.nodes(state::height, 0) > parameters.domain.membrane_height;
    return std::string("the membrane reaches the ") + (upwards ? "top" : "bottom") + " of the box";
}

void warn_about_walls(const Parameters& parameters, double height, RunOutput& output) {
    const auto& domain = parameters.domain;
    const double apex = domain.membrane_height + height;
    if (std::min(apex, domain.height - apex) < domain.wall_clearance)
        output.log_warning(
            fmt::format("the stationary shape reaches {:.4g} nm from the rim's plane and does not fit into the domain",
                        std::abs(height)));
}

ExitReason write_branch(const Parameters& parameters, const Request& request, const StationaryState& state,
                        StateWriter& writer) {
    const std::string& key = request.continuation->key;
    const double end = request.continuation->end;
    const ParameterRow& row = *find_parameter(key);
    const auto named = [&](double value) {
        Parameters changed = parameters;
        row.set(changed, value);
        return changed;
    };
    const CasePath solved = [&](double value) { return resolved(named(value), request); };
    bool left_the_box = false;
    const auto visit = [&](const BranchPoint& point) {
        const double value = point.solution.parameter;
        write_state(writer, named(value), solved(value).parameters, point, {value, {}});
        left_the_box = is_load(key) && reaches_top_or_bottom(parameters, point.solution);
        return interruption_signal() == 0 && !left_the_box;
    };
    const auto branch = continue_state(state, solved, number_of(parameters, key), end, visit, request.resolution);
    if (!branch)
        throw SolverError("no-convergence", "Newton's method failed at the first point of the branch",
                          "choose another parameter or start from another case");
    if (interruption_signal() != 0) return ExitReason::interrupted;
    const bool neck_closed = !left_the_box && neck_closes(*branch);
    describe_branch(writer, key, row.unit, number_of(parameters, key), *branch,
                    left_the_box  ? side_reached(parameters, branch->last.solution)
                    : neck_closed ? "the neck closes"
                                  : to_string(branch->end));
    return neck_closed ? ExitReason::neck_closed : ExitReason::done;
}

}  // namespace

Request::Continuation parse_continuation(const std::string& text, const Parameters& parameters) {
    const std::string where = "command line: --continue-in " + text;
    const auto equals = text.find('=');
    if (equals == std::string::npos) throw InputError(where + ": it must be section.key=END");
    const std::string key = text.substr(0, equals), value = text.substr(equals + 1);
    const std::vector<std::string> keys = continuable(parameters);
    if (std::find(keys.begin(), keys.end(), key) == keys.end()) {
        const auto nearest = nearest_word(key, keys);
        throw InputError(fmt::format("{}: {}stationary shapes can be continued in {}", where,
                                     nearest ? fmt::format("did you mean '{}'? ", *nearest) : "",
                                     fmt::join(keys, ", ")));
    }
    const auto end = number(value);
    if (!end) throw InputError(where + ": END must be a number");
    Parameters checked = parameters;
    set_parameter(checked, *find_parameter(key), *end, where);
    check_case(checked, where);
    if (*end == number_of(parameters, key))
        throw InputError(fmt::format("{}: the case already has {} = {}", where, key, value));
    return {key, *end};
}

Request::Hold parse_hold(const std::string& text, const Parameters& parameters) {
    const std::string where = "command line: --hold " + text, prefix = "neck_radius=";
    const auto colon = text.find(':');
    if (!text.starts_with(prefix) || colon == std::string::npos)
        throw InputError(where + ": it must be neck_radius=R1:R2, from one radius to another, nm, R1 may be `open`");
    const double widest = parameters.domain.radius;
    const auto radius = [&](const std::string& word) {
        const auto value = number(word);
        if (!value || !(*value >= closed_neck_radius && *value < widest))
            throw InputError(fmt::format("{}: '{}' must be a radius between {:g} nm and domain.radius = {:g} nm", where,
                                         word, closed_neck_radius, widest));
        return *value;
    };
    const std::string first = text.substr(prefix.size(), colon - prefix.size());
    Request::Hold hold{{}, radius(text.substr(colon + 1))};
    if (first != "open") hold.begin = radius(first);
    if (hold.begin == hold.end) throw InputError(where + ": R1 and R2 must differ");
    return hold;
}

VesicleFamily parse_family(const std::string& text) {
    if (text == "prolate") return VesicleFamily::prolate;
    if (text == "oblate") return VesicleFamily::oblate;
    if (text == "stomatocyte") return VesicleFamily::stomatocyte;
    throw InputError("command line: --family " + text + ": it must be prolate, oblate or stomatocyte");
}

EngineIdentity identity(const Parameters& parameters) {
    return {"statics",
            {{"eigen", fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)}},
            is_vesicle(parameters) ? vesicle_columns() : shape_columns(),
            1,
            1,
            RowOrder::along_a_branch};
}

void require_stationary_model(const Parameters& parameters, const Request& request) {
    require_no_exchange(parameters, "statics");
    const std::size_t elements = request.resolution.elements;
    if (elements < fewest_elements || elements > most_elements)
        throw InputError(fmt::format("command line: --elements {}: it must be between {} and {}", elements,
                                     fewest_elements, most_elements));
    if (request.hold && request.continuation)
        throw InputError("command line: --hold and --continue-in exclude each other");
    if (is_vesicle(parameters)) {
        if (request.hold) throw InputError("command line: --hold does not go with a vesicle");
        if (request.disc_mass) throw InputError("command line: --disc-mass does not go with a vesicle");
        (void)vesicle_case(parameters);
    } else {
        if (request.family) throw InputError("command line: --family goes with domain.kind = \"free-space\" only");
        (void)resolved(parameters, request);
    }
    if (loads_of(parameters).collar_waits())
        throw InputError(
            "membrane.collar_force: a stationary shape needs membrane.collar_position, too; or hold its neck with "
            "--hold neck_radius=R1:R2");
    if (!parameters.membrane.inextensible)
        throw InputError("membrane.inextensible = false: stationary shapes exist for an inextensible membrane only");
}

ExitReason simulate(const Parameters& parameters, const Request& request, RunOutput& output) {
    if (is_vesicle(parameters)) return simulate_vesicle(parameters, request, output);
    if (request.hold) return simulate_hold(parameters, request, output);
    const Parameters solved = resolved(parameters, request);
    Search search;
    {
        const PhaseTimer timer(output, "search");
        search = search_stationary_state(solved, request.resolution);
    }
    if (search.branch) output.note("folds_on_the_way", describe_folds(search.branch->folds, search.key));
    if (!search.state) throw explain_absence(solved, search, request.resolution);
    const StationaryState& state = *search.state;

    const PhaseTimer timer(output, request.continuation ? "branch" : "output");
    StateWriter writer(output);
    output.note("molecules", molecules_are_frozen(parameters) ? "frozen in the material" : "in equilibrium");
    output.note("molecule_mass", request.disc_mass ? "of a disc of the patch radius" : "of the initial profile");
    output.note("relative_error", state.relative_error);
    output.note("elements", state.point.solution.elements());
    if (state.point.folds_before > 0)
        output.log_warning(
            fmt::format("{} folds lie between the flat membrane and this state: other stationary states "
                        "exist in between, and this one is stable only if that number is even",
                        state.point.folds_before));
    if (request.continuation) return write_branch(parameters, request, state, writer);
    const Json figures = write_state(writer, parameters, solved, state.point, {});
    output.note("stationary_state", figures);
    warn_about_walls(parameters, figures["apex_height_nm"].get<double>(), output);
    print_figures(figures);
    return ExitReason::done;
}

}  // namespace endoflow::statics
