#pragma once

#include "shared/parameters/parameters.h"

namespace endoflow {

/// Initial concentration at distance r (nm) from the axis on the flat membrane: the equilibrium profile of (24),
/// c = ½ (1 − tanh((r − r_c)/(√2 ε_c))).
[[nodiscard]] double initial_concentration(const MoleculeParameters& molecules, double r);

/// ∫ c r dr of that profile from the axis to r, nm².
[[nodiscard]] double initial_coat_within(const MoleculeParameters& molecules, double r);

}  // namespace endoflow
