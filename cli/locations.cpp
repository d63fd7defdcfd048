#include "locations.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "shared/support/error.h"
#include "shared/support/nearest_word.h"

namespace endoflow::cli {

namespace fs = std::filesystem;

namespace {

std::vector<std::string> case_names(const fs::path& directory) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(directory))
        if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
}

}  // namespace

fs::path program_directory() {
    return fs::read_symlink("/proc/self/exe").parent_path();
}

fs::path data_directory() {
    for (const fs::path& candidate : {program_directory() / "../share/endoflow", fs::path(ENDOFLOW_SOURCE_DIR)})
        if (fs::is_directory(candidate / "comparisons")) return fs::weakly_canonical(candidate);
    throw IoError("the scripts of endoflow were not found beside the program (../share/endoflow); reinstall it");
}

fs::path find_case(const fs::path& given) {
    const bool bare = given.has_filename() && !given.has_parent_path() && !given.has_extension();
    if (!bare || (fs::exists(given) && !fs::is_directory(given))) return given;
    const fs::path cases = data_directory() / "cases";
    if (fs::path file = cases / (given.string() + ".toml"); fs::exists(file)) return file;
    const auto known = case_names(cases);
    const auto nearest = nearest_word(given.string(), known);
    throw InputError(fmt::format(
        "{}: no such case file, and no case of that name comes with endoflow; {}", given.string(),
        nearest ? fmt::format("did you mean '{}'?", *nearest) : fmt::format("known: {}", fmt::join(known, ", "))));
}

}  // namespace endoflow::cli
