#pragma once

// Shapes and coefficient vectors that several tests share.

#include <functional>

#include "boundary_integral/evolution/mesh_motion.h"
#include "boundary_integral/membrane/membrane_space.h"
#include "shared/parameters/parameters.h"

namespace endoflow::boundary_integral::testing {

using Profile = std::function<double(double)>;

inline Eigen::VectorXd spline_of(const SplineSpace& space, const Profile& profile) {
    std::vector<double> values;
    for (const double xi : space.greville_points()) values.push_back(profile(xi));
    return interpolate(space, values);
}

inline MembraneState state_of(const MembraneSpace& space, const Profile& r, const Profile& z, const Profile& c) {
    return {spline_of(space.radial(), r), spline_of(space.axial(), z), spline_of(space.axial(), c)};
}

// A bulged membrane, clamped at the rim of the standard box, with a smooth coat.
inline MembraneState bulge(const MembraneSpace& space, double height) {
    return state_of(
        space, [](double x) { return 80 * x + 3 * x * (1 - x * x) * (1 - x * x); },
        [height](double x) { return 80 + height * (1 - x * x) * (1 - x * x) * (1 - x * x); },
        [](double x) { return 0.9 * std::exp(-12 * x * x * x * x); });
}

}  // namespace endoflow::boundary_integral::testing
