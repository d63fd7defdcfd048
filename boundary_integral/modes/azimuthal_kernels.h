#pragma once

// Stokeslet and stresslet between two rings for all azimuthal modes at once. With x = source - target
//     G_ij = delta_ij / rho + x_i x_j / rho^3,        T_ij = -6 x_i x_j (x.n) / rho^5,
// i the component at the target, j that of the density in the frame of the source. Densities and velocities of mode m
// are (v_r cos m phi, v_phi sin m phi, v_z cos m phi); the kernels map amplitudes to amplitudes.

#include <span>
#include <vector>

#include "boundary_integral/kernels/ring_kernels.h"
#include "boundary_integral/modes/azimuthal_integrals.h"

namespace endoflow::boundary_integral {

inline constexpr std::size_t radial_component = 0, azimuthal_component = 1, axial_component = 2;

using ModeKernels = LayerKernels<3>;

class AzimuthalKernels {
  public:
    /// For modes 0 ... highest_mode.
    explicit AzimuthalKernels(int highest_mode);

    /// One entry per mode, valid until the next call.
    std::span<const ModeKernels> operator()(double target_radius, const RingSources& sources);

  private:
    AzimuthalIntegrals integrals_;
    std::vector<ModeKernels> kernels_;
};

}  // namespace endoflow::boundary_integral
