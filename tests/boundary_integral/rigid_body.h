#pragma once

// Drag of a rigid axisymmetric body that moves along its axis, from the single layer alone:
//     int f.G dS = 8 pi mu U    on the surface,    F = int f_z dS                              (Pozrikidis 1992, Ch. 4)
// The surface is two caps that meet at the equator. Each is a membrane of the engine from its pole (xi = 0) to the
// equator (xi = 1), so both poles lie where its splines have their parity.

#include <functional>

#include "boundary_integral/operators/membrane_layers.h"

namespace endoflow::boundary_integral::testing {

struct SpheroidalBody {
    double equatorial_radius, polar_radius;
    double centre = 0;  // z
};

// What else is in the fluid beside the body.
enum class Surroundings {
    nothing,
    twin_moving_along,     // the mirror image in z = 0, moving with the same velocity
    twin_moving_opposite,  // the mirror image, moving with the opposite velocity
    wall                   // a plane no-slip wall at z = 0, through the images of Blake (1971)
};

// F/(6 pi mu U a), a the equatorial radius, with this many elements on each cap.
double drag_factor(const SpheroidalBody& body, Surroundings surroundings, Index elements);

// Velocity at x that a point force at y, in front of a no-slip wall at z = 0, causes there beyond the free-space
// Stokeslet: image_stokeslet(x, y)[i][j] = velocity i by force j, in units of 1/(8 pi mu). Blake (1971).
using Vector = std::array<double, 3>;
std::array<Vector, 3> image_stokeslet(const Vector& x, const Vector& y);

}  // namespace endoflow::boundary_integral::testing
