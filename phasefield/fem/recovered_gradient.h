#pragma once

#include "phasefield/fem/space.h"

namespace endoflow::phasefield {

/// A continuous gradient of one component of `field` (a vector of `space`): the average of the cells' gradients at the
/// nodes of `gradient_space` (two components, same degree). ∂/∂r vanishes on the axis. The divergence of the normal
/// made of it misses no jumps between cells; with the discontinuous one the profile relaxation moves kinks of the
/// membrane explicitly, which is unstable for steps above h²/(M ε).
Vector recover_gradient(const Space& space, unsigned int component, const Vector& field, const Space& gradient_space);

}  // namespace endoflow::phasefield
