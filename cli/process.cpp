#include "process.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "locations.h"
#include "shared/support/error.h"

namespace endoflow::cli {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void become(const fs::path& program, const std::vector<std::string>& arguments) {
    std::string first = program.string();
    std::vector<std::string> copies = arguments;
    std::vector<char*> raw{first.data()};
    for (auto& argument : copies) raw.push_back(argument.data());
    raw.push_back(nullptr);
    ::execv(first.c_str(), raw.data());
    throw IoError(fmt::format("{}: cannot be started: {}; build or install it", first, std::strerror(errno)));
}

std::string python_program() {
    const char* chosen = std::getenv("ENDOFLOW_PYTHON");
    return chosen != nullptr ? chosen : ENDOFLOW_PYTHON;
}

}  // namespace

void become_program(const std::string& name, const std::vector<std::string>& arguments) {
    become(program_directory() / name, arguments);
}

void become_python(const fs::path& script, const std::vector<std::string>& arguments) {
    const fs::path data = data_directory();
    const char* before = std::getenv("PYTHONPATH");
    const std::string path = (data / "python").string() + (before != nullptr ? ":" + std::string(before) : "");
    ::setenv("PYTHONPATH", path.c_str(), 1);
    // Scripts that start runs call this very program.
    ::setenv("ENDOFLOW_PROGRAM", fs::read_symlink("/proc/self/exe").c_str(), 1);
    std::vector<std::string> all{(data / script).string()};
    all.insert(all.end(), arguments.begin(), arguments.end());
    become(python_program(), all);
}

}  // namespace endoflow::cli
