#include "phasefield/evolution/scheme.h"

#include "phasefield/evolution/paper_scheme.h"
#include "phasefield/production/production_scheme.h"

namespace endoflow::phasefield {

namespace {

/// Cells per layer that resolve the scheme's fields. Scheme `paper` has to resolve fourth derivatives of the tanh
/// profile; the production scheme the distance, which is smooth (it refines the patch's edge by itself).
double chosen_cell_size(const Parameters& p) {
    constexpr double paper_ratio = 1.25 / 1.2, production_ratio = 4.0 / 3;
    if (p.phase_field.scheme == PhaseFieldScheme::paper) return paper_ratio * p.phase_field.epsilon;
    return production_ratio * p.phase_field.epsilon;
}

}  // namespace

Parameters with_chosen_cells(const Parameters& parameters) {
    Parameters chosen = parameters;
    if (chosen.phase_field.cell_size == 0) chosen.phase_field.cell_size = chosen_cell_size(parameters);
    return chosen;
}

std::unique_ptr<Scheme> make_scheme(const Parameters& parameters, MPI_Comm communicator) {
    const Parameters chosen = with_chosen_cells(parameters);
    if (parameters.phase_field.scheme == PhaseFieldScheme::paper)
        return std::make_unique<PaperScheme>(chosen, communicator);
    return std::make_unique<production::ProductionScheme>(chosen, communicator);
}

}  // namespace endoflow::phasefield
