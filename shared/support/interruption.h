#pragma once

#include <exception>

namespace endoflow {

/// Makes SIGINT, SIGTERM and SIGHUP set a flag instead of ending the process; a second one ends it at once.
/// A write into a pipe that nobody reads, or beyond the limit to the size of files (ulimit -f), fails instead of ending
/// the process.
void install_signal_handlers();

/// The signal that asked the run to stop (SIGINT, SIGTERM or SIGHUP), 0 if none did.
[[nodiscard]] int interruption_signal() noexcept;

/// As if this process had received the signal that another process of the run did; 0 changes nothing.
void share_interruption(int signal_number) noexcept;

/// A step was given up because the run was asked to stop: no failure, and what was computed before it stands.
class Interrupted : public std::exception {
  public:
    [[nodiscard]] const char* what() const noexcept override { return "interrupted within a step"; }
};

/// Throws Interrupted when the run was asked to stop. For work that takes seconds and leaves nothing half done.
void give_up_if_interrupted();

}  // namespace endoflow
