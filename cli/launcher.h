#pragma once

#include <string>

namespace endoflow::cli {

/// How many processes mpirun or srun started of this program, as their environment tells; 1 without them.
[[nodiscard]] int launched_processes();

/// Throws InputError when several processes were started of a program that is one process: they would race for the
/// run's directory. `threads` tells what shares its work instead.
void require_one_process(const std::string& program, const std::string& threads);

}  // namespace endoflow::cli
