#include "phasefield/simulation.h"

#include "phasefield/evolution/time_loop.h"
#include "shared/support/error.h"

namespace endoflow::phasefield {

ExitReason simulate(const Parameters& parameters, RunOutput& output, MPI_Comm communicator) {
    if (parameters.domain.kind != DomainKind::box)
        throw InputError("domain.kind: the phase-field engine knows the box only; use the boundary-integral engine");
    TimeLoop loop(parameters, output, communicator);
    return loop.run();
}

}  // namespace endoflow::phasefield
