#include <deal.II/distributed/solution_transfer.h>

#include "phasefield/schemes/paper/diagnostics.h"
#include "phasefield/schemes/paper/discretization.h"

namespace endoflow::phasefield::paper {

namespace {

using Transfer = dealii::parallel::distributed::SolutionTransfer<2, Vector>;

Vector carry_over(Transfer& transfer, const Space& space) {
    Vector vector = space.vector();
    transfer.interpolate(vector);
    space.hanging_nodes.distribute(vector);
    vector.update_ghost_values();
    return vector;
}

/// One pass: cells change by at most one level.
bool adapt_once(Discretization& d, State& state, const std::vector<PlanePoint>& curve) {
    if (!flag_bands(*d.mesh, {layer_band(curve, d.parameters.phase_field)})) return false;

    Transfer flow(d.spaces.flow.dofs), molecules(d.spaces.molecules.dofs), stretching(d.spaces.stretching.dofs);
    flow.prepare_for_coarsening_and_refinement(state.flow);
    molecules.prepare_for_coarsening_and_refinement(state.molecules);
    stretching.prepare_for_coarsening_and_refinement(state.stretching);
    d.mesh->execute_coarsening_and_refinement();
    d.spaces.distribute(d.parameters);
    take_over(state, {carry_over(flow, d.spaces.flow), carry_over(molecules, d.spaces.molecules),
                      carry_over(stretching, d.spaces.stretching)});
    return true;
}

}  // namespace

bool adapt(Discretization& d, State& state, const std::vector<PlanePoint>& curve) {
    const LayerIntegrals before = integrate_layer(d.spaces, state, d.parameters);
    bool adapted = false;
    for (int pass = 0; pass < d.parameters.phase_field.far_refinements && adapt_once(d, state, curve); ++pass)
        adapted = true;
    if (!adapted) return false;
    d.renew();
    const LayerIntegrals after = integrate_layer(d.spaces, state, d.parameters);
    const auto restore = [](double wanted, double present, Vector& vector) {
        if (present > 0) vector *= wanted / present;
        vector.update_ghost_values();
    };
    restore(before.molecules, after.molecules, state.molecules);
    restore(before.stretching, after.stretching, state.stretching);
    return true;
}

}  // namespace endoflow::phasefield::paper
