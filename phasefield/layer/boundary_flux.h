#pragma once

#include <functional>

#include "phasefield/fem/space.h"

namespace endoflow::phasefield {

/// −∮ ½(1 + φ) u·n dA [nm³/µs] over the open boundary: the rate at which the extracellular volume grows, if the fluid
/// is incompressible and the membrane moves with it; collective. `phi_of` makes φ of the component `level`.
double extracellular_inflow(const Space& space, const Vector& solution, unsigned int velocity_r,
                            unsigned int velocity_z, unsigned int level, const std::function<double(double)>& phi_of);

}  // namespace endoflow::phasefield
