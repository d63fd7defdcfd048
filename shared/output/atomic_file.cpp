#include "shared/output/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "shared/support/error.h"

namespace endoflow {

namespace {

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& action) {
    throw IoError(fmt::format("{}: cannot be {}: {}; check that the directory exists, is writable and has space left",
                              file.string(), action, std::strerror(errno)));
}

}  // namespace

void flush_to_disk(const std::filesystem::path& path) {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) fail(path, "opened");
    const int outcome = ::fsync(descriptor);
    ::close(descriptor);
    if (outcome != 0 && errno != EINVAL) fail(path, "written to the disk");
}

void publish_file(const std::filesystem::path& finished, const std::filesystem::path& final_name) {
    flush_to_disk(finished);
    if (std::rename(finished.c_str(), final_name.c_str()) != 0) fail(final_name, "written");
    flush_to_disk(final_name.parent_path().empty() ? "." : final_name.parent_path());
}

void write_file_atomically(const std::filesystem::path& file, const std::string& content) {
    std::filesystem::path temporary = file;
    temporary += ".part";
    {
        std::ofstream stream(temporary, std::ios::binary | std::ios::trunc);
        stream << content << std::flush;
        if (!stream) fail(temporary, "written");
    }
    publish_file(temporary, file);
}

void copy_file_atomically(const std::filesystem::path& file, const std::filesystem::path& copy) {
    std::filesystem::path temporary = copy;
    temporary += ".part";
    std::error_code failure;
    std::filesystem::copy_file(file, temporary, std::filesystem::copy_options::overwrite_existing, failure);
    if (failure)
        throw IoError(fmt::format("{}: cannot be copied to {}: {}; check that the disk has space left", file.string(),
                                  temporary.string(), failure.message()));
    publish_file(temporary, copy);
}

std::string read_file(const std::filesystem::path& file, std::uintmax_t largest) {
    std::error_code failure;
    const auto size = std::filesystem::file_size(file, failure);
    if (failure) throw IoError(file.string() + ": cannot be read: " + failure.message());
    if (size > largest)
        throw IoError(
            fmt::format("{}: {} bytes, more than the {} expected of such a file", file.string(), size, largest));
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream content;
    content << stream.rdbuf();
    if (!stream) throw IoError(file.string() + ": cannot be read; check its permissions");
    return content.str();
}

}  // namespace endoflow
