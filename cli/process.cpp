#include "process.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "locations.h"
#include "python.h"
#include "shared/support/error.h"

namespace endoflow::cli {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void become(const fs::path& program, const std::vector<std::string>& arguments) {
    std::string first = program.string();
    std::vector<std::string> copies = arguments;
    std::vector<char*> raw{first.data()};
    for (auto& argument : copies) raw.push_back(argument.data());
    raw.push_back(nullptr);
    ::execvp(first.c_str(), raw.data());
    throw IoError(fmt::format("{}: cannot be started: {}; build or install it", first, std::strerror(errno)));
}

}  // namespace

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

void become_program(const std::string& name, const std::vector<std::string>& arguments) {
    become(program_directory() / name, arguments);
}

void become_python(const fs::path& package, const std::vector<std::string>& arguments) {
    const fs::path data = data_directory();
    const char* before = std::getenv("PYTHONPATH");
    const std::string path = (data / "python").string() + (before != nullptr ? ":" + std::string(before) : "");
    ::setenv("PYTHONPATH", path.c_str(), 1);
    // Scripts that start runs call this very program.
    ::setenv("ENDOFLOW_PROGRAM", fs::read_symlink("/proc/self/exe").c_str(), 1);
    std::vector<std::string> all{(data / package).string()};
    all.insert(all.end(), arguments.begin(), arguments.end());
    become(find_python(data / package / "requirements.txt"), all);
}

}  // namespace endoflow::cli
