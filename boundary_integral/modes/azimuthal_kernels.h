#pragma once

// Stokeslet and stresslet between two rings for all azimuthal modes at once. With x = source - target
//     G_ij = delta_ij / rho + x_i x_j / rho^3,        T_ij = -6 x_i x_j (x.n) / rho^5,
// i the component at the target, j that of the density in the frame of the source. Densities and velocities of mode m
// are (v_r cos m phi, v_phi sin m phi, v_z cos m phi); the kernels map amplitudes to amplitudes.

#include <array>
#include <vector>

#include "boundary_integral/modes/azimuthal_integrals.h"

namespace endoflow::boundary_integral {

/// A source ring as one target ring sees it; see RingSources.
struct RingPair {
    double target_radius;     // r0 >= 0 [nm]
    double radius;            // r [nm]
    double delta_r, delta_z;  // source - target [nm]
    double normal_r;          // of the source
    double normal_offset;     // n_r (r - r0) + n_z (z - z0) [nm]
};

inline constexpr std::size_t radial_component = 0, azimuthal_component = 1, axial_component = 2;

/// [target component][source component]; the surface measure r ds is not included.
struct ModeKernels {
    std::array<std::array<double, 3>, 3> single;   // 1/nm
    std::array<std::array<double, 3>, 3> doubled;  // 1/nm^2
};

class AzimuthalKernels {
  public:
    /// For modes 0 ... highest_mode.
    explicit AzimuthalKernels(int highest_mode);

    /// One entry per mode, valid until the next call.
    const std::vector<ModeKernels>& operator()(const RingPair& pair);

  private:
    AzimuthalIntegrals integrals_;
    std::vector<ModeKernels> kernels_;
};

}  // namespace endoflow::boundary_integral
