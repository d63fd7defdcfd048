#pragma once

// Velocity, pressure and phase at any point of the box.

#include "boundary_integral/fields/membrane_sources.h"
#include "boundary_integral/fields/wall_sources.h"
#include "shared/parameters/parameters.h"

namespace endoflow::boundary_integral {

enum class Phase { extracellular, intracellular };

struct FieldValue {
    double u_r, u_z;  // nm/µs
    double pressure;  // pN/nm²
    Phase phase;
};

class FlowField {
  public:
    /// What is passed by reference must outlive the object. `wall_unknowns` as WallPanels numbers them.
    FlowField(const Parameters& parameters, const MembraneSpace& space, const MembraneState& state,
              const MembraneSamples& samples, const MembraneFlow& flow, const WallPanels& walls,
              const Eigen::VectorXd& wall_unknowns);

    /// Points nearer than `margin` [nm] to a wall or the membrane are moved along the normal to that distance from it;
    /// those at the membrane count as extracellular. `layers` is room to work in, one for each thread.
    [[nodiscard]] FieldValue at(const Target& target, double margin, RingLayers& layers) const;
    [[nodiscard]] FieldValue at(const Target& target, double margin) const {
        RingLayers layers;
        return at(target, margin, layers);
    }

  private:
    const Parameters& parameters_;
    const MembraneSpace& space_;
    const MembraneState& state_;
    const MembraneSamples& samples_;
    MembraneSources membrane_;
    WallSources walls_;
};

}  // namespace endoflow::boundary_integral
