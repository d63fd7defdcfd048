#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>

#include "phasefield/schemes/production/layer_energy.h"
#include "phasefield/schemes/production/point_geometry.h"
#include "phasefield/schemes/production/step_numbers.h"

namespace endoflow::phasefield::production {

// A membrane is one surface and not a stack of sheets: fields on it are kept constant along the normal, by a diffusion
// along it, −∇·(D N N·∇y) on the left side of the field's equation. Besides, m is kept so by a term of (L), ∂ψ/∂t by
// one of (35), and what the membrane sees of a bulk by one of its own equation.

/// A diffusivity along the normal [nm²/µs] made fast within a step: δ_Γ is negative in the layer's tails, where without
/// it y would grow.
inline double within_a_step(double diffusivity, double epsilon, const StepNumbers& step) {
    return diffusivity + alignment * epsilon * epsilon * step.rate;
}

/// D of c [nm²/µs], larger the thinner the layer. The shear within the layer tilts c's level lines off the normal, by
/// shear rate × ε²/D, and the force e_c ∇c with them: with a constant D the volume's error grew as ε fell, and so it
/// did with normals that lagged behind in the layer's tails by as little as a tenth of a step. On cells c is constant
/// along the normal but for an error, and what D moves there also goes along the membrane, out of the coat. So D fades
/// with the shear, which goes with the membrane's speed.
inline double molecule_alignment(double epsilon, const StepNumbers& step) {
    const double least = step.molecules_alignment * step.rates.least_normal_diffusivity / (epsilon * epsilon * epsilon);
    return within_a_step(std::max(step.normal_diffusivity, least), epsilon, step);
}

enum class NormalOf {
    iterate,     // ψ's own
    line,        // of the straight line through the last two solutions
    time_scheme  // of the polynomial of the time scheme
};
enum class LayerWeight { delta, delta_E, well };  // δ with a floor, δ_E, (1 − φ²)² with a floor

/// One row of the table.
struct NormalDiffusion {
    Field field;
    double (*diffusivity)(double epsilon, const StepNumbers&);  // D over the weight
    LayerWeight weight;
    NormalOf normal;
    bool fades;                                    // where layers meet, so that nothing passes from one to the other
    double (*leak)(const StepNumbers&) = nullptr;  // −∇·(leak φ⁴ ∇y) far from the layer: it defines y there
    bool only_coupled = false;                     // where the energy knows ∇_Γ c
};

/// The rows of λ and p_Γ are conditions: on the left side of those stands minus the diffusion. G's normal is that of
/// the iterate, for a predicted one, turned by as little as a step's error, shifts the force along the membrane; what
/// the diffusion takes from G's net force is given back to the fluid. A coupled energy's μ would be another one on each
/// sheet.
inline constexpr NormalDiffusion normal_diffusions[] = {
    {normal_force, [](double epsilon, const StepNumbers&) { return alignment * epsilon * epsilon; }, LayerWeight::delta,
     NormalOf::iterate, false},
    {tension, [](double, const StepNumbers& step) { return -step.rates.tension_alignment; }, LayerWeight::well,
     NormalOf::line, true, [](const StepNumbers& step) { return -step.rates.tension_leak; }},
    {pressure_layer, [](double, const StepNumbers& step) { return -step.rates.layer_pressure_alignment; },
     LayerWeight::well, NormalOf::line, true, [](const StepNumbers& step) { return -step.rates.tension_leak; }},
    {molecule_density, molecule_alignment, LayerWeight::delta, NormalOf::time_scheme, true,
     [](const StepNumbers& step) { return step.rates.molecule_leak; }},
    {membrane_stretch,
     [](double epsilon, const StepNumbers& step) {
         return within_a_step(step.rates.stretching_alignment, epsilon, step);
     },
     LayerWeight::delta, NormalOf::line, true},
    {molecule_potential, [](double epsilon, const StepNumbers&) { return strong_alignment * epsilon * epsilon; },
     LayerWeight::delta_E, NormalOf::line, false, nullptr, true},
};

/// The row of a field.
consteval std::size_t diffusion_of(Field field) {
    std::size_t k = 0;
    while (normal_diffusions[k].field != field) ++k;
    return k;
}

/// (N N + (1 − |N|²))·v, the part of v along the normal: all of it where normals cross and N vanishes.
template <class Normal, class Vector>
auto normal_part(const PlaneVector<Normal>& N, const Vector& v) {
    const Normal rest = 1.0 - dot(N, N), across = N.r * N.z;
    using Number = decltype(rest * v.r);
    return PlaneVector<Number>{(rest + N.r * N.r) * v.r + across * v.z, (rest + N.z * N.z) * v.z + across * v.r};
}

/// D of a row of the table at a point.
template <std::size_t k, class Number>
Number diffusivity(const PointGeometry<Number>& p, const PointPast& past, const StepNumbers& step) {
    constexpr const NormalDiffusion& of = normal_diffusions[k];
    const double value = (of.fades ? past.even : 1) * of.diffusivity(p.epsilon, step);
    if constexpr (of.weight == LayerWeight::delta)
        return value * p.delta_floored;
    else if constexpr (of.weight == LayerWeight::delta_E)
        return value * p.delta_E;
    else
        return value * (p.layer.well + weight_cut);
}

template <std::size_t k, class Number>
void add_normal_diffusion(const Fields<Number>& x, const PointGeometry<Number>& p, const PointPast& past,
                          const StepNumbers& step, const LayerEnergy& energy, Fields<Number>& row) {
    constexpr const NormalDiffusion& of = normal_diffusions[k];
    if (of.only_coupled && !energy.coupled) return;
    const auto& y = x[of.field];
    const auto along = [&] {
        if constexpr (of.normal == NormalOf::iterate)
            return normal_part(p.own_normal, y);
        else
            return normal_part(of.normal == NormalOf::line ? past.normal : past.molecules_normal, y);
    }();
    const Number D = diffusivity<k>(p, past, step);
    add_flux<Number>({D * along.r, D * along.z}, row[of.field]);
    if constexpr (of.leak != nullptr) {
        const Number phi2 = p.layer.phi * p.layer.phi, leak = of.leak(step) * phi2 * phi2;
        add_flux<Number>({leak * y.r, leak * y.z}, row[of.field]);
    }
}

/// Carries out the table.
template <class Number>
void add_normal_diffusions(const Fields<Number>& x, const PointGeometry<Number>& p, const PointPast& past,
                           const StepNumbers& step, const LayerEnergy& energy, Fields<Number>& row) {
    [&]<std::size_t... k>(std::index_sequence<k...>) {
        (add_normal_diffusion<k>(x, p, past, step, energy, row), ...);
    }
    (std::make_index_sequence<std::size(normal_diffusions)>());
}

}  // namespace endoflow::phasefield::production
