#pragma once

#include <filesystem>
#include <optional>

#include "shared/output/checkpoint.h"

namespace endoflow {

/// directory/state.h5, written beside and renamed; the one before is kept as state.previous.h5. Throws IoError.
void write_checkpoint_file(const std::filesystem::path& directory, const Checkpoint& checkpoint);

/// The latest readable checkpoint: state.h5 or, when that is missing or damaged, the previous one.
/// Empty when there is none at all; IoError when none of those present can be read.
[[nodiscard]] std::optional<Checkpoint> read_checkpoint_file(const std::filesystem::path& directory);

}  // namespace endoflow
