#pragma once

#include <string>

#include "shared/output/run_directory.h"
#include "shared/output/run_record.h"

namespace endoflow {

/// Holds a run's directory for this process, from construction to destruction. The kernel keeps the lock (flock), so
/// it ends with the process however that ends: a lock file that a killed process left behind holds nobody up.
class RunLock {
  public:
    /// Throws IoError that names the process, its host and since when it runs, when another one holds the directory.
    explicit RunLock(const RunDirectory& directory);
    ~RunLock();
    RunLock(const RunLock&) = delete;
    RunLock& operator=(const RunLock&) = delete;

    /// What a user should know of how the lock was taken: its last holder did not end in order and may run on another
    /// host, or the file system keeps no locks. Empty when all is well.
    [[nodiscard]] const std::string& doubt() const { return doubt_; }

  private:
    std::filesystem::path file_;
    int descriptor_;
    std::string doubt_;
};

/// Whether it is certain that no process holds a run's directory. It is not where the file system keeps no locks, and
/// where the lock was left on another host, whose locks need not be seen here.
[[nodiscard]] bool lock_is_free(const RunDirectory& directory);

/// run.json of a run with the state "killed" where it says "running" and nobody runs (python/endoflow/run_state.py for
/// Python). Throws IoError.
[[nodiscard]] RunRecord read_current_record(const RunDirectory& directory);

}  // namespace endoflow
