#include "shared/output/run_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

#include "shared/output/provenance.h"
#include "shared/support/error.h"

namespace endoflow {

namespace {

std::string on_this_host() {
    return fmt::format(" on {} since ", host_name());
}

/// Tries to get the lock. Who asks whether it is free has it for an instant: that is waited for.
bool try_lock(int descriptor) {
    constexpr int tries = 5;
    constexpr auto pause = std::chrono::milliseconds(5);
    for (int i = 0; i < tries; ++i) {
        if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return true;
        if (errno != EWOULDBLOCK) return false;
        std::this_thread::sleep_for(pause);
    }
    errno = EWOULDBLOCK;
    return false;
}

/// What the lock file says of its last holder; empty when that ended in order.
std::string holder(int descriptor) {
    std::array<char, 300> text{};
    const auto length = ::pread(descriptor, text.data(), text.size(), 0);
    return {text.data(), static_cast<std::size_t>(std::max<ssize_t>(length, 0))};
}

int open_lock(const std::filesystem::path& file) {
    const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor < 0)
        throw IoError(fmt::format("{}: cannot be written: {}; choose another directory with -o", file.string(),
                                  std::strerror(errno)));
    return descriptor;
}

/// Whether the descriptor is of the file that has this name now: its last holder removed the one that was there.
bool is_current(int descriptor, const std::filesystem::path& file) {
    struct stat opened {
    }, named{};
    return ::fstat(descriptor, &opened) == 0 && ::stat(file.c_str(), &named) == 0 && opened.st_ino == named.st_ino;
}

}  // namespace

RunLock::RunLock(const RunDirectory& directory) : file_(directory.lock()), descriptor_(-1) {
    do {
        if (descriptor_ >= 0) ::close(descriptor_);
        descriptor_ = open_lock(file_);
        if (try_lock(descriptor_)) continue;
        if (errno != EWOULDBLOCK) {
            doubt_ = fmt::format("{}: the file system keeps no locks ({}); see to it that no other run writes there",
                                 directory.root.string(), std::strerror(errno));
            break;
        }
        const std::string other = holder(descriptor_);
        ::close(descriptor_);
        throw IoError(fmt::format("{}: in use by {}; wait until it ends, or choose another directory with -o",
                                  directory.root.string(), other.empty() ? "another process" : other));
    } while (!is_current(descriptor_, file_));
    if (const std::string last = holder(descriptor_); !last.empty() && last.find(on_this_host()) == std::string::npos)
        doubt_ = fmt::format("{}: was left by {}, which did not end in order; see to it that it no longer runs",
                             directory.root.string(), last);
    const std::string text = fmt::format("process {}{}{}", ::getpid(), on_this_host(), utc_now());
    if (::ftruncate(descriptor_, 0) != 0 || ::pwrite(descriptor_, text.data(), text.size(), 0) < 0) {
        const std::string reason = std::strerror(errno);
        ::close(descriptor_);
        throw IoError(
            fmt::format("{}: cannot be written: {}; check that the disk has space left", file_.string(), reason));
    }
}

RunLock::~RunLock() {
    // Before the lock ends: who gets it next must not lose the file it has just locked.
    ::unlink(file_.c_str());
    ::close(descriptor_);
}

bool lock_is_free(const RunDirectory& directory) {
    const int descriptor = ::open(directory.lock().c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) return errno == ENOENT;
    const std::string last = holder(descriptor);
    const bool seen_here = last.empty() || last.find(on_this_host()) != std::string::npos;
    const bool free = seen_here && ::flock(descriptor, LOCK_SH | LOCK_NB) == 0;
    ::close(descriptor);
    return free;
}

RunRecord read_current_record(const RunDirectory& directory) {
    const bool free = lock_is_free(directory);
    RunRecord record = read_record(directory);
    // Free before and after: who wrote "running" did not begin or end meanwhile.
    if (record.value("state", "") == "running" && free && lock_is_free(directory)) record["state"] = "killed";
    return record;
}

}  // namespace endoflow
