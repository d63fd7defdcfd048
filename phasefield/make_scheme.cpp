#include "phasefield/make_scheme.h"

#include "phasefield/schemes/paper/paper_scheme.h"
#include "phasefield/schemes/production/production_scheme.h"

namespace endoflow::phasefield {

Parameters with_chosen_cells(const Parameters& parameters) {
    Parameters chosen = parameters;
    double& size = chosen.phase_field.cell_size;
    if (size != 0) return chosen;
    switch (parameters.phase_field.scheme) {
        case PhaseFieldScheme::paper:
            size = paper::cell_per_epsilon * parameters.phase_field.epsilon;
            break;
        case PhaseFieldScheme::production:
            size = production::cell_per_epsilon * parameters.phase_field.epsilon;
            break;
    }
    return chosen;
}

std::unique_ptr<Scheme> make_scheme(const Parameters& parameters, MPI_Comm communicator) {
    switch (parameters.phase_field.scheme) {
        case PhaseFieldScheme::paper:
            return std::make_unique<paper::PaperScheme>(parameters, communicator);
        case PhaseFieldScheme::production:
            return std::make_unique<production::ProductionScheme>(parameters, communicator);
    }
    throw std::logic_error("phase_field.scheme: no such scheme");
}

}  // namespace endoflow::phasefield
