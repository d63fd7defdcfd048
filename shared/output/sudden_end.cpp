#include "shared/output/sudden_end.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <string_view>
#include <vector>

#include "shared/output/provenance.h"
#include "shared/support/error.h"

namespace endoflow {

/// What handlers put into the record.
enum class RecordBlank { reason, ended, time, accepted, none };

/// run.json in pieces; after each comes what fills the blank.
struct RecordPiece {
    std::string text;
    RecordBlank blank;
};

namespace {

/// A text in memory that is there already.
class Line {
  public:
    Line& operator<<(std::string_view text) {
        for (const char c : text)
            if (length_ < text_.size()) text_[length_++] = c;
        return *this;
    }
    Line& operator<<(const char* text) { return *this << std::string_view(text); }
    /// A text from elsewhere, without what would end a line or a string in run.json.
    Line& plain(std::string_view text) {
        for (const char c : text) {
            const bool special = static_cast<unsigned char>(c) < 0x20 || c == '"' || c == '\\';
            *this << std::string_view(special ? " " : &c, 1);
        }
        return *this;
    }
    template <class Number>
    Line& operator<<(Number value) {
        const auto end = std::to_chars(text_.data() + length_, text_.data() + text_.size(), value);
        if (end.ec == std::errc()) length_ = static_cast<std::size_t>(end.ptr - text_.data());
        return *this;
    }
    Line& rounded(double value) {
        const auto end =
            std::to_chars(text_.data() + length_, text_.data() + text_.size(), value, std::chars_format::general, 6);
        if (end.ec == std::errc()) length_ = static_cast<std::size_t>(end.ptr - text_.data());
        return *this;
    }
    /// A number of two digits at least.
    Line& two_digits(unsigned int value) { return *this << (value < 10 ? "0" : "") << value; }
    [[nodiscard]] std::string_view text() const { return {text_.data(), length_}; }

  private:
    std::array<char, 2000> text_{};
    std::size_t length_ = 0;
};

/// False when not all of it could be written.
bool write_all(int descriptor, std::string_view text) noexcept {
    while (!text.empty()) {
        const ssize_t written = ::write(descriptor, text.data(), text.size());
        if (written <= 0) return false;
        text.remove_prefix(static_cast<std::size_t>(written));
    }
    return true;
}

/// "2024-01-31T12:34:56" of a clock that is `offset` s ahead of UTC.
void add_time(Line& line, long offset) {
    using namespace std::chrono;
    const sys_seconds now{seconds(::time(nullptr) + offset)};
    const auto day = floor<days>(now);
    const year_month_day date(day);
    const hh_mm_ss clock(now - day);
    line << static_cast<int>(date.year()) << "-";
    line.two_digits(static_cast<unsigned int>(date.month())) << "-";
    line.two_digits(static_cast<unsigned int>(date.day())) << "T";
    line.two_digits(static_cast<unsigned int>(clock.hours().count())) << ":";
    line.two_digits(static_cast<unsigned int>(clock.minutes().count())) << ":";
    line.two_digits(static_cast<unsigned int>(clock.seconds().count()));
}

long local_clock_ahead() {
    const std::time_t now = std::time(nullptr);
    std::tm local{};
    return ::localtime_r(&now, &local) == nullptr ? 0 : local.tm_gmtoff;
}

constexpr std::array<std::pair<int, const char*>, 8> deadly_signals{
    {{SIGABRT, "a library called abort (SIGABRT)"},
     {SIGSEGV, "memory was read or written that is not there (SIGSEGV)"},
     {SIGBUS, "memory was read or written that is not there (SIGBUS)"},
     {SIGFPE, "an operation on numbers has no result (SIGFPE)"},
     {SIGILL, "the processor does not know an instruction (SIGILL)"},
     {SIGSYS, "the system refused a call (SIGSYS)"},
     {SIGXCPU, "the limit to the processor's time was reached (SIGXCPU)"},
     {SIGQUIT, "somebody ended the process (SIGQUIT)"}}};

std::vector<RecordPiece> in_pieces(RunRecord record) {
    constexpr std::array<std::pair<const char*, RecordBlank>, 4> blanks{{{"\"@exit_reason\"", RecordBlank::reason},
                                                                         {"\"@ended\"", RecordBlank::ended},
                                                                         {"\"@time_us\"", RecordBlank::time},
                                                                         {"\"@accepted\"", RecordBlank::accepted}}};
    record["state"] = "failed";
    record["exit_reason"] = "@exit_reason";
    record["ended"] = "@ended";
    record["time_us"] = "@time_us";
    record["steps"]["accepted"] = "@accepted";
    const std::string text = record.dump(2) + "\n";
    std::vector<RecordPiece> pieces;
    std::size_t begin = 0;
    while (begin < text.size()) {
        std::size_t next = text.size(), length = 0;
        RecordBlank blank = RecordBlank::none;
        for (const auto& [mark, which] : blanks)
            if (const auto place = text.find(mark, begin); place < next) {
                next = place;
                length = std::strlen(mark);
                blank = which;
            }
        pieces.push_back({text.substr(begin, next - begin), blank});
        begin = next + length;
    }
    return pieces;
}

}  // namespace

struct SuddenEnd::Implementation {
    std::string record, new_record, log;  // the owner's files
    std::string word;                     // the file of another process
    std::string who;
    pid_t process = ::getpid();
    long clock_ahead = local_clock_ahead();
    bool on_terminal = ::isatty(STDOUT_FILENO) == 1;
    std::array<std::vector<RecordPiece>, 2> texts;  // of run.json: one is made anew while handlers have the other
    std::atomic<unsigned int> text = 0;
    std::atomic<double> time = 0;
    std::atomic<long> accepted = 0;
    std::atomic<bool> checkpoint = false;
    std::array<struct sigaction, deadly_signals.size()> before{};
    Implementation* outer = nullptr;  // that had the handlers before

    void arm();
    void disarm();

    void speak(const char* what_happened) const noexcept {
        if (word.empty())
            tell_everybody(what_happened);
        else
            tell_the_owner(what_happened);
    }

    void tell_the_owner(const char* what_happened) const noexcept {
        const int descriptor = ::open(word.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor < 0) return;  // another process was first
        Line line;
        line.plain(who) << ": ";
        line.plain(what_happened);
        write_all(descriptor, line.text());
        ::close(descriptor);
    }

    void tell_everybody(const char* what_happened) const noexcept {
        Line message;
        message << "unexpected-end: after t = ";
        message.rounded(time.load()) << " µs (" << accepted.load() << " steps): ";
        message.plain(what_happened) << "; "
                                     << (checkpoint.load() ? "continue with --restart"
                                                           : "start again, for there is no checkpoint yet")
                                     << "; if it ends here again, choose another time.max_step or number of processes";
        write_record(message.text());
        append_to_log(message.text());
        Line line;
        line << (on_terminal ? "\n" : "") << "endoflow: " << message.text() << "\n";
        write_all(STDERR_FILENO, line.text());
    }

    void write_record(std::string_view message) const noexcept {
        const int descriptor = ::open(new_record.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
        if (descriptor < 0) return;
        bool complete = true;
        for (const RecordPiece& piece : texts.at(text.load())) {
            Line line;
            fill(line, piece.blank, message);
            complete = complete && write_all(descriptor, piece.text) && write_all(descriptor, line.text());
        }
        complete = complete && ::fsync(descriptor) == 0;
        ::close(descriptor);
        if (!complete || ::rename(new_record.c_str(), record.c_str()) != 0) ::unlink(new_record.c_str());
    }

    void fill(Line& line, RecordBlank blank, std::string_view message) const noexcept {
        switch (blank) {
            case RecordBlank::reason:
                line << "\"" << message << "\"";
                return;
            case RecordBlank::ended:
                line << "\"";
                add_time(line, 0);
                line << "Z\"";
                return;
            case RecordBlank::time:
                line << time.load();
                return;
            case RecordBlank::accepted:
                line << accepted.load();
                return;
            case RecordBlank::none:
                return;
        }
    }

    void append_to_log(std::string_view message) const noexcept {
        const int descriptor = ::open(log.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
        if (descriptor < 0) return;
        Line line;
        add_time(line, clock_ahead);
        line << " error failed: " << message << "\n";
        write_all(descriptor, line.text());
        ::close(descriptor);
    }
};

namespace {

/// That of the run which is open in this process; whoever takes it away has the last word.
std::atomic<SuddenEnd::Implementation*> open_run = nullptr;

void at_signal(int number) {
    for (const auto& [signal, what_happened] : deadly_signals)
        if (signal == number) leave_last_word(what_happened);
    std::signal(number, SIG_DFL);
    std::raise(number);  // comes when this handler is left
}

/// The exit code of a library's call may be 0.
void at_exit() {
    if (!leave_last_word("a library called exit")) return;
    std::fflush(stdout);
    std::_Exit(static_cast<int>(ExitCode::solver_stopped));
}

/// For handlers where the stack itself is full.
void make_room_for_handlers() {
    static std::array<char, 1 << 16> room;
    stack_t now{};
    if (::sigaltstack(nullptr, &now) != 0 || (now.ss_flags & SS_DISABLE) == 0) return;
    const stack_t own{room.data(), 0, room.size()};
    ::sigaltstack(&own, nullptr);
}

}  // namespace

void SuddenEnd::Implementation::arm() {
    [[maybe_unused]] static const int once = std::atexit(at_exit) + std::at_quick_exit(at_exit);
    make_room_for_handlers();
    outer = open_run.exchange(this);
    for (std::size_t i = 0; i < deadly_signals.size(); ++i) {
        struct sigaction action {};
        action.sa_handler = at_signal;
        action.sa_flags = SA_ONSTACK;
        ::sigaction(deadly_signals.at(i).first, &action, &before.at(i));
    }
}

void SuddenEnd::Implementation::disarm() {
    Implementation* self = this;
    open_run.compare_exchange_strong(self, outer);
    for (std::size_t i = 0; i < deadly_signals.size(); ++i)
        ::sigaction(deadly_signals.at(i).first, &before.at(i), nullptr);
}

SuddenEnd::SuddenEnd(const RunDirectory& directory, const RunRecord& record)
    : implementation_(std::make_unique<Implementation>()) {
    implementation_->record = directory.record();
    implementation_->new_record = implementation_->record + ".last";
    implementation_->log = directory.log();
    renew(record);
    implementation_->arm();
}

SuddenEnd::SuddenEnd(const RunDirectory& directory) : implementation_(std::make_unique<Implementation>()) {
    implementation_->word = directory.word_of_a_process();
    implementation_->who = fmt::format("process {} on {}", ::getpid(), host_name());
    implementation_->arm();
}

SuddenEnd::~SuddenEnd() {
    implementation_->disarm();
}

void SuddenEnd::renew(const RunRecord& record) {
    const unsigned int next = 1 - implementation_->text;
    implementation_->texts.at(next) = in_pieces(record);
    implementation_->text = next;
}

void SuddenEnd::reached(double time_us, long accepted_steps) noexcept {
    implementation_->time = time_us;
    implementation_->accepted = accepted_steps;
}

void SuddenEnd::checkpoint_written() noexcept {
    implementation_->checkpoint = true;
}

bool leave_last_word(const char* what_happened) noexcept {
    const SuddenEnd::Implementation* run = open_run.exchange(nullptr);
    if (run == nullptr || run->process != ::getpid()) return false;
    run->speak(what_happened);
    return true;
}

}  // namespace endoflow
