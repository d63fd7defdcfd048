#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "shared/parameters/parameters.h"

namespace endoflow::cli {

/// What `endoflow run ENGINE …` was asked to do.
struct RunRequest {
    std::filesystem::path case_file;
    std::filesystem::path directory;
    Parameters parameters;
    bool restart = false;
};

/// What every command says of its case file.
inline constexpr const char* case_help = "case file (TOML), or the name of one that comes with endoflow";

/// What --set takes, as help shows it.
inline constexpr const char* setting = "section.key=value";

/// Parses the arguments behind `endoflow run ENGINE` and reads the case. Returns nothing when --help was answered.
/// Throws InputError and IoError.
[[nodiscard]] std::optional<RunRequest> parse_run_request(int argc, char** argv, const std::string& engine);

/// What `endoflow run --help` prints.
[[nodiscard]] std::string run_help();

/// Parses with CLI11; its complaints become InputErrors. Returns false when --help, --version or --describe, which
/// prints the options as JSON, was answered.
[[nodiscard]] bool parse(CLI::App& app, int argc, char** argv);

/// A run that ended well has an exit code of its own; one that failed has a message too.
struct Outcome {
    int exit_code = 0;
    std::string error;  // empty when nothing failed
};

/// Calls `body`; every exception becomes an exit code and one line of text. A program does all it does in here.
[[nodiscard]] Outcome attempt(const std::function<int()>& body);

/// Prints "endoflow: message" on stderr if there is an error; returns the exit code,
/// that of failed output when all went well but standard output did not take what was printed.
int report(const Outcome& outcome);

/// The exit code that tells a shell that this signal ended the program.
[[nodiscard]] int exit_code_of_signal(int signal_number);

}  // namespace endoflow::cli
