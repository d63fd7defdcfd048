#pragma once

// What surrounds the membrane, for all azimuthal modes: fluids in the box or without end. The velocity equation of mode
// m, collocated at the targets of its space, with the walls eliminated,
//     4 pi (nu_1 + nu_2) V + (nu_1 - nu_2) D V = S q + right-hand side.

#include <optional>
#include <vector>

#include "boundary_integral/modes/base_state.h"
#include "boundary_integral/modes/mode_layers.h"
#include "boundary_integral/modes/mode_walls.h"
#include "shared/parameters/parameters.h"

namespace endoflow::boundary_integral {

/// Rows: collocation equations of the mode, component by component. Columns: physical coefficients.
struct CollocatedLayers {
    Eigen::MatrixXd doubled;  // D
    Eigen::MatrixXd single;   // S
};

class Surroundings {
  public:
    /// Modes 0 ... highest_mode of a flow with viscosity; InputError for a membrane that moves without a fluid.
    Surroundings(const Parameters& parameters, const MembraneSpace& space, int highest_mode);
    Surroundings(const Surroundings&) = delete;
    Surroundings& operator=(const Surroundings&) = delete;

    [[nodiscard]] const MembraneSpace& membrane() const { return membrane_; }
    [[nodiscard]] const ModeSpace& space(int mode) const { return spaces_[static_cast<std::size_t>(mode)]; }
    [[nodiscard]] const Viscosities& viscosities() const { return viscosities_; }
    [[nodiscard]] int highest_mode() const { return static_cast<int>(spaces_.size()) - 1; }

    /// Values of physical velocities at the collocation equations of a mode.
    [[nodiscard]] Eigen::MatrixXd evaluation(int mode) const;

    struct Layers {
        std::vector<CollocatedLayers> of_mode;
        Eigen::VectorXd traction_sum;  // see BaseState
    };
    [[nodiscard]] Layers layers(const BaseState& base) const;

  private:
    const MembraneSpace& membrane_;
    Viscosities viscosities_;
    int threads_;
    ParitySpaces parities_;
    std::vector<ModeSpace> spaces_;
    std::vector<double> points_;  // all collocation points, increasing
    std::optional<WallPanels> walls_;
    std::vector<LuFactors> wall_factors_;

    [[nodiscard]] Index point_index(double xi) const;
    [[nodiscard]] Eigen::MatrixXd equations(int mode, const RowMatrix& at_points) const;
    [[nodiscard]] std::vector<LayerTarget> targets(const MembraneState& state) const;
    [[nodiscard]] Eigen::VectorXd traction_sum(const BaseState& base, const CollocatedLayers& axisymmetric,
                                               const Eigen::MatrixXd& from_walls) const;
};

}  // namespace endoflow::boundary_integral
