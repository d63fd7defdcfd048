#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "phasefield/fem/space.h"

namespace endoflow::phasefield {

/// Names, sizes and checksums of the files in a directory, one text.
[[nodiscard]] std::string describe_files(const std::filesystem::path& directory);

/// Throws IoError unless the files in the directory are those that `description` describes: p4est ends the program when
/// it reads a damaged one.
void require_files(const std::filesystem::path& directory, const std::string& description);

/// Throws IoError unless the saved vectors of all cells are in the directory, and flushes them to the disk: libraries
/// of MPI need not report a write that failed (OpenMPI's OMPIO does not on a full disk).
void require_whole(const std::filesystem::path& directory, std::uint64_t cells);

/// Makes an empty directory in the place of what is there, but not the directory it lies in; collective. Throws
/// IoError.
void make_empty_directory(const std::filesystem::path& directory, MPI_Comm communicator);

/// Reads a saved mesh in the place of the coarse one. Throws IoError.
void load_mesh(const std::filesystem::path& directory, Mesh& mesh);

}  // namespace endoflow::phasefield
