#pragma once

// How much the material of the membrane has been stretched. (38) without diffusion says D ln s/Dt = - ∇_Γ·u with
// s = initial area / area; membrane that flows in through the rim has s = 1 (31). Markers move with the material and
// integrate it, so that the mesh's own motion and interpolation leave no trace in s.

#include <vector>

#include "boundary_integral/evolution/membrane_dynamics.h"

namespace endoflow::boundary_integral {

/// What markers need of a state, at equal steps of ξ from the axis to the rim.
struct MaterialRates {
    std::vector<double> drift;   // d ξ/dt of the material, 1/µs
    std::vector<double> growth;  // ∇_Γ·u, 1/µs
};

class MaterialStrain {
  public:
    /// Unstretched membrane, `markers_per_element` markers on each of the space's elements.
    explicit MaterialStrain(const MembraneSpace& space);

    [[nodiscard]] MaterialRates rates(const Evaluation& evaluation) const;

    /// A time step between two states; the rates vary linearly within it.
    void advance(const MaterialRates& before, const MaterialRates& after, double step);

    /// max |1/s - 1| = max |area / initial area - 1|.
    [[nodiscard]] double largest() const;

    /// Marker positions, increasing, and -ln s.
    struct Markers {
        std::vector<double> xi, log_growth;
    };
    [[nodiscard]] const Markers& markers() const { return markers_; }
    void restore(Markers markers) { markers_ = std::move(markers); }

  private:
    Index radial_count_;
    double element_width_;
    std::vector<BasisRow> radial_rows_, axial_rows_;
    Markers markers_;

    [[nodiscard]] double spacing() const;
    void renew();
};

}  // namespace endoflow::boundary_integral
