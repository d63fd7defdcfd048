#pragma once

#include <deal.II/base/mpi.h>

#include "shared/support/interruption.h"

namespace endoflow::phasefield {

/// Whether a signal has asked any process to stop; all of them then know which one did. Collective.
[[nodiscard]] inline bool interrupted(MPI_Comm communicator) {
    share_interruption(dealii::Utilities::MPI::max(interruption_signal(), communicator));
    return interruption_signal() != 0;
}

/// Throws Interrupted on all processes, or on none. Collective.
inline void give_up_if_interrupted(MPI_Comm communicator) {
    if (interrupted(communicator)) throw Interrupted();
}

}  // namespace endoflow::phasefield
