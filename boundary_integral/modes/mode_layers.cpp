#include "boundary_integral/modes/mode_layers.h"

#include "boundary_integral/modes/azimuthal_kernels.h"
#include "boundary_integral/operators/layer_matrices.h"
#include "boundary_integral/operators/membrane_surface.h"

namespace endoflow::boundary_integral {

namespace {

// Kinds of functions on the membrane: even and odd ones, the curve's first.
enum ModeTable : std::size_t { odd_table, even_table, even_force_table, odd_force_table };

std::vector<BasisRow> rows_at_gauss_points(const MembraneSpace& space, const SplineSpace& splines) {
    std::vector<BasisRow> rows;
    for (const double xi : space.xi) rows.push_back(splines.basis(xi));
    return rows;
}

std::vector<LayerColumns> columns_of(int mode, const ParitySpaces& spaces, ModeLayers& layers) {
    const bool odd = mode % 2 == 1;
    const ModeTable lateral = odd ? even_table : odd_table, vertical = odd ? odd_table : even_table;
    const ModeTable force = odd ? odd_force_table : even_force_table;
    const Index count = spaces.quintic[odd ? 0 : 1].dimension();
    return {{Layer::single, radial_component, lateral, &layers.single},
            {Layer::doubled, radial_component, lateral, &layers.doubled},
            {Layer::single, azimuthal_component, lateral, &layers.single, count},
            {Layer::doubled, azimuthal_component, lateral, &layers.doubled, count},
            {Layer::single, axial_component, force, &layers.single, 2 * count},
            {Layer::doubled, axial_component, vertical, &layers.doubled, 2 * count}};
}

}  // namespace

std::vector<ModeLayers> mode_layers(const MembraneSpace& space, const ParitySpaces& spaces, const MembraneState& state,
                                    const std::vector<LayerTarget>& targets, int highest_mode, int threads) {
    const Index rows = 3 * static_cast<Index>(targets.size());
    std::vector<ModeLayers> layers(static_cast<std::size_t>(highest_mode) + 1);
    std::vector<std::vector<LayerColumns>> columns;
    for (int mode = 0; mode <= highest_mode; ++mode) {
        const std::size_t parity = static_cast<std::size_t>(mode % 2);
        const Index lateral = 2 * spaces.quintic[1 - parity].dimension();
        ModeLayers& of_mode = layers[static_cast<std::size_t>(mode)];
        of_mode = {RowMatrix::Zero(rows, lateral + spaces.force[parity].dimension()),
                   RowMatrix::Zero(rows, lateral + spaces.quintic[parity].dimension())};
        columns.push_back(columns_of(mode, spaces, of_mode));
    }
    std::vector<MembraneFunctions> on_membrane = membrane_functions(space);
    const std::vector<BasisRow> odd_force_rows = rows_at_gauss_points(space, spaces.force[1]);
    on_membrane.push_back({spaces.force[1], odd_force_rows});
    const MembraneSamples samples = sample(space, state);
    const MembraneSurface surface(space, state, samples, on_membrane, {});
    add_layers(surface, targets, columns, threads, [&] { return AzimuthalKernels(highest_mode); });
    return layers;
}

}  // namespace endoflow::boundary_integral
