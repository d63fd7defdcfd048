#pragma once

#include "phasefield/schemes/paper/layer_fields.h"

namespace endoflow::phasefield::paper {

template <class Function>
Coefficients at_layer_points(const std::vector<LayerPoint>& points, const Function& coefficient) {
    Coefficients out(points.size());
    for (std::size_t q = 0; q < points.size(); ++q) out[q] = coefficient(points[q], q);
    return out;
}

/// (38)-(40): ( |∇φ| y − |∇φⁿ| yⁿ )/τ + ∇·(|∇φ| u y), the flux integrated by parts; y is `component`, its row `test`.
inline void add_conserved_rate(const std::vector<LayerPoint>& points, double tau, unsigned int test,
                               unsigned int component, LocalSystem& local) {
    using Index = std::size_t;
    local.linear(test, Op::value, component, Op::value,
                 at_layer_points(points, [&](const auto& p, Index) { return p.measure * p.weight / tau; }));
    local.residual(test, Op::value, at_layer_points(points, [&](const auto& p, Index) {
                       return -p.measure * p.weight_old / tau * p.value_old;
                   }));
    local.linear(test, Op::dr, component, Op::value,
                 at_layer_points(points, [](const auto& p, Index) { return -p.measure * p.weight * p.velocity_r; }));
    local.linear(test, Op::dz, component, Op::value,
                 at_layer_points(points, [](const auto& p, Index) { return -p.measure * p.weight * p.velocity_z; }));
}

/// −D ∇·(|∇φ| ∇y), weakly ∫ D |∇φ| ∇y·∇η.
inline void add_layer_diffusion(const std::vector<LayerPoint>& points, double diffusivity, unsigned int test,
                                unsigned int component, LocalSystem& local) {
    const auto weight =
        at_layer_points(points, [&](const auto& p, std::size_t) { return p.measure * diffusivity * p.weight; });
    local.linear(test, Op::dr, component, Op::dr, weight);
    local.linear(test, Op::dz, component, Op::dz, weight);
}

/// (38), (39): −D_n ∇·(|∇φ| n n·∇y), the diffusion across the layer.
inline void add_normal_diffusion(const std::vector<LayerPoint>& points, double diffusivity, unsigned int test,
                                 unsigned int component, LocalSystem& local) {
    const auto weight = [&](const auto& p) { return p.measure * diffusivity * p.weight; };
    const auto rr = at_layer_points(
        points, [&](const auto& p, std::size_t) { return weight(p) * p.layer.normal_r * p.layer.normal_r; });
    const auto rz = at_layer_points(
        points, [&](const auto& p, std::size_t) { return weight(p) * p.layer.normal_r * p.layer.normal_z; });
    const auto zz = at_layer_points(
        points, [&](const auto& p, std::size_t) { return weight(p) * p.layer.normal_z * p.layer.normal_z; });
    local.linear(test, Op::dr, component, Op::dr, rr);
    local.linear(test, Op::dr, component, Op::dz, rz);
    local.linear(test, Op::dz, component, Op::dr, rz);
    local.linear(test, Op::dz, component, Op::dz, zz);
}

}  // namespace endoflow::phasefield::paper
