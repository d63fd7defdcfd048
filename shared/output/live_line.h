#pragma once

#include <chrono>
#include <cstdio>
#include <string>

#include "shared/output/history_file.h"

namespace endoflow {

/// Tells how far a run is: one line that is rewritten on a terminal, a plain line now and then elsewhere. Elsewhere
/// includes mpirun, which gives its processes a terminal as stdout, but not as stderr, wherever its own output goes.
class LiveLine {
  public:
    LiveLine(std::FILE* stream, double start_time_us, double end_time_us);

    void update(const HistoryRow& row);
    /// Ends the line that is being rewritten, so that what follows starts on its own line.
    void finish();

  private:
    using Clock = std::chrono::steady_clock;

    std::FILE* stream_;
    bool terminal_;
    double start_time_us_;
    double end_time_us_;
    Clock::time_point begin_;
    Clock::time_point last_shown_;
    bool open_ = false;
};

/// The line for a row, of at most 79 columns: a longer one would wrap on a terminal of 80 and could not be rewritten.
[[nodiscard]] std::string live_text(const HistoryRow& row, double end_time_us, double seconds_left);

/// "0:42", "12:07", "3:05:00"; "?" for what cannot be known.
[[nodiscard]] std::string format_duration(double seconds);

}  // namespace endoflow
