#pragma once

#include "shared/model/bending_model.h"
#include "shared/model/loads.h"
#include "shared/model/membrane_energy.h"
#include "shared/parameters/parameters.h"
#include "statics/boundary_value_problem.h"
#include "statics/closed_membrane.h"

namespace endoflow::statics {

// The stationary membrane as a first-order system: from the axis to the rim of the box, or to the second pole of a
// vesicle. docs/statics.md derives it.
//
// The independent variable is the material: a = A/2π, the membrane area between the axis and a point over 2π, so that
// ds = da/r and local inextensibility needs no equation. x = a/E with E = a at the end, which is unknown in the box,
// because membrane flows in at the rim. With θ the slope angle of the meridian (r_s = cos θ, z_s = −sin θ), all of the
// following are smooth functions of a, also on the axis where r and θ are not:

/// Indices of the states.
namespace state {
inline constexpr Eigen::Index r_squared = 0;  // y = r², nm²
inline constexpr Eigen::Index cosine = 1;     // w = cos θ
inline constexpr Eigen::Index hoop = 2;       // κ2 = sin θ/r, the principal curvature around the axis, 1/nm
inline constexpr Eigen::Index moment = 3;     // m = ∂e/∂κ = β (κ − C), pN
inline constexpr Eigen::Index thrust = 4;     // Q, radial resultant of tension and shear, pN/nm
inline constexpr Eigen::Index height = 5;     // z, nm
inline constexpr Eigen::Index frozen_states = 6;
// only where the molecules have diffused to their equilibrium:
inline constexpr Eigen::Index concentration = 6;  // c
inline constexpr Eigen::Index gradient = 7;       // q = r² dc/da = r dc/ds
inline constexpr Eigen::Index mass = 8;           // ∫ c da, nm²
inline constexpr Eigen::Index equilibrium_states = 9;
// only of a vesicle, whose height is 0 at the first pole:
inline constexpr Eigen::Index volume = 6;  // V/π above the parallel, nm³
inline constexpr Eigen::Index energy = 7;  // E above the parallel over 2π, pN nm
inline constexpr Eigen::Index closed_states = 8;
}  // namespace state

/// Indices of the global unknowns.
namespace global {
inline constexpr Eigen::Index area = 0;       // E, membrane area over 2π, nm²
inline constexpr Eigen::Index potential = 1;  // μ of the molecules: Cahn-Hilliard in 1/nm, over σ̂ where coupled;
                                              // Fickian: the concentration
inline constexpr Eigen::Index pressure = 0;   // the only one of a vesicle: p inside minus outside, pN/nm²
}  // namespace global

/// A case and its energy: that of its parameters unless another one is given.
struct StationaryCase {
    Parameters parameters;
    MembraneEnergy energy;

    StationaryCase(const Parameters& p)
        : StationaryCase(p, membrane_energy(p)) {}  // NOLINT(google-explicit-constructor)
    StationaryCase(const Parameters& p, MembraneEnergy e) : parameters(p), energy(std::move(e)) {}
};

/// Whether the molecules stay where they are in the material (transport by advection) or are in equilibrium.
[[nodiscard]] bool molecules_are_frozen(const Parameters& parameters);

/// The membrane's initial concentration at material label a (nm²), as a function of the radius √(2a) it had.
[[nodiscard]] double initial_concentration_of_material(const MoleculeParameters& molecules, double a);

/// What follows from the states at one point.
struct PointOfShape {
    double r, z, cosine, sine;
    double c;
    double squared_gradient;  // |∇_Γ c|², 1/nm²
    double total_curvature;   // κ, 1/nm
    double tension;           // λ, pN/nm: the first integral
    double energy_density;    // e, pN/nm
    double shear;             // dm/ds, pN/nm
};

/// y: the states at material label a (nm²).
[[nodiscard]] PointOfShape point_of_shape(const StationaryCase& stationary, double a, const Eigen::VectorXd& y);

/// The same of a vesicle at x = a/a(second pole).
[[nodiscard]] PointOfShape point_of_vesicle(const ClosedMembrane& membrane, double pressure, double x,
                                            const Eigen::VectorXd& y);

/// Makes a case out of the value of the parameter that varies.
using CasePath = std::function<StationaryCase(double)>;

/// The stationary shapes along a path of cases. `scale` is a typical change of the path's parameter.
[[nodiscard]] BoundaryValueProblem stationary_shapes(const CasePath& path, double typical_value, double scale);
[[nodiscard]] BoundaryValueProblem stationary_shapes(const MembranePath& path, double typical_value, double scale);

/// The flat membrane, the solution at vanishing spontaneous curvature; in equilibrium only a guess for the molecules.
struct FlatMembrane {
    Parameters parameters;

    [[nodiscard]] Eigen::VectorXd states(double x) const;
    [[nodiscard]] Eigen::VectorXd slopes(double x) const;
    [[nodiscard]] Eigen::VectorXd globals() const;
};

}  // namespace endoflow::statics
