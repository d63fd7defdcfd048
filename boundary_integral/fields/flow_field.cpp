#include "boundary_integral/fields/flow_field.h"

#include <algorithm>
#include <numbers>

#include "boundary_integral/operators/closest_point.h"

namespace endoflow::boundary_integral {

FlowField::FlowField(const Parameters& parameters, const MembraneSpace& space, const MembraneState& state,
                     const MembraneSamples& samples, const MembraneFlow& flow, const WallPanels& walls,
                     const Eigen::VectorXd& wall_unknowns)
    : parameters_(parameters),
      space_(space),
      state_(state),
      samples_(samples),
      membrane_(space, state, samples, flow,
                parameters.fluid.viscosity_extracellular - parameters.fluid.viscosity_intracellular),
      walls_(walls, wall_unknowns) {}

FieldValue FlowField::at(const Target& target, double margin, RingLayers& layers) const {
    const DomainParameters& domain = parameters_.domain;
    Target place{std::min(target.r, domain.radius - margin), std::clamp(target.z, margin, domain.height - margin)};
    const CurvePoint p = closest_on_membrane(space_, state_, samples_, place).point;
    // Positive on the side n points to.
    const double height = (place.r - p.r) * p.normal_r + (place.z - p.z) * p.normal_z;
    const Phase phase = height > margin ? Phase::intracellular : Phase::extracellular;
    if (height <= margin && height > -margin) {
        place = {std::max(p.r - margin * p.normal_r, 0.0), p.z - margin * p.normal_z};
        place.r = std::min(place.r, domain.radius - margin);
    }
    layers.start(place);
    membrane_.add_to(layers, place);
    walls_.add_to(layers, place);
    const RingLayers::Sum sum = layers.evaluate();
    const double viscosity = phase == Phase::extracellular ? parameters_.fluid.viscosity_extracellular
                                                           : parameters_.fluid.viscosity_intracellular;
    const double scale = 1.0 / (8.0 * std::numbers::pi * viscosity);
    return {place.r > 0.0 ? scale * sum.momentum_r : 0.0, scale * sum.momentum_z, sum.pressure, phase};
}

}  // namespace endoflow::boundary_integral
