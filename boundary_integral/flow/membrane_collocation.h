#pragma once

// The membrane's own part of the velocity equation, collocated at the Greville points:
//     4 π (ν₁ + ν₂) u + (ν₁ - ν₂) D u = S f

#include <vector>

#include "boundary_integral/flow/flow_model.h"
#include "boundary_integral/operators/membrane_layers.h"
#include "shared/parameters/parameters.h"

namespace endoflow::boundary_integral {

class MembraneCollocation {
  public:
    MembraneCollocation(const MembraneSpace& space, const FluidParameters& fluid);

    [[nodiscard]] Index rows() const;
    [[nodiscard]] double contrast() const { return viscosity_below_ - viscosity_above_; }

    [[nodiscard]] std::vector<LayerTarget> targets(const MembraneState& state) const;

    struct Equation {
        Eigen::MatrixXd velocity;  // rows x curve_count
        Eigen::MatrixXd force;     // rows x force_count
    };
    [[nodiscard]] Equation equation(const MembraneState& state, const MembraneSamples& samples,
                                    const std::vector<LayerTarget>& targets, const LayerQuadrature& quadrature) const;

    /// velocity u = force f, restricted to the freedoms and with f from a load: fills force_from_load and mobility.
    void solve(const Equation& equation, MobilityOperators& operators) const;

  private:
    struct Point {
        double xi;
        TargetRows rows;
        std::vector<ElementPoints> own;
    };
    const MembraneSpace& space_;
    double viscosity_below_, viscosity_above_;
    std::vector<Point> points_;
    Eigen::MatrixXd evaluation_;  // u itself at the targets, rows x curve_count

    void merge_targets();
};

}  // namespace endoflow::boundary_integral
