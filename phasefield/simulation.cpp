#include "phasefield/simulation.h"

#include <utility>

#include "phasefield/driver/time_loop.h"
#include "phasefield/fem/mesh.h"
#include "phasefield/make_scheme.h"
#include "shared/geometry/initial_curve.h"
#include "shared/support/error.h"

namespace endoflow::phasefield {

ExitReason simulate(const Parameters& parameters, RunOutput& output, MPI_Comm communicator) {
    if (parameters.domain.kind != DomainKind::box && parameters.phase_field.scheme == PhaseFieldScheme::paper)
        throw InputError("domain.kind: scheme paper knows the box only; use phase_field.scheme = \"production\"");
    require_deformable(parameters);
    const Parameters chosen = with_chosen_cells(parameters);
    output.note("cell_size_nm", layer_cell_size(chosen));
    auto scheme = make_scheme(chosen, communicator);
    auto constants = nlohmann::ordered_json::object();
    for (const auto& [name, value] : scheme->constants()) constants[name] = value;
    output.note("constants", constants);
    return TimeLoop(chosen, output, communicator, std::move(scheme)).run();
}

}  // namespace endoflow::phasefield
