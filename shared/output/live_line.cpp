#include "shared/output/live_line.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>

#include "shared/support/console.h"

namespace endoflow {

namespace {

constexpr double seconds_between_updates = 0.1;
constexpr double seconds_between_plain_lines = 10;
constexpr double least_progress_to_extrapolate = 0.005;

}  // namespace

std::string format_duration(double seconds) {
    if (!std::isfinite(seconds) || seconds < 0 || seconds > 1e8) return "?";
    const auto whole = static_cast<long>(std::lround(seconds));
    if (whole < 3600) return fmt::format("{}:{:02d}", whole / 60, whole % 60);
    return fmt::format("{}:{:02d}:{:02d}", whole / 3600, whole / 60 % 60, whole % 60);
}

std::string live_text(const HistoryRow& row, double end_time_us, double seconds_left) {
    const std::string neck = row.membrane.neck ? fmt::format("{:.4g} nm", row.membrane.neck->radius) : "-";
    return fmt::format("t {:.4g}/{:.4g} µs  step {:.1e}  neck {}  strain {:.0e}  left {}", row.time_us, end_time_us,
                       row.step_us, neck, row.area_strain_max, format_duration(seconds_left));
}

LiveLine::LiveLine(std::FILE* stream, double start_time_us, double end_time_us)
    : stream_(stream),
      terminal_(isatty(fileno(stream)) != 0 && isatty(STDERR_FILENO) != 0),
      start_time_us_(start_time_us),
      end_time_us_(end_time_us),
      begin_(Clock::now()),
      last_shown_(begin_ - std::chrono::hours(1)) {}

void LiveLine::update(const HistoryRow& row) {
    const auto now = Clock::now();
    const double pause = terminal_ ? seconds_between_updates : seconds_between_plain_lines;
    if (std::chrono::duration<double>(now - last_shown_).count() < pause) return;
    last_shown_ = now;
    const double elapsed = std::chrono::duration<double>(now - begin_).count();
    const double done = (row.time_us - start_time_us_) / (end_time_us_ - start_time_us_);
    const std::string line =
        live_text(row, end_time_us_, done < least_progress_to_extrapolate ? NAN : elapsed * (1 - done) / done);
    if (terminal_)
        say(stream_, "\r\x1b[K" + clipped(line, terminal_columns(stream_) - 1));
    else
        say(stream_, line + "\n");
    open_ = terminal_;
}

void LiveLine::finish() {
    if (open_) say(stream_, "\n");
    open_ = false;
}

}  // namespace endoflow
