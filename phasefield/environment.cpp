#include <deal.II/base/config.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/revision.h>
#include <dlfcn.h>
#include <dmumps_c.h>
#include <petscversion.h>

#include <array>
#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>

#include "phasefield/driver/history.h"
#include "phasefield/last_word_of_mpi.h"
#include "phasefield/simulation.h"
#include "shared/support/fast_blas.h"

#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/lsan_interface.h>

/// PMIx, through which OpenMPI's processes find each other, loses 32 bytes (pmix_hash_fetch).
extern "C" const char* __lsan_default_suppressions() {  // NOLINT(*reserved-identifier*): the sanitizer's name
    return "leak:libpmix";
}
#endif

namespace endoflow::phasefield {

namespace {

// OpenMPI and its plug-ins do not give back what they allocate when they start, and are unloaded when they end. So the
// leak sanitizer counts what is lost in between.
#ifdef __SANITIZE_ADDRESS__
using LeaksOfOthers = __lsan::ScopedDisabler;

void check_leaks() {
    __lsan_do_leak_check();
}
#else
struct LeaksOfOthers {};

void check_leaks() {}
#endif

}  // namespace

struct Environment::Implementation {
    using Session = dealii::Utilities::MPI::MPI_InitFinalize;
    /// PETSc would take the rest of the command line for options of its own, and say which of them nobody asked for.
    explicit Implementation(char* program) : words{program, nullptr} {
        [[maybe_unused]] const LeaksOfOthers others;
        int count = 1;
        char** first = words.data();
        mpi = std::make_unique<Session>(count, first, 1);
    }
    Implementation(const Implementation&) = delete;
    Implementation& operator=(const Implementation&) = delete;
    ~Implementation() { check_leaks(); }
    std::array<char*, 2> words;
    std::unique_ptr<Session> mpi;
};

namespace {

/// OpenBLAS starts a thread per core unless told otherwise; with other BLAS libraries the symbol does not exist.
void hold_blas_to_one_thread() {
    using SetThreads = void (*)(int);
    if (void* symbol = dlsym(RTLD_DEFAULT, "openblas_set_num_threads"); symbol != nullptr)
        reinterpret_cast<SetThreads>(symbol)(1);
}

/// Whether mpirun started all processes on this machine: it tells by the environment.
bool on_one_machine() {
    const char *here = std::getenv("OMPI_COMM_WORLD_LOCAL_SIZE"), *all = std::getenv("OMPI_COMM_WORLD_SIZE");
    return here != nullptr && all != nullptr && std::string_view(here) == all;
}

}  // namespace

Environment::Environment(char** argv) {
    require_fast_blas(argv);
    setenv("OMP_NUM_THREADS", "1", 1);
    // Open MPI 4.1 writes the name of a file it opens beside the directory's into 256 bytes, and aborts where they do
    // not suffice. Shared file pointers, which that component is for, nobody uses here.
    setenv("OMPI_MCA_sharedfp", "^lockedfile", 0);
    // Processes of one machine share memory; without a network Open MPI 5's TCP says that it reaches nobody.
    if (on_one_machine()) setenv("OMPI_MCA_btl", "^tcp", 0);
    implementation_ = std::make_unique<Implementation>(argv[0]);
    let_mpi_leave_the_last_word();
    hold_blas_to_one_thread();
}

Environment::~Environment() = default;

EngineIdentity identity(int processes) {
    const std::string petsc = std::to_string(PETSC_VERSION_MAJOR) + "." + std::to_string(PETSC_VERSION_MINOR) + "." +
                              std::to_string(PETSC_VERSION_SUBMINOR);
    return {"phase-field",
            {{"deal.II", DEAL_II_PACKAGE_VERSION}, {"PETSc", petsc}, {"MUMPS", MUMPS_VERSION}},
            texts_of(own_history_columns()),
            processes,
            1,
            RowOrder::in_time};
}

}  // namespace endoflow::phasefield
