#pragma once

#include <stdexcept>
#include <string>

namespace endoflow {

/// Exit codes of every endoflow program.
enum class ExitCode : int { done = 0, bad_input = 2, solver_stopped = 3, io = 4, interrupted = 130, terminated = 143 };

/// The text with control characters written as \uXXXX: parts of a message come from files.
[[nodiscard]] std::string one_line(const std::string& text);

/// An error a user can act on. what() is one line: what happened, where, and what is allowed or what to change.
class Error : public std::runtime_error {
  public:
    Error(ExitCode code, const std::string& message) : std::runtime_error(one_line(message)), code_(code) {}
    [[nodiscard]] ExitCode code() const noexcept { return code_; }

  private:
    ExitCode code_;
};

/// A bad command line or case file (exit code 2).
class InputError : public Error {
  public:
    explicit InputError(const std::string& message) : Error(ExitCode::bad_input, message) {}
};

/// A file or directory that cannot be read or written (exit code 4).
class IoError : public Error {
  public:
    explicit IoError(const std::string& message) : Error(ExitCode::io, message) {}
};

/// A numerical failure with a name and a remedy (exit code 3), e.g.
/// SolverError("step-size-underflow", "time step fell to 1e-12 µs at t = 0.3 µs", "raise time.tolerance").
class SolverError : public Error {
  public:
    SolverError(const std::string& name, const std::string& what_happened, const std::string& remedy)
        : Error(ExitCode::solver_stopped, name + ": " + what_happened + "; " + remedy), name_(name) {}
    [[nodiscard]] const std::string& name() const noexcept { return name_; }

  private:
    std::string name_;
};

}  // namespace endoflow
