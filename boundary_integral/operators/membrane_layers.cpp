#include "boundary_integral/operators/membrane_layers.h"

#include "boundary_integral/operators/layer_matrices.h"

namespace endoflow::boundary_integral {

MembraneLayers membrane_layers(const MembraneSpace& space, const MembraneState& state, const MembraneSamples& samples,
                               const std::vector<LayerTarget>& targets, Index rows, const LayerQuadrature& quadrature) {
    MembraneLayers layers{RowMatrix::Zero(rows, space.force_count()), RowMatrix::Zero(rows, space.curve_count())};
    const MembraneSurface surface(space, state, samples, membrane_functions(space), quadrature);
    const Index axial = space.radial_count();
    const std::vector<LayerColumns> columns = {{Layer::single, 0, radial_table, &layers.single},
                                               {Layer::doubled, 0, radial_table, &layers.doubled},
                                               {Layer::single, 1, force_table, &layers.single, axial},
                                               {Layer::doubled, 1, axial_table, &layers.doubled, axial}};
    add_layers(surface, targets, {columns}, quadrature.threads, [] { return AxisymmetricKernels(); });
    return layers;
}

}  // namespace endoflow::boundary_integral
