#pragma once

namespace endoflow {

/// Makes SIGINT, SIGTERM and SIGHUP set a flag instead of ending the process; a second one ends it at once.
/// A write beyond the limit to the size of files (ulimit -f) fails instead of ending the process.
void install_signal_handlers();

/// The signal that asked the run to stop (SIGINT, SIGTERM or SIGHUP), 0 if none did. Poll once per step.
[[nodiscard]] int interruption_signal() noexcept;

}  // namespace endoflow
