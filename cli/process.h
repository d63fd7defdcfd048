#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace endoflow::cli {

/// How many processes mpirun or srun started of this program, as their environment tells; 1 without them.
[[nodiscard]] int launched_processes();

/// Throws InputError when several processes were started of a program that is one process: they would race for the
/// run's directory. `threads` tells what shares its work instead.
void require_one_process(const std::string& program, const std::string& threads);

/// Replaces this process by a program that lies beside it. Does not return; throws IoError when it cannot start.
[[noreturn]] void become_program(const std::string& name, const std::vector<std::string>& arguments);

/// Replaces this process by Python running a package of the project. Does not return; throws IoError.
[[noreturn]] void become_python(const std::filesystem::path& package, const std::vector<std::string>& arguments);

}  // namespace endoflow::cli
