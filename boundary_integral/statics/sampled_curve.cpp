#include "boundary_integral/statics/sampled_curve.h"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <limits>

#include "boundary_integral/statics/shape_equations.h"

namespace endoflow::statics {

namespace {

/// Arc length as a function of u = √x; smooth also on the axis, where s is not smooth in x.
struct ArcLength {
    const PiecewiseSolution& solution;
    const GaussRule& rule;
    std::vector<double> u, s;  // a fine table, s in nm

    ArcLength(const PiecewiseSolution& shape, const GaussRule& gauss) : solution(shape), rule(gauss), u{0}, s{0} {
        constexpr int parts = 8;
        for (std::size_t i = 0; i < shape.elements(); ++i) {
            const double first = std::sqrt(shape.mesh[i]), last = std::sqrt(shape.mesh[i + 1]);
            for (int part = 1; part <= parts; ++part) {
                const double next = part == parts ? last : first + (last - first) * part / parts;
                s.push_back(s.back() + between(u.back(), next));
                u.push_back(next);
            }
        }
    }

    /// ∫ ds with ds = da/r = 2 E u du/r.
    [[nodiscard]] double between(double first, double last) const {
        const auto integrand = [&](double at) {
            const double y = evaluate(solution, rule, at * at)(state::r_squared);
            return 2 * solution.globals(global::area) * at / std::sqrt(y);
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
};

}  // namespace

MembraneCurve sampled_curve(const Parameters& parameters, const PiecewiseSolution& solution, const GaussRule& rule,
                            std::size_t points) {
    const BendingModel bending(parameters.membrane);
    const ArcLength arc(solution, rule);
    MembraneCurve curve;
    for (std::size_t i = 0; i < points; ++i) {
        const double wanted = arc.s.back() * static_cast<double>(i) / static_cast<double>(points - 1);
        const auto [u, s] = i + 1 == points ? std::pair{1.0, arc.s.back()} : arc.near(wanted);
        const PointOfShape point = point_of_shape(bending, parameters.molecules, solution.globals(global::area) * u * u,
                                                  evaluate(solution, rule, u * u));
        curve.s.push_back(s);
        curve.r.push_back(i == 0 ? 0 : point.r);
        curve.z.push_back(point.z);
        curve.c.push_back(point.c);
        curve.lambda.push_back(point.tension);
        curve.kappa.push_back(point.total_curvature);
    }
    curve.u_r.assign(points, 0);
    curve.u_z.assign(points, 0);
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
