#include "phasefield/last_word_of_mpi.h"

#include <mpi.h>

#include <array>
#include <cstdio>
#include <cstdlib>

#include "shared/output/sudden_end.h"
#include "shared/support/error.h"

namespace endoflow::phasefield {

namespace {

/// The run's last word, if one is open. A process alone ends with it: MPI would print a page of its own after it.
void end_after(const char* what_happened) {
    int processes = 1;
    PMPI_Comm_size(MPI_COMM_WORLD, &processes);
    if (leave_last_word(what_happened) && processes == 1) std::_Exit(static_cast<int>(ExitCode::solver_stopped));
}

}  // namespace

}  // namespace endoflow::phasefield

// MPI's profiling interface: every function has a second name with a P, and this definition stands before the
// library's. Libraries in Fortran, MUMPS among them, have names of their own.
extern "C" int MPI_Abort(MPI_Comm communicator, int code) {
    endoflow::phasefield::end_after("a library called MPI_Abort");
    return PMPI_Abort(communicator, code);
}

extern "C" void mpi_abort_(MPI_Fint* communicator, MPI_Fint* code, MPI_Fint* error) {  // NOLINT(*identifier-naming)
    *error = MPI_Abort(PMPI_Comm_f2c(*communicator), *code);
}

namespace endoflow::phasefield {

namespace {

void at_error(MPI_Comm* communicator, int* error, ...) {  // NOLINT(cert-dcl50-cpp): MPI's type
    std::array<char, MPI_MAX_ERROR_STRING> text{};
    int length = 0;
    PMPI_Error_string(*error, text.data(), &length);
    std::array<char, MPI_MAX_ERROR_STRING + 30> line{};
    std::snprintf(line.data(), line.size(), "MPI failed (%s)", text.data());
    end_after(line.data());
    PMPI_Abort(*communicator, *error);
}

}  // namespace

void let_mpi_leave_the_last_word() {
    MPI_Errhandler handler = MPI_ERRHANDLER_NULL;
    MPI_Comm_create_errhandler(at_error, &handler);
    for (MPI_Comm communicator : {MPI_COMM_WORLD, MPI_COMM_SELF}) MPI_Comm_set_errhandler(communicator, handler);
    MPI_Errhandler_free(&handler);  // when no communicator has it any more
}

}  // namespace endoflow::phasefield
