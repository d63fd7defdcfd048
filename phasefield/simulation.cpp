#include "phasefield/simulation.h"

#include "phasefield/driver/time_loop.h"
#include "phasefield/fem/mesh.h"
#include "phasefield/make_scheme.h"
#include "shared/support/error.h"

namespace endoflow::phasefield {

ExitReason simulate(const Parameters& parameters, RunOutput& output, MPI_Comm communicator) {
    if (parameters.domain.kind != DomainKind::box)
        throw InputError("domain.kind: the phase-field engine knows the box only; use the boundary-integral engine");
    const Parameters chosen = with_chosen_cells(parameters);
    output.note("cell_size_nm", layer_cell_size(chosen));
    return TimeLoop(chosen, output, communicator, make_scheme(chosen, communicator)).run();
}

}  // namespace endoflow::phasefield
