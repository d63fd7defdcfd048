#include "statics/stationary_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shared/parameters/parameter_table.h"
#include "statics/sampled_curve.h"

namespace endoflow::statics {

namespace {

constexpr const char* curvature_key = "membrane.spontaneous_curvature";

/// The flat membrane on a mesh that resolves the edge of the patch.
PiecewiseSolution flat_guess(const Parameters& parameters, const GaussRule& rule, const Eigen::VectorXd& scales,
                             std::size_t elements) {
    const FlatMembrane flat{parameters};
    const auto states = [&](double x) { return flat.states(x); };
    const auto slopes = [&](double x) { return flat.slopes(x); };
    std::vector<double> mesh;
    for (std::size_t i = 0; i <= elements; ++i) mesh.push_back(static_cast<double>(i) / static_cast<double>(elements));
    PiecewiseSolution guess = sample(mesh, rule, states, slopes, flat.globals(), 0);
    if (molecules_are_frozen(parameters)) return guess;
    for (int round = 0; round < 4; ++round)
        guess = sample(equidistributed_mesh(guess, rule, scales, elements), rule, states, slopes, flat.globals(), 0);
    return guess;
}

/// A membrane may not touch the axis away from its apex.
bool off_the_axis(const PiecewiseSolution& solution) {
    const auto y = solution.nodes.row(state::r_squared);
    return y.tail(y.size() - 1).minCoeff() > 0;
}

bool neck_is_closed(const PiecewiseSolution& solution) {
    return narrowest_radius(solution) < closed_neck_radius;
}

bool neck_is_open(const BranchPoint& point) {
    return !neck_is_closed(point.solution);
}

bool before_fold(const BranchPoint& point) {
    return point.folds_before == 0 && neck_is_open(point);
}

/// Quantities that stand for the whole shape, all of order one: area, height, apex moment.
Eigen::Vector3d fingerprint(const PiecewiseSolution& solution, const BoundaryValueProblem& problem) {
    const double rim = solution.nodes(state::height, solution.nodes.cols() - 1);
    return {solution.globals(global::area) / problem.global_scales(global::area),
            (solution.nodes(state::height, 0) - rim) / problem.state_scales(state::height),
            solution.nodes(state::moment, 0) / problem.state_scales(state::moment)};
}

/// The state on a mesh with every element cut in two, with the change as its error.
std::optional<StationaryState> refined(const BoundaryValueProblem& problem, const GaussRule& rule,
                                       const Parameters& parameters, const BranchPoint& point) {
    const auto guess = interpolate(point.solution, rule, halved_mesh(point.solution.mesh));
    auto solved = solve_newton(problem, rule, guess, parameter_condition(guess, guess.parameter, problem), 20);
    if (!solved) return std::nullopt;
    const double change =
        (fingerprint(solved->solution, problem) - fingerprint(point.solution, problem)).cwiseAbs().maxCoeff();
    return StationaryState{
        parameters,
        {std::move(solved->solution), std::move(solved->tangent), point.arc_length, point.folds_before},
        change};
}

constexpr const char* remedy = "choose a smaller patch, spontaneous curvature or load, or run the dynamics";

std::string end_of_branch(const Branch& branch, const std::string& key, const std::string& unit) {
    if (!branch.folds.empty())
        return fmt::format("folds back at {} = {:.8g} {}", key, branch.folds.front().parameter(), unit);
    return fmt::format("{} at {} = {:.6g} {}", neck_closes(branch) ? "ends with a closing neck" : "was lost", key,
                       branch.last.solution.parameter, unit);
}

BoundaryValueProblem shapes_in_curvature(const Parameters& parameters) {
    return stationary_shapes(path_in(parameters, curvature_key), parameters.membrane.spontaneous_curvature,
                             scale_of_curvature(parameters));
}

/// The branch from the flat membrane, as long as `go_on` says so, and the state where it reaches the case.
Search search_along(const Parameters& parameters, const Resolution& resolution, const Visitor& go_on) {
    Search search;
    search.branch = branch_from_flat(parameters, parameters.membrane.spontaneous_curvature, resolution, go_on);
    if (search.branch && search.branch->end == BranchEnd::reached_target)
        search.state =
            refined(shapes_in_curvature(parameters), GaussRule(resolution.points), parameters, search.branch->last);
    return search;
}

/// Follows the state of a case without the load `key` to the load `wanted`; ends the search there if that fails.
void add_load(Search& search, const CasePath& path, const std::string& key, double wanted,
              const Resolution& resolution) {
    if (!search.state || wanted == 0) return;
    const Parameters loaded = path(wanted).parameters;
    const auto go_on = [&](const BranchPoint& point) { return !reaches_top_or_bottom(loaded, point.solution); };
    auto branch = continue_state(*search.state, path, 0, wanted, go_on, resolution);
    search.state.reset();
    search.key = key;
    search.branch = std::move(branch);
    if (!search.branch || search.branch->end != BranchEnd::reached_target) return;
    const GaussRule rule(resolution.points);
    search.state = refined(stationary_shapes(path, wanted, std::abs(wanted)), rule, loaded, search.branch->last);
}

/// Where the branch of smaller patches ends at the case's spontaneous curvature; empty when none was found.
std::string end_in_patch_radius(const Parameters& parameters, const Resolution& resolution) {
    const double wanted = parameters.molecules.patch_radius;
    const CasePath path = path_in(parameters, "molecules.patch_radius");
    for (double radius = 0.9 * wanted; radius > 0.3 * wanted; radius *= 0.9) {
        const Search smaller = search_along(path(radius).parameters, resolution, before_fold);
        if (!smaller.state) continue;
        const auto branch = continue_state(*smaller.state, path, radius, wanted, before_fold, resolution);
        if (!branch) return "";
        return fmt::format(", and with growing patches {}", end_of_branch(*branch, "molecules.patch_radius", "nm"));
    }
    return "";
}

}  // namespace

std::optional<Branch> branch_from_flat(const Parameters& parameters, double curvature, const Resolution& resolution,
                                       const Visitor& go_on) {
    const GaussRule rule(resolution.points);
    const BoundaryValueProblem problem = shapes_in_curvature(parameters);
    const auto start =
        begin_branch(problem, rule, flat_guess(parameters, rule, problem.state_scales, resolution.elements), curvature);
    if (!start) return std::nullopt;
    if (curvature == 0) return Branch{*start, {}, BranchEnd::reached_target};
    return follow_branch(problem, rule, *start, curvature, {}, off_the_axis, go_on);
}

double scale_of_curvature(const Parameters& parameters) {
    const double curvature = std::abs(parameters.membrane.spontaneous_curvature);
    return curvature > 0 ? curvature : 1 / parameters.domain.radius;
}

Parameters without_loads(Parameters parameters) {
    for (const char* key : load_keys) find_parameter(key)->set(parameters, 0.0);
    return parameters;
}

double number_of(const Parameters& parameters, const std::string& key) {
    return std::get<double>(find_parameter(key)->get(parameters));
}

CasePath path_in(const Parameters& parameters, const std::string& key) {
    return [parameters, &row = *find_parameter(key)](double value) {
        Parameters changed = parameters;
        row.set(changed, value);
        return changed;
    };
}

bool reaches_top_or_bottom(const Parameters& parameters, const PiecewiseSolution& solution) {
    const DomainParameters& domain = parameters.domain;
    const double apex = solution.nodes(state::height, 0);
    return std::min(apex, domain.height - apex) < domain.wall_clearance;
}

Search search_stationary_state(const Parameters& parameters, const Resolution& resolution) {
    Parameters reached = without_loads(parameters);
    Search search = search_along(reached, resolution, neck_is_open);
    for (const char* key : load_keys) {
        const CasePath path = path_in(reached, key);
        const double load = number_of(parameters, key);
        add_load(search, path, key, load, resolution);
        reached = path(load).parameters;
    }
    return search;
}

bool neck_closes(const Branch& branch) {
    return branch.end == BranchEnd::stopped && neck_is_closed(branch.last.solution);
}

SolverError explain_absence(const Parameters& parameters, const Search& search, const Resolution& resolution) {
    const std::string name = "no-stationary-state";
    const bool by_curvature = search.key == curvature_key;
    if (!search.branch && !by_curvature)
        return {name, "Newton's method failed at the first step in " + search.key, remedy};
    if (!search.branch)
        return {name,
                fmt::format("the molecules have no equilibrium with a patch of {:g} nm on the flat membrane",
                            parameters.molecules.patch_radius),
                "choose a larger molecules.patch_radius or molecules.transport = \"advection\""};
    if (search.branch->end == BranchEnd::reached_target)
        return {name, "Newton's method failed on the refined mesh", remedy};
    return {name,
            fmt::format("the stationary shapes that begin with the flat membrane do not reach this case "
                        "(molecules.patch_radius = {:g} nm): their branch {}{}",
                        parameters.molecules.patch_radius,
                        end_of_branch(*search.branch, search.key, find_parameter(search.key)->unit),
                        by_curvature ? end_in_patch_radius(parameters, resolution) : ""),
            remedy};
}

StationaryState find_stationary_state(const Parameters& parameters, const Resolution& resolution) {
    Search search = search_stationary_state(parameters, resolution);
    if (!search.state) throw explain_absence(parameters, search, resolution);
    return std::move(*search.state);
}

std::optional<Branch> continue_state(const StationaryState& state, const CasePath& with, double begin, double end,
                                     const Visitor& visit, const Resolution& resolution) {
    const GaussRule rule(resolution.points);
    const BoundaryValueProblem problem = stationary_shapes(with, begin, std::max(std::abs(begin), 0.1 * std::abs(end)));
    const auto start = begin_branch_at(problem, rule, state.point.solution, resolution.elements, begin, end);
    if (!start) return std::nullopt;
    const auto visit_open = [&](const BranchPoint& point) { return visit(point) && neck_is_open(point); };
    return follow_branch(problem, rule, *start, end, {}, off_the_axis, visit_open);
}

Parameters with_disc_mass(Parameters parameters) {
    auto& molecules = parameters.molecules;
    const double excess =
        std::numbers::pi * std::numbers::pi * molecules.interface_width * molecules.interface_width / 6;
    const double squared = molecules.patch_radius * molecules.patch_radius - excess;
    if (squared <= 0)
        throw InputError(
            fmt::format("molecules.patch_radius = {:g} nm is too small for a disc with an edge of width {:g} nm",
                        molecules.patch_radius, molecules.interface_width));
    molecules.patch_radius = std::sqrt(squared);
    return parameters;
}

}  // namespace endoflow::statics
