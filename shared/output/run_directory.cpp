#include "shared/output/run_directory.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <vector>

#include "shared/support/error.h"

namespace endoflow {

namespace fs = std::filesystem;

namespace {

void make_directory(const fs::path& directory) {
    std::error_code failure;
    fs::create_directories(directory, failure);
    if (failure || !fs::is_directory(directory) || ::access(directory.c_str(), W_OK | X_OK) != 0)
        throw IoError(fmt::format("{}: cannot be created or is not a writable directory{}; choose another with -o",
                                  directory.string(), failure ? " (" + failure.message() + ")" : ""));
}

fs::path unused_number(const fs::path& directory) {
    for (int number = 1;; ++number)
        if (auto candidate = directory / std::to_string(number); !fs::exists(candidate)) return candidate;
}

bool holds_something(const fs::path& item) {
    return fs::exists(fs::symlink_status(item)) && !(fs::is_directory(item) && fs::is_empty(item));
}

}  // namespace

void RunDirectory::make_root() const {
    make_directory(root);
}

void RunDirectory::prepare_fresh() const {
    // Without run.json they are somebody's own, or of a start that was killed; what is there is never written over.
    const std::vector<fs::path> own{history(), shapes(), log(), checkpoint(), fields(), field_index(), record()};
    if (std::any_of(own.begin(), own.end(), holds_something)) {
        const auto destination = unused_number(earlier());
        make_directory(destination);
        auto items = drawings();
        items.insert(items.end(), own.begin(), own.end());
        for (const auto& item : items) {
            if (!holds_something(item)) continue;
            std::error_code failure;
            fs::rename(item, destination / item.filename(), failure);
            if (failure)
                throw IoError(fmt::format("{}: the earlier run cannot be moved to {}: {}", item.string(),
                                          destination.string(), failure.message()));
        }
    }
    make_directory(checkpoint());
}

bool RunDirectory::holds_checkpoint() const {
    std::error_code ignored;
    return fs::exists(checkpoint() / "state.h5", ignored) || fs::exists(checkpoint() / "state.previous.h5", ignored);
}

void RunDirectory::require_run() const {
    std::error_code ignored;
    if (!fs::exists(record(), ignored))
        throw IoError(root.string() + ": holds no run to continue (no run.json); run without --restart");
    make_directory(root);
}

}  // namespace endoflow
