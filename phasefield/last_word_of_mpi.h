#pragma once

namespace endoflow::phasefield {

/// From here on MPI leaves the last word of an open run before it ends the process: on an error, which it does not
/// return to the libraries that would not look at it, and when a library calls MPI_Abort. To be called once, when MPI
/// has been initialised.
void let_mpi_leave_the_last_word();

}  // namespace endoflow::phasefield
