#pragma once

#include <functional>

#include "shared/model/membrane_energy.h"

namespace endoflow::statics {

/// What the membrane of a vesicle is made of, the same everywhere, and has to enclose.
class ClosedMembrane {
  public:
    /// nm², nm³.
    ClosedMembrane(MembraneEnergy energy, double concentration, double membrane_area, double enclosed_volume);

    double area, volume;           // nm², nm³
    double spontaneous_curvature;  // C, κ where the moment is 0: the energy's own until it is changed, 1/nm
    double polarity = 0;           // C varies from C + polarity at the north pole to C − polarity at the south, 1/nm

    [[nodiscard]] double concentration() const { return concentration_; }
    /// ∂²e/∂κ² where the moment is 0, pN nm.
    [[nodiscard]] double stiffness() const { return stiffness_; }
    /// Radius of the sphere with this area, nm.
    [[nodiscard]] double sphere_radius() const;
    /// Volume over that of this sphere, 0 < v ≤ 1.
    [[nodiscard]] double reduced_volume() const;

    /// At x = a/a(south pole), where the moment is `moment`.
    template <class Number>
    [[nodiscard]] ElasticState<Number> elastic(double x, const Number& moment) const {
        ElasticState<Number> state = elastic_state(energy_, moment, Number(concentration_), Number(0.0));
        state.curvature = state.curvature + (spontaneous_curvature - natural_curvature_ + polarity * (1 - 2 * x));
        return state;
    }

  private:
    MembraneEnergy energy_;
    double concentration_, natural_curvature_, stiffness_;
};

/// The same membrane with another volume.
[[nodiscard]] ClosedMembrane with_reduced_volume(ClosedMembrane membrane, double reduced_volume);

/// Makes a membrane out of the value of the parameter that varies.
using MembranePath = std::function<ClosedMembrane(double)>;

}  // namespace endoflow::statics
