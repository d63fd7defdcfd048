#include "shared/output/run_directory.h"

#include <fmt/format.h>
#include <unistd.h>

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

}  // namespace

void RunDirectory::make_root() const {
    make_directory(root);
}

void RunDirectory::prepare_fresh() const {
    if (fs::exists(record())) {
        const auto destination = unused_number(earlier());
        make_directory(destination);
        auto items = drawings();
        items.insert(items.end(), {history(), shapes(), log(), checkpoint(), fields(), field_index(), record()});
        for (const auto& item : items) {
            if (!fs::exists(item)) continue;
            std::error_code failure;
            fs::rename(item, destination / item.filename(), failure);
            if (failure)
                throw IoError(fmt::format("{}: the earlier run cannot be moved to {}: {}", item.string(),
                                          destination.string(), failure.message()));
        }
    }
    make_directory(checkpoint());
}

void RunDirectory::require_run() const {
    std::error_code ignored;
    if (!fs::exists(record(), ignored))
        throw IoError(root.string() + ": holds no run to continue (no run.json); run without --restart");
    make_directory(root);
}

}  // namespace endoflow
