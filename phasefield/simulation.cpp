#include "phasefield/simulation.h"

#include <utility>

#include "phasefield/driver/time_loop.h"
#include "phasefield/fem/mesh.h"
#include "phasefield/make_scheme.h"
#include "shared/support/error.h"

namespace endoflow::phasefield {

ExitReason simulate(const Parameters& parameters, RunOutput& output, MPI_Comm communicator) {
    if (parameters.domain.kind != DomainKind::box)
        throw InputError("domain.kind: the phase-field engine knows the box only; use the boundary-integral engine");
    const Parameters chosen = with_chosen_cells(parameters);
    output.note("cell_size_nm", layer_cell_size(chosen));
    auto scheme = make_scheme(chosen, communicator);
    auto constants = nlohmann::ordered_json::object();
    for (const auto& [name, value] : scheme->constants()) constants[name] = value;
    output.note("constants", constants);
    return TimeLoop(chosen, output, communicator, std::move(scheme)).run();
}

}  // namespace endoflow::phasefield
