#include <deal.II/base/config.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/revision.h>
#include <dlfcn.h>
#include <dmumps_c.h>
#include <petscversion.h>

#include <string>

#include "phasefield/evolution/history.h"
#include "phasefield/simulation.h"

namespace endoflow::phasefield {

struct Environment::Implementation {
    Implementation(int& argc, char**& argv) : mpi(argc, argv, 1) {}
    dealii::Utilities::MPI::MPI_InitFinalize mpi;
};

namespace {

/// OpenBLAS starts a thread per core unless told otherwise; with other BLAS libraries the symbol does not exist.
void hold_blas_to_one_thread() {
    using SetThreads = void (*)(int);
    if (void* symbol = dlsym(RTLD_DEFAULT, "openblas_set_num_threads"); symbol != nullptr)
        reinterpret_cast<SetThreads>(symbol)(1);
}

}  // namespace

Environment::Environment(int& argc, char**& argv) {
    setenv("OMP_NUM_THREADS", "1", 1);
    implementation_ = std::make_unique<Implementation>(argc, argv);
    hold_blas_to_one_thread();
}

Environment::~Environment() = default;

EngineIdentity identity(int processes) {
    const std::string petsc = std::to_string(PETSC_VERSION_MAJOR) + "." + std::to_string(PETSC_VERSION_MINOR) + "." +
                              std::to_string(PETSC_VERSION_SUBMINOR);
    return {"phase-field",
            {{"deal.II", DEAL_II_PACKAGE_VERSION}, {"PETSc", petsc}, {"MUMPS", MUMPS_VERSION}},
            extra_history_columns(),
            processes,
            1,
            RowOrder::in_time,
            {"domain.radius", "domain.height", "domain.membrane_height", "phase_field.scheme", "phase_field.epsilon",
             "phase_field.cell_size", "phase_field.far_refinements", "phase_field.degree",
             "phase_field.velocity_degree", "phase_field.tension_degree", "phase_field.surface_degree"}};
}

}  // namespace endoflow::phasefield
