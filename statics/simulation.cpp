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
#include "statics/sampled_curve.h"
#include "statics/shape_integrals.h"
#include "statics/state_writer.h"
#include "statics/stationary_state.h"
#include "statics/vesicle_case.h"
#include "statics/vesicle_simulation.h"

namespace endoflow::statics {

namespace {

/// Parameters that a stationary shape depends on.
std::vector<std::string> continuable(const Parameters& parameters) {
    std::vector<std::string> keys{"membrane.spontaneous_curvature", "membrane.bending_stiffness",
                                  "membrane.bending_stiffness_coated"};
    const std::vector<std::string> more =
        is_vesicle(parameters)
            ? std::vector<std::string>{"domain.spheroid_polar_axis", "domain.spheroid_equatorial_axis"}
            : std::vector<std::string>{"molecules.patch_radius", "molecules.interface_width",
                                       "domain.radius",          "membrane.rim_tension",
                                       "membrane.pole_force",    "fluid.pressure_difference"};
    keys.insert(keys.end(), more.begin(), more.end());
    if (energetically_coupled(parameters.molecules)) keys.emplace_back("molecules.line_energy");
    return keys;
}

/// Along a branch in a load the membrane may become a tube of any length: it is followed to the top or bottom of the
/// box.
bool is_load(const std::string& key) {
    return key == "membrane.rim_tension" || key == "membrane.pole_force" || key == "fluid.pressure_difference";
}

/// The case as it is solved: patch_radius is that of the initial profile.
Parameters resolved(const Parameters& parameters, const Request& request) {
    return request.disc_mass ? with_disc_mass(parameters) : parameters;
}

/// What one stationary shape says of itself.
struct ShapeRecord {
    const Parameters& named;  // the case the user sees
    const MembraneCurve& curve;
    const BranchPoint& point;
    const ShapeIntegrals& integrals;
    Loads loads;
    std::optional<double> followed;  // value of the parameter of a branch

    [[nodiscard]] double apex_height() const { return curve.z.front() - curve.z.back(); }
};

const std::vector<OwnColumn<ShapeRecord>>& own_shape_columns() {
    using R = ShapeRecord;
    static const std::vector<OwnColumn<R>> columns{
        {"patch_radius_nm", "molecules.patch_radius of the case",
         [](const R& r) { return r.named.molecules.patch_radius; }},
        {"spontaneous_curvature_per_nm", "membrane.spontaneous_curvature of the case",
         [](const R& r) { return r.named.membrane.spontaneous_curvature; }},
        {"curve_length_nm", "arc length from the axis to the rim", [](const R& r) { return r.curve.s.back(); }},
        {"apex_height_nm", "height of the membrane on the axis above the rim",
         [](const R& r) { return r.apex_height(); }},
        {"tension_at_axis_pN_per_nm", "λ on the axis", [](const R& r) { return r.curve.lambda.front(); }},
        {"branch_length", "arc length along the branch, in units of the problem's scales",
         [](const R& r) { return r.point.arc_length; }},
        {"folds_passed", "folds of the branch before this shape",
         [](const R& r) { return static_cast<double>(r.point.folds_before); }},
        {"rim_tension_pN_per_nm", "σ", [](const R& r) { return r.loads.rim_tension; }},
        {"pressure_difference_pN_per_nm2", "p", [](const R& r) { return r.loads.pressure; }},
        {"pole_force_pN", "F", [](const R& r) { return r.loads.pole_force; }},
        {"pole_extension_nm", "z̄ − z(rim): how far the pole force has pulled",
         [](const R& r) { return r.integrals.extension; }},
        {"potential_pN_nm", "𝒢 = E + E_c + σ A − p V − F z̄", [](const R& r) { return r.integrals.potential(r.loads); }},
        {"line_energy_pN_nm", "E_c of the coat's edge, under energetic coupling",
         [](const R& r) { return r.integrals.edge; }},
        {followed_value.name, followed_value.meaning, [](const R& r) { return r.followed; }},
    };
    return columns;
}

/// `named` is the case the user sees, `solved` the one that was computed; `followed`: the value on a branch.
Json write_state(StateWriter& writer, const Parameters& named, const Parameters& solved, const BranchPoint& point,
                 std::optional<double> followed) {
    const GaussRule rule(Resolution{}.points);
    const MembraneCurve curve = sampled_curve(solved, point.solution, rule, curve_points);
    const ShapeIntegrals integrals = shape_integrals(solved, point.solution, rule);
    const Loads loads = loads_of(solved);
    const ShapeRecord record{named, curve, point, integrals, loads, followed};
    Json figures = writer.write(curve, bending_model(solved, 0), own_values(own_shape_columns(), record));
    figures["apex_height_nm"] = record.apex_height();
    figures["tension_at_axis_pN_per_nm"] = curve.lambda.front();
    const bool coupled = energetically_coupled(solved.molecules);
    if (coupled) figures["line_energy_pN_nm"] = integrals.edge;
    if (coupled || !loads.none()) figures["potential_pN_nm"] = integrals.potential(loads);
    if (loads.pole_force != 0) figures["pole_extension_nm"] = integrals.extension;
    return figures;
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
        write_state(writer, named(value), solved(value).parameters, point, value);
        left_the_box = is_load(key) && reaches_top_or_bottom(parameters, point.solution);
        return interruption_signal() == 0 && !left_the_box;
    };
    const auto branch = continue_state(state, solved, number_of(parameters, key), end, visit, request.resolution);
    if (!branch)
        throw SolverError("no-convergence", "Newton's method failed at the first point of the branch",
                          "choose another parameter or start from another case");
    if (interruption_signal() != 0) return ExitReason::interrupted;
    const bool neck_closed = !left_the_box && neck_closes(*branch);
    describe_branch(writer, key, number_of(parameters, key), *branch,
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
    char* rest = nullptr;
    const double end = std::strtod(value.c_str(), &rest);
    if (value.empty() || *rest != '\0') throw InputError(where + ": END must be a number");
    Parameters checked = parameters;
    set_parameter(checked, *find_parameter(key), end, where);
    check_case(checked, where);
    if (end == number_of(parameters, key))
        throw InputError(fmt::format("{}: the case already has {} = {}", where, key, value));
    return {key, end};
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
            is_vesicle(parameters) ? vesicle_columns() : texts_of(own_shape_columns()),
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
    if (is_vesicle(parameters)) {
        if (request.disc_mass) throw InputError("command line: --disc-mass does not go with a vesicle");
        (void)vesicle_case(parameters);
    } else {
        if (request.family) throw InputError("command line: --family goes with domain.kind = \"free-space\" only");
        (void)resolved(parameters, request);
    }
    if (!parameters.membrane.inextensible)
        throw InputError("membrane.inextensible = false: stationary shapes exist for an inextensible membrane only");
}

ExitReason simulate(const Parameters& parameters, const Request& request, RunOutput& output) {
    if (is_vesicle(parameters)) return simulate_vesicle(parameters, request, output);
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
    const Json figures = write_state(writer, parameters, solved, state.point, std::nullopt);
    output.note("stationary_state", figures);
    warn_about_walls(parameters, figures["apex_height_nm"].get<double>(), output);
    print_figures(figures);
    return ExitReason::done;
}

}  // namespace endoflow::statics
