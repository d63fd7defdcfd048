#include "boundary_integral/fields/ring_layers.h"

#include <numbers>

namespace endoflow::boundary_integral {

void RingLayers::start(const Target& target) {
    target_ = target;
    count_ = 0;
}

void RingLayers::add(std::span<const ChargedRing> rings) {
    if (count_ + rings.size() > sources_.size()) {
        sources_.resize(2 * (count_ + rings.size()));
        densities_.resize(sources_.size());
    }
    for (const auto& [point, density] : rings) {
        const double dr = point.r - target_.r;
        const double dz = point.z - target_.z;
        sources_.radius[count_] = point.r;
        sources_.delta_r[count_] = dr;
        sources_.delta_z[count_] = dz;
        sources_.normal_r[count_] = point.normal_r;
        sources_.normal_offset[count_] = point.normal_r * dr + point.normal_z * dz;
        densities_.force_r[count_] = density.force_r;
        densities_.force_z[count_] = density.force_z;
        densities_.momentum_r[count_] = density.momentum_r;
        densities_.momentum_z[count_] = density.momentum_z;
        densities_.pressure_r[count_] = density.pressure_r;
        densities_.pressure_z[count_] = density.pressure_z;
        ++count_;
    }
}

RingLayers::Sum RingLayers::evaluate() {
    evaluate_ring_layers(target_.r, count_, sources_, densities_, contributions_);
    Sum sum{};
    for (std::size_t i = 0; i < count_; ++i) {
        sum.momentum_r += contributions_.momentum_r[i];
        sum.momentum_z += contributions_.momentum_z[i];
        sum.pressure -= contributions_.pressure[i];
    }
    sum.pressure /= 4.0 * std::numbers::pi;  // Phi = - x / ρ³
    return sum;
}

}  // namespace endoflow::boundary_integral
