#pragma once

#include <mpi.h>

#include <memory>

#include "shared/output/run_output.h"
#include "shared/parameters/parameters.h"

/// The diffuse-interface engine: the paper's model (32)-(41) by finite elements on an adaptive mesh, with MPI.
namespace endoflow::phasefield {

/// MPI, PETSc and p4est for the lifetime of a process. BLAS and deal.II are held to one thread per process: cores are
/// shared out by mpirun.
class Environment {
  public:
    explicit Environment(char** argv);
    ~Environment();
    Environment(const Environment&) = delete;
    Environment& operator=(const Environment&) = delete;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

[[nodiscard]] EngineIdentity identity(int processes);

/// Runs a case to its end, collectively. Throws SolverError.
ExitReason simulate(const Parameters& parameters, RunOutput& output, MPI_Comm communicator);

}  // namespace endoflow::phasefield
