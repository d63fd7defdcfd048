#pragma once

#include "phasefield/schemes/production/layer_energy.h"
#include "phasefield/schemes/production/step_numbers.h"
#include "phasefield/solver/linear_system.h"

namespace endoflow::phasefield::production {

// Molecules dissolved in one of the fluids (Teigen, Li, Lowengrub, Wang & Voigt, Commun. Math. Sci. 7, 1009 (2009)):
//
//   ∂(χc_b)/∂t + ∇·(χuc_b) = ∇·(χD∇c_b) − δ j/a₀,
//
// χ = ½ ± H the fluid's indicator, H' = δ, so that c_b is linear through the layer where its gradient is that of the
// fluid. The unknown is the depletion d = 1 − c_b/c_∞: what flows in through the walls has d = 0. It is transported as
//
//   χ (∂d/∂t + u·∇d) = ∇·(χD∇d) + δ j/(a₀c_∞),
//
// which keeps a constant d whatever the layer does: in its outer tail, where χ falls by e^2.8 per ε, the difference of
// χd and its past would be one of large numbers. What that loses of ∫χd is made up for by BulkTransport::take. The
// membrane sees d̄, the mean across the layer: s d̄ − ∇·(1000 ε² s N N·∇d̄) = s d, s being δ with a floor. Where it takes
// up all that comes d̄ = 0, so that c_b, again linear, vanishes in the middle of the layer and not in front of it.

/// Numbers of a bulk.
struct BulkNumbers {
    explicit BulkNumbers(const MoleculeParameters& molecules)
        : sign(molecules.bulk == Bulk::extracellular ? 1 : -1),
          diffusivity(molecules.bulk_diffusivity),
          concentration(molecules.bulk_concentration),
          coat(molecules.molecule_area * molecules.bulk_concentration),
          exchange_with_outside(molecules.bulk_reach > 0 ? molecules.bulk_diffusivity / molecules.bulk_reach : 0) {}

    double sign;                   // of ψ in the fluid
    double diffusivity;            // D [nm²/µs]
    double concentration;          // c_∞ [1/nm³]
    double coat;                   // a₀c_∞: coat that the molecules of a volume make [1/nm]
    double exchange_with_outside;  // D/ℓ [nm/µs]
};

/// The membrane, the flow and the molecules on the membrane that the bulk is solved for with.
struct BulkProblem {
    const Space* bulk;
    const BulkNumbers* numbers;
    const Space* space;
    const Vector* membrane;  // on `space`, with ghost values
    const LayerEnergy* energy;
    const StepNumbers* step;
};

/// Whether j follows the depletion that is solved for, or that of the step's supply.
enum class BulkExchange { implicit, given };

/// Matrix and right-hand side; `past` is Σ_j a_j d(t_j), with ghost values.
void assemble_bulk(const BulkProblem& problem, BulkExchange exchange, const Vector& past, LinearSystem& system);

/// The right-hand side alone, of j = 1/µs and no past.
void assemble_unit_exchange(const BulkProblem& problem, LinearSystem& system);

/// Integrals of a solution; collective.
struct BulkIntegrals {
    double missing = 0;    // a₀c_∞ ∫ χd: coat that the bulk has lost [nm²]
    double leaving = 0;    // how fast the walls make up for it: a₀c_∞ ∮ χ (max(u·n_w, 0) + D/ℓ) d [nm²/µs]
    double molecules = 0;  // ∫ χc_b
    double area = 0;       // ∫ δ [nm²]
    double at_membrane = 0;  // ∫ δ (1 − d̄) [nm²]
};
BulkIntegrals integrate_bulk(const BulkProblem& problem, const Vector& solution);

}  // namespace endoflow::phasefield::production
