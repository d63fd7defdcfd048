#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace endoflow::cli {

/// Replaces this process by a program that lies beside it. Does not return; throws IoError when it cannot start.
[[noreturn]] void become_program(const std::string& name, const std::vector<std::string>& arguments);

/// Replaces this process by Python running a script or package of the project. Does not return.
[[noreturn]] void become_python(const std::filesystem::path& script, const std::vector<std::string>& arguments);

}  // namespace endoflow::cli
