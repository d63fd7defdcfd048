#include "phasefield/schemes/paper/paper_step.h"

#include "phasefield/fem/interruption.h"
#include "phasefield/schemes/paper/surface_transport.h"

namespace endoflow::phasefield::paper {

State advance(Discretization& d, const State& old_state, double tau) {
    State state = old_state;
    for (Vector* copy : {&state.flow, &state.molecules, &state.stretching})
        copy->update_ghost_values();  // a copy of a deal.II vector does not have them
    assemble_coupled(d.spaces, old_state, old_state.flow, d.parameters, tau, d.coupled);
    give_up_if_interrupted(d.communicator);
    Vector increment = d.spaces.flow.vector();
    d.coupled.solve(d.spaces.flow.constraints, increment);
    state.flow += increment;
    state.flow.update_ghost_values();
    give_up_if_interrupted(d.communicator);
    if (d.parameters.fluid.dynamics == Dynamics::flow && d.parameters.membrane.inextensible)
        advance_stretching(d.spaces, old_state.flow, state.flow, d.parameters, tau, d.stretching, state.stretching);
    advance_molecules(d.spaces, old_state.flow, state.flow, d.parameters, tau, d.molecules, state.molecules);
    return state;
}

}  // namespace endoflow::phasefield::paper
