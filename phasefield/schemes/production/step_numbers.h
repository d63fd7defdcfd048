#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>

#include "phasefield/contour/layer_thickness.h"
#include "phasefield/contour/material_force.h"
#include "phasefield/layer/constants.h"
#include "phasefield/layer/membrane_weight.h"
#include "phasefield/schemes/production/bulk_supply.h"
#include "phasefield/schemes/production/rates.h"
#include "shared/model/bending_model.h"
#include "shared/model/exchange.h"
#include "shared/model/loads.h"
#include "shared/model/maturation.h"
#include "shared/model/transport_law.h"
#include "shared/parameters/parameters.h"

namespace endoflow::phasefield::production {

inline constexpr double relaxation_per_speed = constant("relaxation_per_speed");
inline constexpr double slowest_alignment = constant("slowest_alignment");
inline constexpr double most_penalty = constant("most_penalty");

/// Numbers of a case, the same in all its steps.
struct CaseNumbers {
    explicit CaseNumbers(const Parameters& p)
        : numerics(p.phase_field),
          fluid(p.fluid),
          normal_diffusivity(p.molecules.normal_diffusivity),
          transport(transport_law(p.molecules)),
          exchange(exchange_law(p.molecules)),
          maturation(p.molecules),
          matured(p.membrane),
          loads(loads_of(p)),
          weight(membrane_weight(p.fluid, p.phase_field.viscosity_mean)),
          rates(scheme_rates(p)),
          inextensible(p.membrane.inextensible) {}

    PhaseFieldParameters numerics;
    FluidParameters fluid;
    double normal_diffusivity;  // of c, at least [nm²/µs]
    TransportLaw transport;
    ExchangeLaw exchange;
    MaturationLaw maturation;
    BendingModel matured;  // where χ = 1
    Loads loads;
    MembraneWeight weight;  // δ_Γ/δ
    SchemeRates rates;
    bool inextensible;  // s is one but for what the tension leaves
};

/// Numbers and data of one step, a value that does not change while the step is solved for.
struct StepNumbers : CaseNumbers {
    /// Of a membrane as fast as this [nm/µs]; as long as nothing is known it is fast.
    StepNumbers(const CaseNumbers& of_case, double a0, double speed = std::numeric_limits<double>::max())
        : CaseNumbers(of_case),
          rate(a0),
          profile_relaxation(std::min(rates.profile_relaxation, relaxation_per_speed * speed)),
          molecules_alignment(std::clamp(speed / rates.fast_membrane, slowest_alignment, 1.0)),
          divergence_penalty(speed > 0 ? std::min(most_penalty, rates.divergence_penalty / speed) : most_penalty) {}

    double rate;                                          // a₀ [1/µs]
    double profile_relaxation;                            // M_p [nm/µs]
    double molecules_alignment;                           // part of least_normal_diffusivity
    double divergence_penalty;                            // γ, of ∇·u over ν
    double molecules = 0;                                 // ∫ c dA, predicted [nm²]: what the pool has lost
    double coat_force = 0;                                // F_a/∫ c dA [pN/nm²]
    double maturation_rate = 0;                           // dχ/dt [1/µs]
    std::shared_ptr<const CellThickness> thickness;       // of the layer; none: uniform
    std::shared_ptr<const MaterialForce> material_force;  // none: zero
    std::shared_ptr<const BulkSupply> supply;             // none: the bulk is never depleted

    /// ε at the point (x, y) of a unit cell.
    [[nodiscard]] PointThickness thickness_at(std::size_t active_cell, const CellBox& box, double x, double y) const {
        return thickness ? thickness->at(active_cell, box, x, y) : PointThickness{numerics.epsilon};
    }
};

}  // namespace endoflow::phasefield::production
