#pragma once

// Spline spaces of perturbations ~ e^{i m phi}. Smooth fields behave at the axis like
//     scalars, v_z ~ r^m,     v_r - v_phi ~ r^|m-1|,     v_r + v_phi ~ r^(m+1)
// for amplitudes (v_r cos m phi, v_phi sin m phi, v_z cos m phi); the powers' parity is that of m, so half of the
// conditions are the splines' mirror symmetry.

#include <vector>

#include "boundary_integral/membrane/membrane_space.h"

namespace endoflow::boundary_integral {

/// Splines of one parity whose derivatives below `order` vanish on the axis (both poles of a closed surface).
class AxisSplines {
  public:
    AxisSplines(SplineSpace splines, int order, CurveEnd end);

    [[nodiscard]] const SplineSpace& splines() const { return splines_; }
    [[nodiscard]] Index dimension() const { return expansion_.cols(); }
    /// Coefficients in splines() from those of this space.
    [[nodiscard]] const Eigen::MatrixXd& expansion() const { return expansion_; }
    /// One Greville point per function of this space.
    [[nodiscard]] const std::vector<double>& points() const { return points_; }

  private:
    SplineSpace splines_;
    Eigen::MatrixXd expansion_;
    std::vector<double> points_;
};

/// The membrane's spaces in both parities.
struct ParitySpaces {
    explicit ParitySpaces(const MembraneSpace& space);

    CurveEnd end;
    std::array<SplineSpace, 2> quintic, force, tension;  // [0] even, [1] odd
};

/// Amplitudes of one velocity or force component that are smooth on their own.
struct VelocityComponent {
    AxisSplines splines;
    double radial, azimuthal, axial;  // what one unit of it is
};

/// Unknowns of mode m. Physical coefficient vectors (v_r, v_phi | lateral, v_z | vertical) are what the layer
/// potentials map; free ones are those of the components.
class ModeSpace {
  public:
    ModeSpace(const MembraneSpace& membrane, const ParitySpaces& spaces, int mode);

    [[nodiscard]] int mode() const { return mode_; }
    [[nodiscard]] const MembraneSpace& membrane() const { return membrane_; }
    [[nodiscard]] const SplineSpace& lateral() const { return spaces_.quintic[1 - parity_]; }
    [[nodiscard]] const SplineSpace& vertical() const { return spaces_.quintic[parity_]; }
    [[nodiscard]] const SplineSpace& vertical_force() const { return spaces_.force[parity_]; }
    [[nodiscard]] Index velocity_count() const { return 2 * lateral().dimension() + vertical().dimension(); }
    [[nodiscard]] Index force_count() const { return 2 * lateral().dimension() + vertical_force().dimension(); }
    [[nodiscard]] bool clamped() const { return spaces_.end == CurveEnd::clamped; }

    /// Normal displacement, concentration: vertical() with its conditions at the axis. Of the displacement the last
    /// two functions rest at a clamped rim.
    [[nodiscard]] const AxisSplines& scalar() const { return scalar_; }
    [[nodiscard]] Index displacement_count() const { return scalar_.dimension() - (clamped() ? 2 : 0); }
    [[nodiscard]] Eigen::MatrixXd displacement_expansion() const {
        return scalar_.expansion().leftCols(displacement_count());
    }
    [[nodiscard]] const AxisSplines& tension() const { return tension_; }

    /// Components of the velocity, the axial one last, and their collocation points.
    [[nodiscard]] const std::vector<VelocityComponent>& components() const { return components_; }
    [[nodiscard]] const std::vector<std::vector<double>>& targets() const { return targets_; }

    /// Physical velocities from the free ones: at a clamped rim without the last two axial functions, which say height
    /// and slope there.
    [[nodiscard]] const Eigen::MatrixXd& velocities() const { return velocities_; }
    [[nodiscard]] const Eigen::MatrixXd& forces() const { return forces_; }

    /// Physical indices at a clamped rim.
    [[nodiscard]] Index radial_at_rim() const { return lateral().dimension() - 1; }
    [[nodiscard]] Index slope_at_rim() const { return velocity_count() - 2; }

  private:
    const MembraneSpace& membrane_;
    const ParitySpaces& spaces_;
    int mode_;
    std::size_t parity_;
    AxisSplines scalar_, tension_;
    std::vector<VelocityComponent> components_;
    std::vector<std::vector<double>> targets_;
    Eigen::MatrixXd velocities_, forces_;
};

}  // namespace endoflow::boundary_integral
