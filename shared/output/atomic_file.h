#pragma once

#include <filesystem>
#include <string>

namespace endoflow {

/// Replaces `file` by one with this content: written beside it, flushed to the disk, then renamed, so a reader or a
/// crash sees the old content or the new, never a part. Throws IoError.
void write_file_atomically(const std::filesystem::path& file, const std::string& content);

/// Flushes a finished file to the disk and renames it; the second half of writing a file atomically. Throws IoError.
void publish_file(const std::filesystem::path& finished, const std::filesystem::path& final_name);

/// Replaces `copy` by a copy of `file`, in the same way. Throws IoError.
void copy_file_atomically(const std::filesystem::path& file, const std::filesystem::path& copy);

/// What was written to the file so far is on the disk when this returns. Throws IoError.
void flush_to_disk(const std::filesystem::path& file);

/// The whole content of a file. Throws IoError when it cannot be read or is larger than `largest` bytes.
[[nodiscard]] std::string read_file(const std::filesystem::path& file, std::uintmax_t largest);

}  // namespace endoflow
