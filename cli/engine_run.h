#pragma once

#include <fmt/format.h>

#include <exception>

#include "command_line.h"
#include "shared/output/run_files.h"
#include "shared/support/console.h"
#include "shared/support/error.h"
#include "shared/support/interruption.h"

namespace endoflow::cli {

/// Whether a restart is asked for no more than what the run has reached, which is said then.
[[nodiscard]] inline bool nothing_to_do(const RunFiles& output) {
    if (output.nothing_to_do())
        say(stdout, fmt::format("already at t = {:.6g} µs, nothing to do; results in {}\n", output.reached_us(),
                                one_line(output.directory().string())));
    return output.nothing_to_do();
}

/// Calls simulate(), which returns an ExitReason, and gives the run's directory its last word, whatever happens.
/// Returns the exit code; exceptions pass on.
template <class Simulation>
[[nodiscard]] int run_to_the_end(RunOutput& output, const Simulation& simulate) {
    try {
        const ExitReason reason = simulate();
        output.finish(reason);
        return reason == ExitReason::interrupted ? exit_code_of_signal(interruption_signal()) : 0;
    } catch (const std::exception& failure) {
        try {
            output.finish_with_error(failure.what());
        } catch (const Error&) {
            // A directory that takes no last word is not what stopped the run; `failure` is.
        }
        throw;
    }
}

}  // namespace endoflow::cli
