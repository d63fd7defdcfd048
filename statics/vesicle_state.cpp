#include "statics/vesicle_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shared/geometry/spheroid.h"
#include "shared/numerics/root.h"
#include "shared/support/error.h"

namespace endoflow::statics {

namespace {

using std::numbers::pi;

/// Where families are entered: close enough to the sphere for a spheroid, far enough for Newton's method.
constexpr double first_reduced_volume = 0.97;

Spheroid spheroid_of(const ClosedMembrane& membrane, VesicleFamily family) {
    const double wanted = membrane.reduced_volume();
    ClosedMembrane unit = membrane;
    const auto excess = [&](double log_ratio) {
        const Spheroid shape{1, std::exp(log_ratio)};
        unit.area = shape.area();
        unit.volume = shape.volume();
        return unit.reduced_volume() - wanted;
    };
    const double end = family == VesicleFamily::prolate ? 5 : -5;
    constexpr int bits = 40;
    const Spheroid shape{1, std::exp(root_between(excess, std::min(0.0, end), std::max(0.0, end), bits))};
    const double scale = std::sqrt(membrane.area / shape.area());
    return {scale * shape.equator, scale * shape.polar};
}

Eigen::VectorXd states_of(const ClosedMembrane& membrane, const Spheroid& shape, double x) {
    const double t = shape.parameter_of(x), g = shape.metric(t), radius = membrane.sphere_radius();
    const double hoop = shape.polar / (shape.equator * g);
    const double meridional = shape.equator * shape.polar / std::pow(g, 3);
    Eigen::VectorXd y(state::closed_states);
    y << std::pow(shape.equator * std::sin(t), 2), shape.equator * std::cos(t) / g, hoop,
        membrane.stiffness() * (meridional + hoop),
        -6 * membrane.stiffness() / (radius * radius) * shape.equator * std::cos(t) / g,
        shape.polar * (std::cos(t) - 1), membrane.volume / pi * x, 4 * membrane.stiffness() * x;
    return y;
}

/// Neither does the membrane touch the axis between its poles, nor do the poles pass through each other.
bool is_embedded(const PiecewiseSolution& solution) {
    const auto y = solution.nodes.row(state::r_squared);
    const Eigen::Index last = y.size() - 1;
    return y.segment(1, last - 1).minCoeff() > 0 &&
           solution.nodes(state::height, 0) > solution.nodes(state::height, last);
}

bool go_on(const BranchPoint& /*point*/) {
    return true;
}

MembranePath path_in_reduced_volume(const ClosedMembrane& membrane) {
    return [membrane](double v) { return with_reduced_volume(membrane, v); };
}

MembranePath path_in_polarity(const ClosedMembrane& membrane) {
    return [membrane](double polarity) {
        ClosedMembrane changed = membrane;
        changed.polarity = polarity;
        return changed;
    };
}

MembranePath path_in_curvature(const ClosedMembrane& membrane) {
    return [membrane](double curvature) {
        ClosedMembrane changed = membrane;
        changed.spontaneous_curvature = curvature;
        return changed;
    };
}

SolverError absence(const ClosedMembrane& membrane, const std::string& why) {
    return {"no-stationary-state",
            fmt::format("no vesicle of reduced volume {:g} and spontaneous curvature {:g} 1/nm was found: {}",
                        membrane.reduced_volume(), membrane.spontaneous_curvature, why),
            "choose a reduced volume nearer to 1, a smaller spontaneous curvature or the other family"};
}

/// Follows branches one after the other, each along another path, towards one vesicle.
struct Route {
    const ClosedMembrane& wanted;  // for messages
    const Resolution& resolution;
    const GaussRule rule{resolution.points};
    PiecewiseSolution at{};
    std::vector<Fold> folds{};  // in the volume or the curvature

    void begin(const ClosedMembrane& membrane, VesicleFamily family) {
        const auto problem = in_volume(membrane, membrane.reduced_volume());
        at = spheroidal_guess(membrane, family, rule, problem, resolution.elements);
    }
    void to_volume(const ClosedMembrane& membrane, double from, double to) {
        follow(in_volume(membrane, from), from, to, "reduced volume");
    }
    void to_polarity(const ClosedMembrane& membrane, double from, double to) {
        follow(in_polarity(membrane), from, to, "polarity");
    }
    /// Round a fold and back to where the polarity came from; returns the polarity just beyond.
    double past_fold_in_polarity(const ClosedMembrane& membrane, double from, double towards) {
        follow(in_polarity(membrane), from, towards, "polarity", BranchEnd::returned);
        return at.parameter;
    }
    void to_curvature(const ClosedMembrane& membrane, double to) {
        follow(stationary_shapes(path_in_curvature(membrane), 0, 1 / membrane.sphere_radius()), 0, to,
               "spontaneous curvature");
    }

  private:
    static BoundaryValueProblem in_volume(const ClosedMembrane& membrane, double typical) {
        return stationary_shapes(path_in_reduced_volume(membrane), typical, 0.1);
    }
    static BoundaryValueProblem in_polarity(const ClosedMembrane& membrane) {
        return stationary_shapes(path_in_polarity(membrane), 0, 1 / membrane.sphere_radius());
    }
    void follow(const BoundaryValueProblem& problem, double from, double to, const char* parameter,
                BranchEnd expected = BranchEnd::reached_target) {
        at.parameter = from;
        auto start = begin_branch(problem, rule, at, to);
        if (!start) throw absence(wanted, fmt::format("Newton's method failed at {} = {:g}", parameter, from));
        if (from == to) {
            at = std::move(start->solution);
            return;
        }
        Branch branch = follow_branch(problem, rule, *start, to, {}, is_embedded, go_on);
        if (branch.end != expected)
            throw absence(wanted, fmt::format("{} at {} = {:.6g}{}", to_string(branch.end), parameter,
                                              branch.last.solution.parameter, first_fold(branch)));
        if (expected == BranchEnd::reached_target)
            for (Fold& fold : branch.folds) folds.push_back(std::move(fold));
        at = std::move(branch.last.solution);
    }
    static std::string first_fold(const Branch& branch) {
        return branch.folds.empty() ? "" : fmt::format(", after a fold at {:.6g}", branch.folds.front().parameter());
    }
};

/// The membrane at C = 0 and this reduced volume, reached from the sphere.
void go_to_symmetric(Route& route, const ClosedMembrane& membrane, VesicleFamily family, double reduced_volume) {
    const double begin = std::max(first_reduced_volume, reduced_volume);
    route.begin(with_reduced_volume(membrane, begin), family);
    route.to_volume(membrane, begin, reduced_volume);
}

/// Oblates and stomatocytes of one reduced volume lie on one branch in the polarity, an S whose middle part crosses
/// zero polarity with shapes in between that are not stable.
void go_to_stomatocyte(Route& route, const ClosedMembrane& membrane, double reduced_volume) {
    constexpr double volume_of_both = 0.6;
    go_to_symmetric(route, membrane, VesicleFamily::oblate, volume_of_both);
    const ClosedMembrane polar = with_reduced_volume(membrane, volume_of_both);
    const double large = 4 / membrane.sphere_radius();
    const double in_between = route.past_fold_in_polarity(polar, 0, -large);
    const double beyond = route.past_fold_in_polarity(polar, in_between, large);
    route.to_polarity(polar, beyond, 0);
    route.to_volume(membrane, volume_of_both, reduced_volume);
}

double relative_change(const PiecewiseSolution& coarse, const PiecewiseSolution& fine) {
    const auto energy = [](const PiecewiseSolution& s) { return s.nodes(state::energy, s.nodes.cols() - 1); };
    const double pressure = std::abs(coarse.globals(global::pressure) / fine.globals(global::pressure) - 1);
    return std::max(std::abs(energy(coarse) / energy(fine) - 1), pressure);
}

}  // namespace

double VesicleState::bending_energy() const {
    return 2 * pi * solution.nodes(state::energy, solution.nodes.cols() - 1);
}

double VesicleState::pressure() const {
    return solution.globals(global::pressure);
}

double VesicleState::tension() const {
    return point_of_vesicle(membrane, pressure(), 0, solution.nodes.col(0)).tension;
}

PiecewiseSolution spheroidal_guess(const ClosedMembrane& membrane, VesicleFamily family, const GaussRule& rule,
                                   const BoundaryValueProblem& problem, std::size_t elements) {
    const Spheroid shape = spheroid_of(membrane, family);
    const auto states = [&](double x) { return states_of(membrane, shape, x); };
    const auto slopes = [&](double x) -> Eigen::VectorXd {
        const double step = 1e-5;
        return (states(std::min(x + step, 1.0)) - states(std::max(x - step, 0.0))) /
               (std::min(x + step, 1.0) - std::max(x - step, 0.0));
    };
    std::vector<double> mesh;
    for (std::size_t i = 0; i <= elements; ++i) mesh.push_back(static_cast<double>(i) / static_cast<double>(elements));
    const double pressure = -1.2 * problem.global_scales(global::pressure);
    return sample(mesh, rule, states, slopes, Eigen::VectorXd::Constant(1, pressure), membrane.reduced_volume());
}

VesicleState find_vesicle(const ClosedMembrane& membrane, VesicleFamily family, const Resolution& resolution) {
    const double wanted = membrane.reduced_volume();
    if (!(wanted > 0 && wanted < 1))
        throw InputError(fmt::format("a vesicle's reduced volume must lie between 0 and 1, not {:g}", wanted));
    ClosedMembrane symmetric = membrane;
    symmetric.spontaneous_curvature = 0;
    Route route{membrane, resolution};
    if (family == VesicleFamily::stomatocyte) {
        go_to_stomatocyte(route, symmetric, wanted);
    } else {
        go_to_symmetric(route, symmetric, family, wanted);
    }
    const double curvature = membrane.spontaneous_curvature;
    route.to_curvature(membrane, curvature);

    const auto problem = stationary_shapes(path_in_curvature(membrane), curvature, 1 / membrane.sphere_radius());
    const auto finer = interpolate(route.at, route.rule, halved_mesh(route.at.mesh));
    auto solved = solve_newton(problem, route.rule, finer, parameter_condition(finer, curvature, problem), 20);
    if (!solved) throw absence(membrane, "Newton's method failed on the refined mesh");
    const double change = relative_change(route.at, solved->solution);
    return {membrane, std::move(solved->solution), std::move(route.folds), change};
}

std::optional<Branch> continue_vesicle(const VesicleState& state, const MembranePath& with, double begin, double end,
                                       const Visitor& visit, const Resolution& resolution) {
    const GaussRule rule(resolution.points);
    const auto problem = stationary_shapes(with, begin, std::max(std::abs(begin), 0.1 * std::abs(end)));
    const auto start = begin_branch_at(problem, rule, state.solution, resolution.elements, begin, end);
    if (!start) return std::nullopt;
    return follow_branch(problem, rule, *start, end, {}, is_embedded, visit);
}

}  // namespace endoflow::statics
