#include "boundary_integral/statics/simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "boundary_integral/statics/sampled_curve.h"
#include "boundary_integral/statics/stationary_state.h"
#include "shared/geometry/observables.h"
#include "shared/parameters/parameter_table.h"
#include "shared/support/error.h"
#include "shared/support/interruption.h"
#include "shared/support/nearest_word.h"

namespace endoflow::statics {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t curve_points = 1001;

/// Parameters that a stationary shape depends on.
const std::vector<std::string> continuable{"molecules.patch_radius",     "membrane.spontaneous_curvature",
                                           "membrane.bending_stiffness", "membrane.bending_stiffness_coated",
                                           "molecules.interface_width",  "domain.radius"};

double number(const Parameters& parameters, const std::string& key) {
    return std::get<double>(find_parameter(key)->get(parameters));
}

/// The case as it is solved: patch_radius is that of the initial profile.
Parameters resolved(const Parameters& parameters, const Request& request) {
    return request.disc_mass ? with_disc_mass(parameters) : parameters;
}

struct Writer {
    const GaussRule rule;
    RunOutput& output;
    int count = 0;

    /// `named` is the case the user sees, `solved` the one that was computed.
    Json write(const Parameters& named, const Parameters& solved, const BranchPoint& point) {
        const MembraneCurve curve = sampled_curve(solved, point.solution, rule, curve_points);
        const Observables seen = measure(curve, BendingModel(solved.membrane));
        HistoryRow row;
        row.time_us = count;
        row.step_us = count == 0 ? 0 : 1;
        if (seen.neck) {
            row.neck_radius_nm = seen.neck->radius;
            row.bud_diameter_nm = seen.neck->lateral_diameter;
        }
        row.bud_height_nm = seen.bud_height;
        row.membrane_area_nm2 = seen.membrane_area;
        row.bending_energy_pN_nm = seen.bending_energy;
        row.molecule_mass_nm2 = seen.molecule_mass;
        row.volume_extracellular_nm3 = seen.extracellular_volume;
        const double apex_height = curve.z.front() - curve.z.back();
        row.extra = {named.molecules.patch_radius,
                     named.membrane.spontaneous_curvature,
                     curve.s.back(),
                     apex_height,
                     curve.lambda.front(),
                     point.arc_length,
                     static_cast<double>(point.folds_before)};
        output.record_step(row);
        output.write_shape(count, curve);
        ++count;
        Json figures = {{"membrane_area_nm2", seen.membrane_area},
                        {"curve_length_nm", curve.s.back()},
                        {"apex_height_nm", apex_height},
                        {"bending_energy_pN_nm", seen.bending_energy},
                        {"tension_at_axis_pN_per_nm", curve.lambda.front()}};
        if (seen.neck) {
            figures["neck_radius_nm"] = seen.neck->radius;
            figures["bud_diameter_nm"] = seen.neck->lateral_diameter;
        }
        return figures;
    }
};

void warn_about_walls(const Parameters& parameters, double height, RunOutput& output) {
    const auto& domain = parameters.domain;
    if (domain.membrane_height + height > domain.height - domain.wall_clearance)
        output.log_warning(
            fmt::format("the stationary shape is {:.4g} nm high and does not fit into the domain", height));
}

Json describe_folds(const std::vector<Fold>& folds, const std::string& key) {
    Json list = Json::array();
    for (const Fold& fold : folds) list.push_back({{"parameter", key}, {"value", fold.parameter()}});
    return list;
}

ExitReason write_branch(const Parameters& parameters, const Request& request, const StationaryState& state,
                        Writer& writer) {
    const auto& [key, end] = *request.continuation;
    const ParameterRow& row = *find_parameter(key);
    const auto named = [&](double value) {
        Parameters changed = parameters;
        row.set(changed, value);
        return changed;
    };
    const ParameterPath solved = [&](double value) { return resolved(named(value), request); };
    const auto visit = [&](const BranchPoint& point) {
        const double value = point.solution.parameter;
        writer.write(named(value), solved(value), point);
        return interruption_signal() == 0;
    };
    const auto branch = continue_state(state, solved, number(parameters, key), end, visit);
    if (!branch)
        throw SolverError("no-convergence", "Newton's method failed at the first point of the branch",
                          "choose another parameter or start from another case");
    if (interruption_signal() != 0) return ExitReason::interrupted;
    const bool neck_closed = neck_closes(*branch);
    writer.output.note("branch", {{"parameter", key},
                                  {"begin", number(parameters, key)},
                                  {"end", branch->last.solution.parameter},
                                  {"ended_because", neck_closed ? "the neck closes" : to_string(branch->end)},
                                  {"points", writer.count},
                                  {"folds", describe_folds(branch->folds, key)}});
    for (const Fold& fold : branch->folds) fmt::print("fold at {} = {:.9g} {}\n", key, fold.parameter(), row.unit);
    fmt::print("branch in {}: {} points, {} at {:.9g} {}\n", key, writer.count,
               neck_closed ? "the neck closes" : to_string(branch->end), branch->last.solution.parameter, row.unit);
    return neck_closed ? ExitReason::neck_closed : ExitReason::done;
}

}  // namespace

Request::Continuation parse_continuation(const std::string& text, const Parameters& parameters) {
    const std::string where = "command line: --continue-in " + text;
    const auto equals = text.find('=');
    if (equals == std::string::npos) throw InputError(where + ": it must be section.key=END");
    const std::string key = text.substr(0, equals), value = text.substr(equals + 1);
    if (std::find(continuable.begin(), continuable.end(), key) == continuable.end()) {
        const auto nearest = nearest_word(key, continuable);
        throw InputError(fmt::format("{}: {}stationary shapes can be continued in {}", where,
                                     nearest ? fmt::format("did you mean '{}'? ", *nearest) : "",
                                     fmt::join(continuable, ", ")));
    }
    char* rest = nullptr;
    const double end = std::strtod(value.c_str(), &rest);
    if (value.empty() || *rest != '\0') throw InputError(where + ": END must be a number");
    Parameters checked = parameters;
    set_parameter(checked, *find_parameter(key), end, where);
    validate_combination(checked, where);
    if (end == number(parameters, key))
        throw InputError(fmt::format("{}: the case already has {} = {}", where, key, value));
    return {key, end};
}

EngineIdentity identity() {
    return {"statics",
            {{"eigen", fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)}},
            {"patch_radius_nm", "spontaneous_curvature_per_nm", "curve_length_nm", "apex_height_nm",
             "tension_at_axis_pN_per_nm", "branch_length", "folds_passed"},
            1,
            1,
            RowOrder::along_a_branch};
}

void require_stationary_model(const Parameters& parameters, const Request& request) {
    (void)resolved(parameters, request);
    if (!parameters.membrane.inextensible)
        throw InputError("membrane.inextensible = false: stationary shapes exist for an inextensible membrane only");
}

ExitReason simulate(const Parameters& parameters, const Request& request, RunOutput& output) {
    const Parameters solved = resolved(parameters, request);
    Search search;
    {
        const PhaseTimer timer(output, "search");
        search = search_stationary_state(solved);
    }
    if (search.branch)
        output.note("folds_on_the_way", describe_folds(search.branch->folds, "membrane.spontaneous_curvature"));
    if (!search.state) throw explain_absence(solved, search);
    const StationaryState& state = *search.state;

    const PhaseTimer timer(output, request.continuation ? "branch" : "output");
    Writer writer{GaussRule(Resolution{}.points), output};
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
    const Json figures = writer.write(parameters, solved, state.point);
    output.note("stationary_state", figures);
    warn_about_walls(parameters, figures["apex_height_nm"].get<double>(), output);
    for (const auto& [name, value] : figures.items()) fmt::print("  {:<28} {:.9g}\n", name, value.get<double>());
    return ExitReason::done;
}

}  // namespace endoflow::statics
