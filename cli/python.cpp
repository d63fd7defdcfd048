#include "python.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "shared/support/error.h"

namespace endoflow::cli {

namespace fs = std::filesystem;

namespace {

/// What a Python answers when it is too old, and what a shell says of a program that is not there.
constexpr int too_old = 100, not_started = 127;

/// Its exit code is how many of the packages it is given are missing, none of them imported. What lies in the working
/// directory is no package: scripts do not see it.
constexpr const char* count_missing = R"(
import sys
from importlib.util import find_spec
sys.path.pop(0)
sys.exit(100 if sys.version_info < (3, 11) else sum(find_spec(name) is None for name in sys.argv[1:]))
)";

/// Runs a program without any input or output; returns its exit code, not_started where there is none.
int exit_code_of(const std::vector<std::string>& words) {
    std::vector<std::string> copies = words;
    std::vector<char*> raw;
    raw.reserve(copies.size() + 1);
    for (auto& word : copies) raw.push_back(word.data());
    raw.push_back(nullptr);
    posix_spawn_file_actions_t silent{};
    ::posix_spawn_file_actions_init(&silent);
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        ::posix_spawn_file_actions_addopen(&silent, stream, "/dev/null", O_RDWR, 0);
    pid_t child = 0;
    const int failed = ::posix_spawnp(&child, raw.front(), &silent, nullptr, raw.data(), environ);
    ::posix_spawn_file_actions_destroy(&silent);
    if (failed != 0) return not_started;
    int status = 0;
    while (::waitpid(child, &status, 0) < 0)
        if (errno != EINTR) return not_started;
    return WIFEXITED(status) ? WEXITSTATUS(status) : not_started;
}

/// The one found at configure time, then every python3 in PATH.
std::vector<fs::path> candidates() {
    std::vector<fs::path> found{ENDOFLOW_PYTHON};
    const char* path = std::getenv("PATH");
    std::istringstream folders(path != nullptr ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');) {
        const fs::path python = fs::path(folder.empty() ? "." : folder) / "python3";
        std::error_code none;
        if (fs::exists(python, none) && std::find(found.begin(), found.end(), python) == found.end())
            found.push_back(python);
    }
    return found;
}

/// Names of the packages in a file as pip reads it: one a line, comments behind #. Throws IoError.
std::vector<std::string> required_packages(const fs::path& requirements) {
    std::ifstream file(requirements);
    if (!file) throw IoError(fmt::format("{}: cannot be read; reinstall endoflow", requirements.string()));
    std::vector<std::string> names;
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line.substr(0, line.find('#')));
        if (std::string name; words >> name) names.push_back(name);
    }
    return names;
}

/// How many of the packages a Python lacks, too_old or not_started.
int missing_in(const fs::path& python, const std::vector<std::string>& packages) {
    std::vector<std::string> words{python.string(), "-c", count_missing};
    words.insert(words.end(), packages.begin(), packages.end());
    return exit_code_of(words);
}

constexpr const char* another = "name a Python 3.11 or later in the environment variable ENDOFLOW_PYTHON";

std::string refusal(const fs::path& python, int answer) {
    return python.string() + (answer == too_old ? " is too old" : " cannot be started");
}

}  // namespace

fs::path find_python(const fs::path& requirements) {
    const std::vector<std::string> packages = required_packages(requirements);
    if (const char* chosen = std::getenv("ENDOFLOW_PYTHON")) {
        const int answer = missing_in(chosen, packages);
        if (answer >= too_old)
            throw IoError(fmt::format("ENDOFLOW_PYTHON: {}; unset it, or {}", refusal(chosen, answer), another));
        return chosen;
    }
    fs::path best;
    int fewest = too_old;
    std::string refusals;
    for (const fs::path& python : candidates()) {
        const int answer = missing_in(python, packages);
        if (answer == 0) return python;
        if (answer >= too_old) refusals += refusal(python, answer) + "; ";
        if (answer < fewest) best = python;
        fewest = std::min(fewest, answer);
    }
    if (best.empty())
        throw IoError(
            fmt::format("no Python serves this command: {}install Debian's python3, or {}", refusals, another));
    return best;
}

}  // namespace endoflow::cli
