#pragma once

#include <string>

#include "shared/parameters/parameters.h"

namespace endoflow {

/// Checks that involve several parameters or the model (a patch inside the domain, a membrane away from the walls, a
/// tension below which it buckles). Throws InputError that begins with `where`.
void check_case(const Parameters& parameters, const std::string& where);

}  // namespace endoflow
