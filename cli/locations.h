#pragma once

#include <filesystem>

namespace endoflow::cli {

/// Directory of the running program; the engines' programs lie beside it.
[[nodiscard]] std::filesystem::path program_directory();

/// Directory of what is not compiled ("comparisons", "python" and "cases" below it): of the installation the program
/// belongs to, else of the source tree it was built from. Throws IoError when there is none.
[[nodiscard]] std::filesystem::path data_directory();

/// The case file that a command line means: a path, or the name of a case that comes with the program ("standard").
/// Throws InputError for a name that is neither.
[[nodiscard]] std::filesystem::path find_case(const std::filesystem::path& given);

}  // namespace endoflow::cli
