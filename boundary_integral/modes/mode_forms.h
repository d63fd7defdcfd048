#pragma once

// Integrals over the membrane that the perturbed equations of mode m are made of. Rows and columns are physical
// coefficients of velocities v (ModeSpace) or coefficients of the full scalar space (vertical()); displacements are
// w n, the factor pi of the azimuth is left out.

#include <vector>

#include "boundary_integral/modes/base_state.h"
#include "boundary_integral/modes/mode_space.h"
#include "shared/model/exchange.h"
#include "shared/model/transport_law.h"

namespace endoflow::boundary_integral {

/// The base state at the Gauss points, the same for all modes.
struct BasePoints {
    std::vector<BasePoint> points;
    std::vector<SurfaceJet> energy;  // energy density + tension * area density
    std::vector<SurfaceJet> area;
    std::vector<Row<surface_variables>> curvature;  // derivatives of kappa
    double pressure = 0.0;
};
[[nodiscard]] BasePoints base_points(const MembraneSpace& space, const BaseState& base, const MembraneEnergy& energy,
                                     const Viscosities& viscosities);

/// Amplitudes of the displacement psi n, psi being the k-th function of a row of the scalar space.
[[nodiscard]] SurfaceAmplitudes normal_displacement(int mode, const BasePoint& p, const BasisRow& row, std::size_t k);

struct ModeForms {
    // Second variation of energy, tension and pressure, velocities x displacements, and by the concentration.
    Eigen::MatrixXd stiffness, by_concentration;
    // int w [sigma P] : grad_Gamma v dA: the stress jump of the base flow, carried to the undisplaced membrane.
    Eigen::MatrixXd carried_stress;
    // int mu div_Gamma v dA and its variation by w at the base velocity; rows: tension functions.
    Eigen::MatrixXd divergence, divergence_variation;
    Eigen::MatrixXd force_mass;  // int v . f dA
    Eigen::MatrixXd normal;      // int psi n.v dA
    Eigen::MatrixXd along;       // int psi (t.v) c_s dA
    Eigen::MatrixXd turning;     // int psi w (n.d_s u) c_s dA
};
[[nodiscard]] ModeForms mode_forms(const ModeSpace& space, const BasePoints& base);

/// int psi w dA, scalar x scalar.
[[nodiscard]] Eigen::MatrixXd scalar_mass(const ModeSpace& space, const BasePoints& base);

/// int psi speed d_s w dA, scalar x scalar; `speed` at the Gauss points [nm/us].
[[nodiscard]] Eigen::MatrixXd carrying_form(const ModeSpace& space, const BasePoints& base,
                                            const std::vector<double>& speed);

/// Weak rate of c' (at material points): by c' itself and by the displacement, which changes the surface's metric and
/// curvature.
struct MoleculeForms {
    Eigen::MatrixXd by_concentration, by_displacement;
};
/// By diffusion, see TransportLaw.
[[nodiscard]] MoleculeForms diffusion_forms(const ModeSpace& space, const BaseState& base, const BasePoints& points,
                                            const TransportLaw& law);
/// By exchange, at the base state's mass of molecules, which modes m > 0 do not change. `bending` gives de/dc.
[[nodiscard]] MoleculeForms exchange_forms(const ModeSpace& space, const BasePoints& points, const ExchangeLaw& law,
                                           const MembraneEnergy& bending);

}  // namespace endoflow::boundary_integral
