// Decay of the shape modes of a nearly spherical, inextensible, closed membrane in unbounded fluid. Published for equal
// viscosities (S. T. Milner & S. A. Safran, Phys. Rev. A 36, 4371 (1987)):
//     rate_l = beta/(nu R^3) (l-1) l (l+1) (l+2) [l (l+1) + sigma] / ((2 l + 1)(2 l^2 + 2 l - 1)),  sigma = lambda
//     R^2/beta.
// With nu1 inside and nu2 outside the denominator is
//     nu1 (l-1)(2 l^2 + 5 l + 5) + nu2 (l+2)(2 l^2 - l + 2),
// from Lamb's solution: the velocity on the sphere is Y r + 2/(l (l+1)) grad Y, both fluids' normal tractions are their
// pressures nu1 (l-1)(2 l + 3)/l and -nu2 (l+2)(2 l - 1)/(l+1), and the tension [nu1 (l-1) + nu2 (l+2)]/(l (l+1)) that
// balances the shear adds twice itself. Both denominators agree for nu1 = nu2.

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "boundary_integral/flow/dense_solver.h"
#include "boundary_integral/flow/free_space_flow.h"
#include "boundary_integral/membrane/energy.h"
#include "curves.h"
#include "shared/model/bending_model.h"

namespace {

using namespace endoflow;
using namespace endoflow::boundary_integral;
using namespace endoflow::boundary_integral::testing;

using std::numbers::pi;
constexpr double radius = 20;  // nm

struct Vesicle {
    double inner, outer;     // viscosities, pN us/nm^2
    double reduced_tension;  // sigma

    Parameters parameters() const {
        Parameters result;
        result.domain.kind = DomainKind::free_space;
        result.fluid.viscosity_extracellular = inner;
        result.fluid.viscosity_intracellular = outer;
        return result;
    }
    static double stiffness() { return BendingModel(MembraneParameters{}).stiffness(0).value; }
};

double published_rate(const Vesicle& vesicle, unsigned mode) {
    const double l = mode;
    const double friction = vesicle.inner * (l - 1) * (2 * l * l + 5 * l + 5) +  //
                            vesicle.outer * (l + 2) * (2 * l * l - l + 2);
    return Vesicle::stiffness() / std::pow(radius, 3) * (l - 1) * l * (l + 1) * (l + 2) *
           (l * (l + 1) + vesicle.reduced_tension) / friction;
}

// int mu_k dA/(2 pi) of the tension's functions.
Eigen::VectorXd mean_of_tension(const MembraneSpace& space, const MembraneSamples& samples) {
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(space.tension().dimension());
    for (std::size_t i = 0; i < space.xi.size(); ++i) {
        const BasisRow& row = space.tension_rows[i];
        const double measure = space.weight[i] * samples.curve[i].r * samples.curve[i].g;
        for (std::size_t k = 0; k < static_cast<std::size_t>(row.count); ++k)
            mean[row.index[k]] += measure * row.value[0][k];
    }
    return mean;
}

// Velocity coefficients of the membrane under its bending force, a given mean tension, the pressure that keeps its
// volume and the tension that keeps its area locally, but for a uniform stretch: on a sphere that one is of second
// order, and asking for it would fix the mean tension.
Eigen::VectorXd velocity_of(const MembraneSpace& space, const MembraneState& state, const Vesicle& vesicle) {
    const Parameters parameters = vesicle.parameters();
    const MembraneSamples samples = sample(space, state);
    const FreeSpaceFlow flow(parameters, space);
    const MobilityOperators operators = flow.operators(state, samples);
    const Eigen::MatrixXd constraint = flow.constraint_matrix(samples, operators.freedoms);  // areas, volume
    const Index multipliers = constraint.rows(), tensions = space.tension().dimension();

    const double mean_tension = vesicle.reduced_tension * Vesicle::stiffness() / (radius * radius);
    const Eigen::VectorXd bending =
        energy_derivatives(space, state, membrane_energy(parameters), Derivatives::first).gradient;
    const Eigen::VectorXd load =
        -operators.freedoms.restrict_rows(bending) -
        constraint.topRows(tensions).transpose() * Eigen::VectorXd::Constant(tensions, mean_tension);

    const Eigen::VectorXd mean = mean_of_tension(space, samples);
    Eigen::MatrixXd bordered = Eigen::MatrixXd::Zero(multipliers + 1, multipliers + 1);
    bordered.topLeftCorner(multipliers, multipliers) = constraint * operators.mobility * constraint.transpose();
    bordered.block(0, multipliers, tensions, 1) = mean;
    bordered.block(multipliers, 0, 1, tensions) = mean.transpose();
    Eigen::VectorXd violation = Eigen::VectorXd::Zero(multipliers + 1);
    violation.head(multipliers) = constraint * (operators.mobility * load);
    const Eigen::VectorXd values = LuFactors(bordered, "tension").solve(violation).topRows(multipliers);
    return operators.freedoms.expand(operators.mobility * (load - constraint.transpose() * values));
}

// Amplitude of P_l in the normal velocity of the sphere R (1 + epsilon P_l).
double modal_velocity(const MembraneSpace& space, const Vesicle& vesicle, unsigned mode, double epsilon) {
    const auto distance = [&](double x) { return radius * (1 + epsilon * std::legendre(mode, std::cos(pi * x))); };
    const MembraneState state = state_of(
        space, [&](double x) { return distance(x) * std::sin(pi * x); },
        [&](double x) { return distance(x) * std::cos(pi * x); }, [](double) { return 0.0; });
    const Eigen::VectorXd velocity = velocity_of(space, state, vesicle);
    const Eigen::VectorXd u_r = velocity.head(space.radial_count()), u_z = velocity.tail(space.axial_count());
    double sum = 0;
    for (std::size_t i = 0; i < space.xi.size(); ++i) {
        const double angle = pi * space.xi[i];
        const double normal =
            space.radial_rows[i].evaluate(u_r) * std::sin(angle) + space.axial_rows[i].evaluate(u_z) * std::cos(angle);
        sum += space.weight[i] * pi * std::sin(angle) * normal * std::legendre(mode, std::cos(angle));
    }
    return 0.5 * (2 * mode + 1) * sum;
}

// From both signs of the amplitude, so that what is quadratic in it drops out.
double computed_rate(const Vesicle& vesicle, unsigned mode, Index elements) {
    const MembraneSpace space(elements, 8, CurveEnd::closed);
    const double epsilon = 1e-4;
    return -(modal_velocity(space, vesicle, mode, epsilon) - modal_velocity(space, vesicle, mode, -epsilon)) /
           (2 * epsilon * radius);
}

}  // namespace

TEST_CASE("shape modes of a sphere of an inextensible vesicle decay at the rate of Milner and Safran",
          "[verification]") {
    const auto [inner, outer] = GENERATE(std::pair(1e-3, 1e-3), std::pair(1e-2, 1e-3), std::pair(1e-3, 1e-2));
    const Vesicle vesicle{inner, outer, GENERATE(0.0, 7.0)};
    for (const unsigned mode : {2U, 3U, 6U}) {
        const double exact = published_rate(vesicle, mode);
        const double coarse = std::abs(computed_rate(vesicle, mode, 12) / exact - 1);
        const double fine = std::abs(computed_rate(vesicle, mode, 24) / exact - 1);
        CAPTURE(vesicle.inner, vesicle.outer, vesicle.reduced_tension, mode, exact, coarse, fine);
        CHECK(fine <
              5e-5 * std::pow(mode / 6.0, 5));  // 24 elements from pole to pole, four for one half-wave of mode 6
        CHECK(std::log2(coarse / fine) > 5);    // quintic splines: 6
    }
}
