#pragma once

// The membrane linearised about an axisymmetric state, one azimuthal mode at a time:
//     x = X(xi) + w(xi) cos(m phi) n,    c = C(xi) + c'(xi) cos(m phi),    d(w, c')/dt = L (w, c').

#include <vector>

#include "boundary_integral/modes/mode_forms.h"
#include "boundary_integral/modes/surroundings.h"

namespace endoflow::boundary_integral {

/// y = (free coefficients of w, of c'); see ModeSpace.
struct ModeRates {
    Index displacements = 0;
    Eigen::MatrixXd material;  // d y/dt at fixed coordinates of the material
    // The velocity of the displaced material (physical coefficients) that goes with y.
    Eigen::MatrixXd velocity;
    Eigen::MatrixXd mobility;  // free velocities from their loads, without inextensibility
    // M: dy/dt at fixed coordinates of the material by loads L_k = int l psi_k dA on y, the membrane inextensible, the
    // fluids incompressible. Symmetric and positive but for the collocation's error.
    Eigen::MatrixXd thermal_mobility;
};

class LinearisedMembrane {
  public:
    /// The base state is one of the engine's under the case's loads, which have no pole force: the force's place among
    /// the molecules would be an unknown more. `base` needs no traction_sum: it is computed here, with the operators of
    /// all modes.
    LinearisedMembrane(const Parameters& parameters, const Surroundings& surroundings, BaseState base);

    [[nodiscard]] ModeRates rates(int mode) const;

    /// What is added to ModeRates::material in coordinates that slide over the material with `speed` along the
    /// meridian (nm/us, at the Gauss points): speed d_s of w and c'.
    [[nodiscard]] Eigen::MatrixXd carrying(int mode, const std::vector<double>& speed) const;

    /// The speed of coordinates that move along the normal: shapes are then compared along normals, whatever the
    /// material does, and nothing depends on a mesh.
    [[nodiscard]] std::vector<double> speed_of_normal_coordinates() const;

    [[nodiscard]] const BaseState& base() const { return base_; }
    [[nodiscard]] const BasePoints& points() const { return points_; }

  private:
    struct RimTerms;
    struct Conditions;

    const Surroundings& surroundings_;
    MembraneEnergy energy_;
    MembraneEnergy bending_;
    TransportLaw transport_;
    ExchangeLaw exchange_;
    BaseState base_;
    std::vector<CollocatedLayers> layers_;
    BasePoints points_;

    [[nodiscard]] RimTerms rim_terms(const ModeSpace& space) const;
    [[nodiscard]] Eigen::MatrixXd transpiration(const ModeSpace& space, const Eigen::MatrixXd& doubled) const;
};

/// d y/dt = (rates.material + carrying) y in coordinates that move along the normal: the matrix whose eigenvalues are
/// the frozen-time rates.
[[nodiscard]] Eigen::MatrixXd normal_rates(const LinearisedMembrane& membrane, int mode, const ModeRates& rates);

}  // namespace endoflow::boundary_integral
