#pragma once

#include <optional>
#include <string>

#include "shared/output/run_output.h"

namespace endoflow::statics {

/// What to compute besides the case's own stationary state.
struct Request {
    struct Continuation {
        std::string key;  // "section.key" of a parameter that the stationary shape depends on
        double end;
    };
    std::optional<Continuation> continuation;
    bool disc_mass = false;  // see with_disc_mass()
};

/// "molecules.patch_radius=30" as a continuation. Throws InputError: unknown key, one without influence, bad value.
[[nodiscard]] Request::Continuation parse_continuation(const std::string& text, const Parameters& parameters);

/// Throws InputError when the case has a membrane whose statics are not these: an extensible one; or a patch
/// that is too small for the request.
void require_stationary_model(const Parameters& parameters, const Request& request);

[[nodiscard]] EngineIdentity identity();

/// Writes the case's stationary shape or, with a continuation, the branch through it: one row of history.csv and one
/// shape for each point, whose `time` is its number. Throws SolverError "no-stationary-state".
[[nodiscard]] ExitReason simulate(const Parameters& parameters, const Request& request, RunOutput& output);

}  // namespace endoflow::statics
