#include "phasefield/simulation.h"

#include "phasefield/evolution/time_loop.h"

namespace endoflow::phasefield {

ExitReason simulate(const Parameters& parameters, RunOutput& output, MPI_Comm communicator) {
    TimeLoop loop(parameters, output, communicator);
    return loop.run();
}

}  // namespace endoflow::phasefield
