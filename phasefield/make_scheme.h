#pragma once

#include <memory>

#include "phasefield/schemes/interface/scheme.h"
#include "shared/parameters/parameters.h"

namespace endoflow::phasefield {

/// The parameters with the scheme's own cell size where the case leaves the choice to it (0).
Parameters with_chosen_cells(const Parameters& parameters);

/// The scheme that phase_field.scheme names, with these parameters.
std::unique_ptr<Scheme> make_scheme(const Parameters& parameters, MPI_Comm communicator);

}  // namespace endoflow::phasefield
