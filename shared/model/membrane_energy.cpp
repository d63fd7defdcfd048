#include "shared/model/membrane_energy.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "shared/model/bending_term.h"
#include "shared/model/line_energy_term.h"
#include "shared/support/error.h"

namespace endoflow {

bool energetically_coupled(const MoleculeParameters& molecules) {
    return molecules.coupling == Coupling::energetic;
}

MembraneEnergy bending_energy(const Parameters& parameters, double time) {
    return MembraneEnergy().add(BendingTerm{bending_model(parameters, time)});
}

MembraneEnergy line_energy(const Parameters& parameters) {
    const MoleculeParameters& molecules = parameters.molecules;
    if (!energetically_coupled(molecules)) return {};
    return MembraneEnergy().add(LineEnergyTerm{molecules.line_energy, molecules.interface_width});
}

MembraneEnergy membrane_energy(const Parameters& parameters, double time) {
    return bending_energy(parameters, time).add(line_energy(parameters));
}

LocalJet MembraneEnergy::density(double curvature, double concentration, double squared_gradient) const {
    const LocalShape<LocalJet> at{LocalJet::variable(curvature, local::curvature),
                                  LocalJet::variable(concentration, local::concentration),
                                  LocalJet::variable(squared_gradient, local::squared_gradient)};
    LocalJet sum;
    for (const auto& term : terms_) sum += term(at);
    return sum;
}

LocalJet MembraneEnergy::conjugate(double moment, double concentration, double squared_gradient, double near) const {
    constexpr int most_iterations = 50;
    constexpr double round_off = 1e-13;
    if (!std::isfinite(moment + concentration + squared_gradient)) return std::numeric_limits<double>::quiet_NaN();
    double curvature = near;
    for (int i = 0; i < most_iterations; ++i) {
        const LocalJet e = density(curvature, concentration, squared_gradient);
        const double stiffness = e.second[local::curvature][local::curvature];
        const double change = (moment - e.partial[local::curvature]) / stiffness;
        if (!std::isfinite(change)) break;
        if (std::abs(change) > round_off * (std::abs(curvature) + std::abs(moment / stiffness))) {
            curvature += change;
            continue;
        }
        LocalJet result(moment * curvature - e.value);
        result.partial[local::moment] = curvature;
        result.second[local::moment][local::moment] = 1 / stiffness;
        for (const std::size_t a : {local::concentration, local::squared_gradient}) {
            result.partial[a] = -e.partial[a];
            const double slope = -e.second[local::curvature][a] / stiffness;  // ∂κ/∂a
            result.second[local::moment][a] = result.second[a][local::moment] = slope;
            for (const std::size_t b : {local::concentration, local::squared_gradient})
                result.second[a][b] = -e.second[a][b] - slope * e.second[local::curvature][b];
        }
        return result;
    }
    throw SolverError(
        "no-curvature",
        fmt::format("no total curvature has the bending moment {:g} pN at c = {:g}", moment, concentration),
        "choose an energy per area that is convex in the curvature");
}

}  // namespace endoflow
