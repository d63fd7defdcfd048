#pragma once

// Second variation of the membrane's energy for displacements and velocities of azimuthal mode m. The energy per d xi
// d phi of a general surface x(xi, phi) with concentration c,
//     e(kappa, c, |grad c|^2) A,   A = |x_xi x x_phi|,
//     kappa = -(G L - 2 F M + E N)/A^3,     |grad c|^2 = (G c_xi^2 - 2 F c_xi c_phi + E c_phi^2)/A^2,
//     L, M, N = x_xixi, x_xiphi, x_phiphi . (x_xi x x_phi),
// is differentiated automatically by the vectors x_xi, x_phi, x_xixi, x_xiphi, x_phiphi in the frame (e_r, e_phi, e_z)
// and by c and its derivatives. On an axisymmetric surface these derivatives do not depend on phi, so mode m sees them
// through amplitudes.

#include <array>

#include "boundary_integral/membrane/membrane_space.h"
#include "shared/model/membrane_energy.h"
#include "shared/numerics/forward.h"

namespace endoflow::boundary_integral {

/// Components (r, phi, z) of x_xi, x_phi, x_xixi, x_xiphi, x_phiphi, then c, c_xi, c_phi.
inline constexpr std::size_t surface_variables = 18, surface_concentration = 15;
using SurfaceJet = Jet<surface_variables>;
using SurfaceAmplitudes = std::array<double, surface_variables>;

/// Amplitude of one vector component with its derivatives in xi.
struct Derivatives2 {
    double value, first, second;
};

/// Amplitudes of (v_r cos m phi, v_phi sin m phi, v_z cos m phi) among the surface's variables: those of x_phi and
/// x_xiphi with the parity of their component.
[[nodiscard]] SurfaceAmplitudes surface_amplitudes(int mode, const Derivatives2& v_r, const Derivatives2& v_phi,
                                                   const Derivatives2& v_z);

/// Those of a concentration ~ cos m phi.
[[nodiscard]] SurfaceAmplitudes concentration_amplitudes(int mode, const Derivatives2& c);

struct SurfaceDensities {
    SurfaceJet energy;                 // per d xi d phi, pN nm
    SurfaceJet area;                   // nm^2
    SurfaceJet per_area;               // energy/area, pN/nm
    Row<surface_variables> curvature;  // derivatives of kappa
};

/// At a point r > 0 of an axisymmetric membrane; `c_xi` is the derivative of c in xi.
[[nodiscard]] SurfaceDensities surface_densities(const CurvePoint& p, double c, double c_xi,
                                                 const MembraneEnergy& energy);

/// a . hessian . b
[[nodiscard]] SurfaceAmplitudes hessian_times(const SurfaceJet& jet, const SurfaceAmplitudes& b);
template <class Derivatives>
[[nodiscard]] double dot(const Derivatives& a, const SurfaceAmplitudes& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < surface_variables; ++i) sum += a[i] * b[i];
    return sum;
}

}  // namespace endoflow::boundary_integral
