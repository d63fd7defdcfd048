#pragma once

#include "phasefield/schemes/production/normal_diffusion.h"

namespace endoflow::phasefield::production {

inline constexpr double far_part = constant("far_part");

/// (35), times 1/max δ where ε is largest, ε₀:
///
///   δ_N (∂_tψ + u·∇ψ + M_n G) = ∇·[ δ (20 ε² N N·∇∂_tψ + M_p ε N (N·∇ψ − 1)) + far (∇ψ − N) ],
///
/// M_n G without a fluid alone. The fluxes along the normal keep |∇ψ| = 1 and conserve what δ_N weighs, so they do not
/// move the membrane. The first vanishes for distance functions however they move and outweighs δ_N where that is
/// negative; the second restores what is lost. Far from the layer ψ solves ∇·(∇ψ − N) = 0, whose solution is the
/// distance, for N are the normals of the curve φ = 0 there.
template <class Number>
void add_motion(const Fields<Number>& x, const PointGeometry<Number>& p, const PointPast& past, const StepNumbers& step,
                Fields<Number>& row) {
    const auto& psi = x[distance];
    const Direction& N = past.normal;
    const double widest = step.numerics.epsilon, length = widest / (0.75 * inverse_sqrt2);  // 1/max δ
    Number moving = step.rate * psi.value + past.distance + x[velocity_r].value * psi.r + x[velocity_z].value * psi.z;
    if (step.fluid.dynamics == Dynamics::geometric) moving += step.fluid.normal_mobility * x[normal_force].value;
    const PlaneVector<Number> changing{step.rate * psi.r + past.slope_r, step.rate * psi.z + past.slope_z};
    const PlaneVector<Number> along = normal_part(N, changing);
    const Number aligning = (alignment * p.epsilon * widest) * p.layer.well;
    const Number restoring = (step.profile_relaxation * widest) * p.layer.well * (dot(N, psi) - 1.0);
    const double far = step.rates.profile_relaxation * widest * far_part;
    row[distance] = {length * p.delta_N * moving, aligning * along.r + restoring * N.r + far * (psi.r - N.r),
                     aligning * along.z + restoring * N.z + far * (psi.z - N.z)};
}

}  // namespace endoflow::phasefield::production
