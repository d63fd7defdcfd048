#include "shared/output/phase_timer.h"

#include <utility>

#include "shared/output/provenance.h"

namespace endoflow {

PhaseTimer::PhaseTimer(RunOutput& output, std::string phase)
    : output_(output), phase_(std::move(phase)), wall_start_(wall_seconds()), cpu_start_(cpu_seconds()) {}

// Nothing but a lack of memory can throw here, and that may end the program.
PhaseTimer::~PhaseTimer() {  // NOLINT(bugprone-exception-escape)
    output_.add_phase_time(phase_, wall_seconds() - wall_start_, cpu_seconds() - cpu_start_);
}

}  // namespace endoflow
