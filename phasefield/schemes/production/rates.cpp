#include "phasefield/schemes/production/rates.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "phasefield/layer/constants.h"
#include "shared/model/membrane_energy.h"
#include "shared/model/time_scale.h"

namespace endoflow::phasefield::production {

namespace {

double largest_crowding(const Parameters& p) {
    constexpr int points = 100;
    const MembraneEnergy energy = bending_energy(p, std::numeric_limits<double>::infinity());  // of a mature coat
    double largest = 0;
    for (int i = 1; i <= points; ++i) {
        const double c = static_cast<double>(i) / points;
        largest = std::max(largest, std::abs(c * energy.density(0, c, 0).partial[local::concentration]));
    }
    return largest / (p.fluid.viscosity_extracellular + p.fluid.viscosity_intracellular);
}

}  // namespace

SchemeRates scheme_rates(const Parameters& p) {
    const ProductionSchemeParameters& factors = p.phase_field.production;
    const double length = length_of_structure(p), speed = length / structure_time(p);
    const double fluidity = 1 / std::min(p.fluid.viscosity_extracellular, p.fluid.viscosity_intracellular);
    SchemeRates rates;
    rates.profile_relaxation = factors.profile_relaxation * speed;
    rates.strain_relaxation = factors.strain_relaxation * speed / length;
    rates.crowding = largest_crowding(p);
    rates.stretching_alignment = factors.stretching_alignment * speed * length;
    rates.least_normal_diffusivity = constant("least_normal_diffusivity") * speed * std::pow(length, 4);
    rates.fast_membrane = constant("fast_membrane") * speed;
    rates.molecule_leak = constant("molecule_leak") * speed;
    rates.tension_alignment = factors.tension_alignment * fluidity;
    rates.tension_leak = factors.tension_leak * fluidity;
    rates.layer_pressure_alignment = constant("layer_pressure_alignment") * fluidity;
    rates.pressure_leak = constant("pressure_leak") * fluidity / p.phase_field.epsilon;
    rates.divergence_penalty = constant("divergence_penalty") * speed;
    return rates;
}

}  // namespace endoflow::phasefield::production
