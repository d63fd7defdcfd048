#pragma once

#include "phasefield/schemes/production/point_geometry.h"

namespace endoflow::phasefield::production {

inline constexpr double far_part = constant("far_part");

/// (35): δ_m ( ∂ψ/∂t + u·∇ψ ) = −(mobility) δ_m G. |∇ψ| = 1 is kept by fluxes along the normal. They conserve ∫H, so
/// they do not move the membrane. 20 ε² δ n·∇(∂ψ/∂t) vanishes for distance functions however they move and outweighs
/// δ_m where that is negative; M ε δ (n·∇ψ − 1) restores what is lost. Far from the layer ψ solves ∇·(∇ψ − n) = 0,
/// whose solution is the distance, for n are the normals of the curve φ = 0 there. Divided by max δ where ε is largest.
template <class Number>
void add_motion(const Fields<Number>& x, const PointGeometry<Number>& p, const PointPast& past, const StepNumbers& step,
                Fields<Number>& row) {
    const auto& psi = x[distance];
    const auto& n = past.normal;
    const double widest = step.numerics.epsilon, length = widest / (0.75 * inverse_sqrt2);  // 1/max δ
    const Number weight = length * p.density;
    Number rate =
        weight * (step.rate * psi.value + past.distance + x[velocity_r].value * psi.r + x[velocity_z].value * psi.z);
    if (step.fluid.dynamics == Dynamics::geometric) rate += step.fluid.normal_mobility * weight * x[normal_force].value;

    const Number changing_r = step.rate * psi.r + past.slope_r, changing_z = step.rate * psi.z + past.slope_z;
    const Number aligning = (step_alignment * p.epsilon * widest) * p.layer.squared_well;
    const double far = step.rates.profile_relaxation * widest * far_part;
    const Number flux = (step.profile_relaxation * widest) * p.layer.squared_well * (n.r * psi.r + n.z * psi.z - 1.0);
    row[distance] = {rate,
                     aligning * normal_part(n, n.r, changing_r, n.z, changing_z) + (flux - far) * n.r + far * psi.r,
                     aligning * normal_part(n, n.z, changing_z, n.r, changing_r) + (flux - far) * n.z + far * psi.z};
}

}  // namespace endoflow::phasefield::production
