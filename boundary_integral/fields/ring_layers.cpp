#include "boundary_integral/fields/ring_layers.h"

#include <numbers>

namespace endoflow::boundary_integral {

void RingLayers::start(const Target& target) {
    target_ = target;
    sources_.resize(0);
    densities_.clear();
}

void RingLayers::add(const RingPoint& point, const RingDensity& density) {
    const double dr = point.r - target_.r;
    const double dz = point.z - target_.z;
    sources_.radius.push_back(point.r);
    sources_.delta_r.push_back(dr);
    sources_.delta_z.push_back(dz);
    sources_.normal_r.push_back(point.normal_r);
    sources_.normal_offset.push_back(point.normal_r * dr + point.normal_z * dz);
    densities_.push_back(density);
}

RingLayers::Sum RingLayers::evaluate() {
    evaluate_ring_kernels(target_.r, sources_, kernels_);
    evaluate_ring_pressures(target_.r, sources_, pressures_);
    Sum sum{};
    for (std::size_t i = 0; i < densities_.size(); ++i) {
        const RingDensity& d = densities_[i];
        sum.momentum_r += kernels_.g_rr[i] * d.force_r + kernels_.g_rz[i] * d.force_z -
                          kernels_.t_rr[i] * d.momentum_r - kernels_.t_rz[i] * d.momentum_z;
        sum.momentum_z += kernels_.g_zr[i] * d.force_r + kernels_.g_zz[i] * d.force_z -
                          kernels_.t_zr[i] * d.momentum_r - kernels_.t_zz[i] * d.momentum_z;
        sum.pressure -= (pressures_.p_r[i] * d.pressure_r + pressures_.p_z[i] * d.pressure_z);
    }
    sum.pressure /= 4.0 * std::numbers::pi;  // Phi = - x / rho^3
    return sum;
}

}  // namespace endoflow::boundary_integral
