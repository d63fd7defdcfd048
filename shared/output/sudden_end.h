#pragma once

#include <memory>
#include <string>

#include "shared/output/run_record.h"

namespace endoflow {

/// The last word of a run whose process ends without coming back: a library calls exit, abort or MPI's own abort, or a
/// signal such as SIGSEGV ends it. While an object is alive, handlers at exit and of those signals write run.json with
/// the state "failed" and the reason, a line of log.txt and one of stderr. SIGKILL leaves no time for it.
///
/// A process of a run that is not the directory's owner writes its reason to RunDirectory::word_of_a_process(), for the
/// owner, which its launcher ends then.
///
/// What handlers write is prepared before, so that they allocate nothing and take no lock.
class SuddenEnd {
  public:
    /// Of the owner.
    SuddenEnd(const RunDirectory& directory, const RunRecord& record);
    /// Of another process.
    explicit SuddenEnd(const RunDirectory& directory);
    ~SuddenEnd();
    SuddenEnd(const SuddenEnd&) = delete;
    SuddenEnd& operator=(const SuddenEnd&) = delete;

    /// The record that is to have the last word. Time and steps are those of the last reached().
    void renew(const RunRecord& record);
    void reached(double time_us, long accepted_steps) noexcept;
    void checkpoint_written() noexcept;

    struct Implementation;  // for the handlers

  private:
    std::unique_ptr<Implementation> implementation_;
};

/// Leaves the last word of the run that is open in this process, if one is; `what_happened` is one line. True when it
/// did: the caller then ends the process. For handlers, too, of signals as well as of libraries.
bool leave_last_word(const char* what_happened) noexcept;

}  // namespace endoflow
