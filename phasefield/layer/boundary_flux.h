#pragma once

#include <deal.II/base/quadrature.h>

#include <functional>

#include "phasefield/fem/space.h"

namespace endoflow::phasefield {

/// n Gauss points on one of the four faces of the unit cell, as points of the cell.
dealii::Quadrature<2> face_quadrature(unsigned int face, unsigned int n);

/// −∮ ½(1 + φ) u·n dA [nm³/µs] over the open boundary: the rate at which the extracellular volume grows, if the fluid
/// is incompressible and the membrane moves with it; collective. `phi_of` makes φ of the component `level`.
double extracellular_inflow(const Space& space, const Vector& solution, unsigned int velocity_r,
                            unsigned int velocity_z, unsigned int level, const std::function<double(double)>& phi_of);

}  // namespace endoflow::phasefield
