#include "launcher.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "shared/support/error.h"

namespace endoflow::cli {

int launched_processes() {
    int processes = 1;
    // OpenMPI; MPICH, Intel MPI and whatever else starts with PMI; MVAPICH2; a job step of Slurm.
    for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "MV2_COMM_WORLD_SIZE", "SLURM_STEP_NUM_TASKS"})
        if (const char* text = std::getenv(name)) processes = std::max(processes, std::atoi(text));
    return processes;
}

void require_one_process(const std::string& program, const std::string& threads) {
    if (const int processes = launched_processes(); processes > 1)
        throw InputError(fmt::format("command line: {} is one process, but {} were started; start it without mpirun{}",
                                     program, processes, threads));
}

}  // namespace endoflow::cli
