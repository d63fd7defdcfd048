#include "statics/sampled_curve.h"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "statics/shape_equations.h"

namespace endoflow::statics {

namespace {

/// A coordinate u in [0, 1] in which curves are smooth up to their ends on the axis, where they are not in x =
/// a/a(end).
struct SmoothCoordinate {
    double (*x)(double u);
    double (*rate)(double u);  // dx/du
    double (*u)(double x);
};

using std::numbers::pi;
constexpr SmoothCoordinate from_axis{[](double u) { return u * u; }, [](double u) { return 2 * u; },
                                     [](double x) { return std::sqrt(x); }};
constexpr SmoothCoordinate from_pole_to_pole{[](double u) { return std::pow(std::sin(0.5 * pi * u), 2); },
                                             [](double u) { return 0.5 * pi * std::sin(pi * u); },
                                             [](double x) { return 2 / pi * std::asin(std::sqrt(x)); }};

/// Arc length as a function of the smooth coordinate.
struct ArcLength {
    const PiecewiseSolution& solution;
    const GaussRule& rule;
    double label;  // a at x = 1, nm²
    SmoothCoordinate smooth;
    std::vector<double> u{0}, s{0};  // a fine table, s in nm

    ArcLength(const PiecewiseSolution& shape, const GaussRule& gauss, double whole_label, SmoothCoordinate coordinate)
        : solution(shape), rule(gauss), label(whole_label), smooth(coordinate) {
        constexpr int parts = 8;
        for (std::size_t i = 0; i < shape.elements(); ++i) {
            const double first = smooth.u(shape.mesh[i]), last = smooth.u(shape.mesh[i + 1]);
            for (int part = 1; part <= parts; ++part) {
                const double next = part == parts ? last : first + (last - first) * part / parts;
                s.push_back(s.back() + between(u.back(), next));
                u.push_back(next);
            }
        }
    }

    /// ∫ ds with ds = da/r.
    [[nodiscard]] double between(double first, double last) const {
        const auto integrand = [&](double at) {
            const double y = evaluate(solution, rule, smooth.x(at))(state::r_squared);
            return label * smooth.rate(at) / std::sqrt(y);
        };
        return boost::math::quadrature::gauss<double, 7>::integrate(integrand, first, last);
    }

    /// u and s of a point whose arc length is about `wanted`; the pair is exact, its distance from `wanted` is not.
    [[nodiscard]] std::pair<double, double> near(double wanted) const {
        const auto above = std::upper_bound(s.begin() + 1, s.end() - 1, wanted);
        const auto i = static_cast<std::size_t>(above - s.begin()) - 1;
        const double at = u[i] + (u[i + 1] - u[i]) * (wanted - s[i]) / (s[i + 1] - s[i]);
        return {at, s[i] + between(u[i], at)};
    }

    /// The curve at points of nearly equal distance, both ends among them, at rest. point_at(x) gives what is there.
    template <class PointAt>
    [[nodiscard]] MembraneCurve curve(std::size_t points, const PointAt& point_at) const {
        MembraneCurve curve;
        for (std::size_t i = 0; i < points; ++i) {
            const double wanted = s.back() * static_cast<double>(i) / static_cast<double>(points - 1);
            const auto [at, length] = i + 1 == points ? std::pair{1.0, s.back()} : near(wanted);
            const PointOfShape point = point_at(smooth.x(at));
            curve.s.push_back(length);
            curve.r.push_back(point.r);
            curve.z.push_back(point.z);
            curve.c.push_back(point.c);
            curve.lambda.push_back(point.tension);
            curve.kappa.push_back(point.total_curvature);
        }
        curve.u_r.assign(points, 0);
        curve.u_z.assign(points, 0);
        return curve;
    }
};

}  // namespace

MembraneCurve sampled_curve(const Parameters& parameters, const PiecewiseSolution& solution, const GaussRule& rule,
                            std::size_t points) {
    const StationaryCase stationary(parameters);
    const double label = solution.globals(global::area);
    MembraneCurve curve = ArcLength(solution, rule, label, from_axis).curve(points, [&](double x) {
        return point_of_shape(stationary, label * x, evaluate(solution, rule, x));
    });
    curve.r.front() = 0;
    return curve;
}

MembraneCurve sampled_curve(const VesicleState& state, const GaussRule& rule, double centre, std::size_t points) {
    const PiecewiseSolution& solution = state.solution;
    const double label = state.membrane.area / (2 * pi);
    MembraneCurve curve = ArcLength(solution, rule, label, from_pole_to_pole).curve(points, [&](double x) {
        return point_of_vesicle(state.membrane, state.pressure(), x, evaluate(solution, rule, x));
    });
    const double north = centre - 0.5 * curve.z.back();
    for (double& z : curve.z) z += north;
    curve.r.front() = curve.r.back() = 0;
    curve.lambda.assign(points, state.tension());
    return curve;
}

double narrowest_radius(const PiecewiseSolution& solution) {
    double narrowest = std::numeric_limits<double>::infinity();
    const auto y = solution.nodes.row(state::r_squared);
    for (Eigen::Index i = 1; i + 1 < y.size(); ++i)
        if (y(i) <= y(i - 1) && y(i) <= y(i + 1)) narrowest = std::min(narrowest, std::sqrt(std::max(y(i), 0.0)));
    return narrowest;
}

}  // namespace endoflow::statics
