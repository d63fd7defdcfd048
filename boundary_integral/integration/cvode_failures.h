#pragma once

#include <string>

namespace endoflow::boundary_integral {

/// Throws the SolverError that a negative flag of CVODE stands for. `reason`: what made the last attempt fail, as far
/// as it is known; `time` in µs.
[[noreturn]] void throw_cvode_failure(int flag, double time, const std::string& reason);

/// For calls that can fail only by a lack of memory or by a mistake of ours: SolverError("integrator-set-up").
void require_success(int flag, const char* call);

}  // namespace endoflow::boundary_integral
