// The energy (S) is stationary: an independent check of the equations by finite differences.
//
// Admissible variations keep the area of every piece of material and with it c, keep the rim where and as horizontal
// as it is, and let membrane flow in. A shape is described by its angle θ as a function of the material alone: with
// a = A/2π, r² = ∫ 2 cos θ da, κ = r dθ/da + sin θ/r, E = 2π ∫ ½ β(c) (κ − C(c))² da. The rim's radius r(E)² = R² is
// kept by one more mode whose amplitude is solved for.

#include <boost/math/tools/roots.hpp>
#include <catch2/catch.hpp>
#include <numbers>
#include <random>

#include "statics/stationary_state.h"

using namespace endoflow;
using namespace endoflow::statics;

namespace {

constexpr int modes = 6;

/// Amplitudes of sin(jπu) in θ, u = √(a/E), and the relative change of E.
struct Variation {
    std::array<double, modes> angle{};
    double area = 0;
};

class VariedShape {
  public:
    VariedShape(const StationaryState& state)
        : state_(state), rule_(Resolution{}.points), energy_(membrane_energy(state.parameters)) {
        for (const double x : state.point.solution.mesh) mesh_.push_back(std::sqrt(x));
    }

    /// (S) of the shape varied by `amount` times `variation`, pN nm.
    double energy(const Variation& variation, double amount) const {
        const double rim = state_.parameters.domain.radius;
        std::uintmax_t iterations = 60;
        const auto misfit = [&](double amplitude) {
            return integrate(variation, amount, amplitude).r_squared / (rim * rim) - 1;
        };
        const double range = 20 * std::abs(amount) + 1e-12;
        const auto root = boost::math::tools::toms748_solve(misfit, -range, range,
                                                            boost::math::tools::eps_tolerance<double>(50), iterations);
        return integrate(variation, amount, 0.5 * (root.first + root.second)).energy;
    }

  private:
    struct Totals {
        double r_squared = 0, energy = 0;
    };

    /// dE/du and d(r²)/du at the Gauss points of every element of u.
    Totals integrate(const Variation& variation, double amount, double amplitude) const {
        const auto& solution = state_.point.solution;
        const double base_area = solution.globals(global::area), area = base_area * (1 + amount * variation.area);
        Totals totals;
        for (std::size_t i = 0; i + 1 < mesh_.size(); ++i) {
            const double h = mesh_[i + 1] - mesh_[i];
            Eigen::VectorXd angle(rule_.points), slope(rule_.points), growth(rule_.points), u(rule_.points);
            std::vector<double> c;
            for (int j = 0; j < rule_.points; ++j) {
                u(j) = mesh_[i] + h * rule_.nodes(j);
                const Eigen::VectorXd y = evaluate(solution, rule_, u(j) * u(j));
                const double r = std::sqrt(y(state::r_squared)), a = area * u(j) * u(j);
                const PointOfShape here = point_of_shape(state_.parameters, base_area * u(j) * u(j), y);
                angle(j) = std::atan2(y(state::hoop) * r, y(state::cosine)) + bump(variation, amount, amplitude, u(j));
                slope(j) = (here.total_curvature - y(state::hoop)) / r * 2 * base_area * u(j) +  // dθ/du
                           bump_slope(variation, amount, amplitude, u(j));
                growth(j) = 2 * std::cos(angle(j)) * 2 * area * u(j);
                c.push_back(concentration(a));
            }
            for (int j = 0; j < rule_.points; ++j) {
                const double r = std::sqrt(totals.r_squared + h * rule_.stages.row(j).dot(growth));
                const double by_area = slope(j) / (2 * area * u(j));  // dθ/da
                const double curvature = r * by_area + std::sin(angle(j)) / r;
                const double density = energy_.density(curvature, c[static_cast<std::size_t>(j)], 0).value;
                totals.energy += h * rule_.weights(j) * 2 * std::numbers::pi * density * 2 * area * u(j);
            }
            totals.r_squared += h * rule_.weights.dot(growth);
        }
        return totals;
    }

    /// c of the material: it does not depend on the shape.
    double concentration(double a) const {
        const auto& solution = state_.point.solution;
        if (molecules_are_frozen(state_.parameters))
            return initial_concentration_of_material(state_.parameters.molecules, a);
        const double x = std::min(a / solution.globals(global::area), 1.0);
        return evaluate(solution, rule_, x)(state::concentration);
    }

    static double bump(const Variation& variation, double amount, double amplitude, double u) {
        double sum = amplitude * std::sin(std::numbers::pi * u);
        for (int j = 0; j < modes; ++j)
            sum += amount * variation.angle[static_cast<std::size_t>(j)] * std::sin((j + 2) * std::numbers::pi * u);
        return sum;
    }
    static double bump_slope(const Variation& variation, double amount, double amplitude, double u) {
        double sum = amplitude * std::numbers::pi * std::cos(std::numbers::pi * u);
        for (int j = 0; j < modes; ++j)
            sum += amount * variation.angle[static_cast<std::size_t>(j)] * (j + 2) * std::numbers::pi *
                   std::cos((j + 2) * std::numbers::pi * u);
        return sum;
    }

    const StationaryState& state_;
    GaussRule rule_;
    MembraneEnergy energy_;
    std::vector<double> mesh_;  // in u
};

}  // namespace

TEST_CASE("The energy is stationary under variations that keep the material's area", "[statics]") {
    Parameters parameters;
    parameters.molecules.patch_radius = 23;
    parameters.molecules.transport = GENERATE(Transport::advection, Transport::cahn_hilliard);
    const auto state = find_stationary_state(parameters);
    const VariedShape shape(state);
    std::mt19937 generator(20160101);
    std::uniform_real_distribution<double> amplitude(-1, 1);
    for (int trial = 0; trial < 4; ++trial) {
        Variation variation;
        for (double& value : variation.angle) value = amplitude(generator);
        variation.area = 0.1 * amplitude(generator);
        const auto slope_at = [&](double amount, double step) {
            return (shape.energy(variation, amount + step) - shape.energy(variation, amount - step)) / (2 * step);
        };
        const double at_state = (4 * slope_at(0, 1e-4) - slope_at(0, 2e-4)) / 3, away = slope_at(0.01, 1e-4);
        CAPTURE(trial, at_state, away);
        CHECK(std::abs(away) > 1);  // pN nm per unit amplitude: elsewhere the energy does change
        CHECK(std::abs(at_state) < 1e-4 * std::abs(away));
    }
}
