#pragma once

// Molecules that come onto the membrane and leave it: d(m_k)/dt = ∫ φ_k j dA, j(c, de/dc, m) the exchange law's,
// m = 2π Σ_k m_k the mass of all there are.

#include <Eigen/Core>

#include "boundary_integral/membrane/membrane_space.h"
#include "shared/model/exchange.h"
#include "shared/model/membrane_energy.h"

namespace endoflow::boundary_integral {

/// d(m)/dt by exchange, axial_count, nm²/µs per 2π. `bending` gives de/dc.
[[nodiscard]] Eigen::VectorXd exchange_rate(const MembraneSpace& space, const MembraneSamples& samples,
                                            const ExchangeLaw& law, const MembraneEnergy& bending);

struct ExchangeDerivatives {
    Eigen::MatrixXd from_c;      // d rate/dc at fixed curve, axial_count x axial_count
    Eigen::MatrixXd from_curve;  // d rate/d(curve) at fixed c, axial_count x curve_count
};
[[nodiscard]] ExchangeDerivatives exchange_derivatives(const MembraneSpace& space, const MembraneSamples& samples,
                                                       const ExchangeLaw& law, const MembraneEnergy& bending);

}  // namespace endoflow::boundary_integral
