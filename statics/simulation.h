#pragma once

#include <optional>
#include <string>

#include "shared/output/run_output.h"
#include "statics/vesicle_state.h"

namespace endoflow::statics {

/// What to compute besides the case's own stationary state.
struct Request {
    struct Continuation {
        std::string key;  // "section.key" of a parameter that the stationary shape depends on
        double end;
    };
    std::optional<Continuation> continuation;
    struct Hold {
        std::optional<double> begin;  // radius of the neck, nm; empty for the widest there is
        double end;
    };
    std::optional<Hold> hold;
    bool disc_mass = false;               // see with_disc_mass()
    std::optional<VesicleFamily> family;  // of a vesicle, instead of that of the case's spheroid
    Resolution resolution;                // of the collocation
};

inline constexpr std::size_t fewest_elements = 8, most_elements = 10000;

/// "molecules.patch_radius=30" as a continuation. Throws InputError: unknown key, one without influence, bad value.
[[nodiscard]] Request::Continuation parse_continuation(const std::string& text, const Parameters& parameters);

/// "neck_radius=R1:R2" as a hold; "open" for R1 is the widest neck. Throws InputError: anything else, or a radius below
/// closed_neck_radius or beyond the box.
[[nodiscard]] Request::Hold parse_hold(const std::string& text, const Parameters& parameters);

/// "prolate", "oblate" or "stomatocyte". Throws InputError for anything else.
[[nodiscard]] VesicleFamily parse_family(const std::string& text);

/// Throws InputError when the case has a membrane whose statics are not these: an extensible one, a vesicle with a
/// patch; a patch that is too small for the request; when the request does not go with the case's domain.kind; or for
/// fewer elements than fewest_elements or more than most_elements.
void require_stationary_model(const Parameters& parameters, const Request& request);

/// The columns of history.csv depend on the case's domain.kind.
[[nodiscard]] EngineIdentity identity(const Parameters& parameters);

/// Writes the case's stationary shape or, with a continuation or a hold, a branch: one row of history.csv and one
/// shape for each point, whose `time` is its number. Throws SolverError "no-stationary-state", or what held_failure()
/// says of a hold.
[[nodiscard]] ExitReason simulate(const Parameters& parameters, const Request& request, RunOutput& output);

}  // namespace endoflow::statics
