// Decay of the shape modes of a nearly spherical, inextensible, closed membrane in unbounded fluid. Published for equal
// viscosities (S. T. Milner & S. A. Safran, Phys. Rev. A 36, 4371 (1987)):
//     rate_l = beta/(nu R^3) (l-1) l (l+1) (l+2) [l (l+1) + sigma] / ((2 l + 1)(2 l^2 + 2 l - 1)),  sigma = lambda
//     R^2/beta.
// With nu1 inside and nu2 outside the denominator is
//     nu1 (l-1)(2 l^2 + 5 l + 5) + nu2 (l+2)(2 l^2 - l + 2),
// from Lamb's solution: the velocity on the sphere is Y r + 2/(l (l+1)) grad Y, both fluids' normal tractions are their
// pressures nu1 (l-1)(2 l + 3)/l and -nu2 (l+2)(2 l - 1)/(l+1), and the tension [nu1 (l-1) + nu2 (l+2)]/(l (l+1)) that
// balances the shear adds twice itself. Both denominators agree for nu1 = nu2.

#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "boundary_integral/flow/dense_solver.h"
#include "boundary_integral/membrane/energy.h"
#include "boundary_integral/operators/membrane_layers.h"
#include "curves.h"

namespace {

using namespace endoflow;
using namespace endoflow::boundary_integral;
using namespace endoflow::boundary_integral::testing;

constexpr double pi = std::numbers::pi;
constexpr double radius = 20;  // nm

struct Vesicle {
    double inner, outer;     // viscosities, pN us/nm^2
    double reduced_tension;  // sigma
    MembraneParameters membrane;

    double stiffness() const { return BendingModel(membrane).stiffness(0).value; }
};

double published_rate(const Vesicle& vesicle, unsigned mode) {
    const double l = mode;
    const double friction = vesicle.inner * (l - 1) * (2 * l * l + 5 * l + 5) +  //
                            vesicle.outer * (l + 2) * (2 * l * l - l + 2);
    return vesicle.stiffness() / std::pow(radius, 3) * (l - 1) * l * (l + 1) * (l + 2) *
           (l * (l + 1) + vesicle.reduced_tension) / friction;
}

// The velocities (curve_count rows) and force densities (force_count rows) of a curve that closes at both poles. At
// xi = 0 the splines' parity sees to it; at xi = 1 the radial components vanish, and so do the first and third
// derivative of the axial velocity, which leaves as many velocities as force densities.
struct ClosedCurve {
    Eigen::MatrixXd velocity, force;

    explicit ClosedCurve(const MembraneSpace& space) {
        const Index radial = space.radial_count(), axial = space.axial_count(), kept = axial - 2;
        Eigen::MatrixXd odd_derivatives(2, axial);
        for (Index i = 0; i < axial; ++i) {
            const auto d = space.axial().taylor(Eigen::VectorXd::Unit(axial, i), 1.0, space.elements() - 1);
            odd_derivatives.col(i) << d[1], d[3];
        }
        velocity = Eigen::MatrixXd::Zero(radial + axial, radial - 1 + kept);
        velocity.topLeftCorner(radial - 1, radial - 1).setIdentity();
        velocity.block(radial, radial - 1, kept, kept).setIdentity();
        velocity.bottomRightCorner(2, kept) =
            -odd_derivatives.rightCols(2).partialPivLu().solve(odd_derivatives.leftCols(kept));
        force = Eigen::MatrixXd::Zero(space.force_count(), radial - 1 + kept);
        force.topLeftCorner(radial - 1, radial - 1).setIdentity();
        force.bottomRightCorner(kept, kept).setIdentity();
    }
};

// Velocity coefficients of the membrane under its bending force, a given mean tension and the local tension that keeps
// its area, but for a uniform stretch: on a sphere that one is of second order, and it would fix the mean tension.
Eigen::VectorXd velocity_of(const MembraneSpace& space, const MembraneState& state, const Vesicle& vesicle) {
    const MembraneSamples samples = sample(space, state);
    const auto [expand, force] = ClosedCurve(space);
    const Index rows = expand.cols();
    std::vector<MembraneTarget> targets;
    Eigen::MatrixXd velocity_matrix = Eigen::MatrixXd::Zero(rows, space.curve_count());
    Index row = 0;
    const auto add = [&](double xi, bool radial) {
        const BasisRow in_r = space.radial().basis(xi), in_z = space.axial().basis(xi);
        const CurvePoint p = curve_point(in_r, in_z, state);
        targets.push_back({{p.r, p.z}, radial ? TargetRows{row, -1} : TargetRows{-1, row}, xi});
        const BasisRow& basis = radial ? in_r : in_z;
        for (std::size_t j = 0; j < 6; ++j)
            velocity_matrix(row, (radial ? 0 : space.radial_count()) + basis.index[j]) +=
                4 * pi * (vesicle.inner + vesicle.outer) * basis.value[0][j];
        ++row;
    };
    for (std::size_t i = 0; i + 1 < space.radial_targets.size(); ++i) add(space.radial_targets[i], true);
    for (const double xi : space.axial_targets) add(xi, false);
    const MembraneLayers layers = membrane_layers(space, state, samples, targets, rows, {});
    velocity_matrix += (vesicle.inner - vesicle.outer) * layers.doubled;

    const LuFactors mass(expand.transpose() * force_mass_matrix(space, samples) * force, "force mass");
    const LuFactors resistance(velocity_matrix * expand, "velocity");
    const Eigen::MatrixXd mobility =
        resistance.solve(layers.single * force * mass.solve(Eigen::MatrixXd::Identity(rows, rows)));

    const Eigen::MatrixXd divergence = divergence_matrix(space, samples) * expand;
    const double mean_tension = vesicle.reduced_tension * vesicle.stiffness() / (radius * radius);
    const Index tensions = divergence.rows();
    const Eigen::VectorXd bending =
        bending_energy(space, state, BendingModel(vesicle.membrane), Derivatives::first).gradient;
    const Eigen::VectorXd load =
        -expand.transpose() * bending - divergence.transpose() * Eigen::VectorXd::Constant(tensions, mean_tension);
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(tensions);  // of a tension over the membrane's area
    for (std::size_t i = 0; i < space.xi.size(); ++i)
        for (int k = 0; k < space.tension_rows[i].count; ++k)
            mean[space.tension_rows[i].index[static_cast<std::size_t>(k)]] +=
                space.weight[i] * samples.curve[i].r * samples.curve[i].g *
                space.tension_rows[i].value[0][static_cast<std::size_t>(k)];
    Eigen::MatrixXd bordered = Eigen::MatrixXd::Zero(tensions + 1, tensions + 1);
    bordered.topLeftCorner(tensions, tensions) = divergence * mobility * divergence.transpose();
    bordered.topRightCorner(tensions, 1) = mean;
    bordered.bottomLeftCorner(1, tensions) = mean.transpose();
    Eigen::VectorXd stretch = Eigen::VectorXd::Zero(tensions + 1);
    stretch.head(tensions) = divergence * (mobility * load);
    const Eigen::VectorXd tension = LuFactors(bordered, "tension").solve(stretch).topRows(tensions);
    return expand * (mobility * (load - divergence.transpose() * tension));
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
    const MembraneSpace space(elements, 8);
    const double epsilon = 1e-4;
    return -(modal_velocity(space, vesicle, mode, epsilon) - modal_velocity(space, vesicle, mode, -epsilon)) /
           (2 * epsilon * radius);
}

}  // namespace

TEST_CASE("shape modes of a sphere of an inextensible vesicle decay at the rate of Milner and Safran",
          "[verification]") {
    const auto [inner, outer] = GENERATE(std::pair(1e-3, 1e-3), std::pair(1e-2, 1e-3), std::pair(1e-3, 1e-2));
    const Vesicle vesicle{inner, outer, GENERATE(0.0, 7.0), {}};
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
