#pragma once

#include <functional>

#include "statics/boundary_value_problem.h"

namespace endoflow::statics {

// Stationary shapes of a closed membrane of given area and enclosed volume, as a first-order system in the material
// label a = A/2π, x = a/a(south pole). docs/statics.md derives it. The states are those of shape_equations.h; the
// pressure p = p_inside − p_outside is unknown, and the tension follows as a first integral.

/// Indices of the states.
namespace vesicle {
inline constexpr Eigen::Index r_squared = 0;  // y = r², nm²
inline constexpr Eigen::Index cosine = 1;     // w = cos θ = dr/ds
inline constexpr Eigen::Index hoop = 2;       // κ2 = sin θ/r, 1/nm; positive on a sphere
inline constexpr Eigen::Index moment = 3;     // m = β (κ − C), pN
inline constexpr Eigen::Index thrust = 4;     // Q, radial resultant of tension and shear, pN/nm
inline constexpr Eigen::Index height = 5;     // z, 0 at the north pole, nm
inline constexpr Eigen::Index volume = 6;     // V/π above the parallel, nm³
inline constexpr Eigen::Index energy = 7;     // bending energy above the parallel over 2π, pN nm
inline constexpr Eigen::Index states = 8;
inline constexpr Eigen::Index pressure = 0;  // the only global unknown, pN/nm²
}  // namespace vesicle

/// What the membrane of a vesicle is made of and has to enclose.
struct ClosedMembrane {
    double stiffness = 0;              // β, pN nm
    double spontaneous_curvature = 0;  // C, 1/nm
    double area = 0;                   // nm²
    double volume = 0;                 // nm³
    double polarity = 0;  // C varies from C + polarity at the north pole to C − polarity at the south, 1/nm

    /// Radius of the sphere with this area, nm.
    [[nodiscard]] double sphere_radius() const;
    /// Volume over that of this sphere, 0 < v ≤ 1.
    [[nodiscard]] double reduced_volume() const;
};

/// The same membrane with another volume.
[[nodiscard]] ClosedMembrane with_reduced_volume(ClosedMembrane membrane, double reduced_volume);

/// Makes a membrane out of the value of the parameter that varies.
using MembranePath = std::function<ClosedMembrane(double)>;

/// The stationary vesicles along a path. `scale` is a typical change of the path's parameter.
[[nodiscard]] BoundaryValueProblem vesicle_shapes(const MembranePath& path, double typical_value, double scale);

/// λ = m κ1 + Q cos θ + ½ p r sin θ − m²/(2β), the same at every point of a membrane without polarity, pN/nm.
[[nodiscard]] double vesicle_tension(const ClosedMembrane& membrane, const Eigen::VectorXd& states, double pressure);

}  // namespace endoflow::statics
