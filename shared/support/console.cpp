#include "shared/support/console.h"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace endoflow {

void hold_standard_streams() {
    // The lowest free descriptor is the one that gets opened; the wrong way round, so that its use goes on to fail.
    const auto hold = [](int descriptor, int mode) {
        if (::fcntl(descriptor, F_GETFD) < 0) static_cast<void>(::open("/dev/null", mode));
    };
    hold(STDIN_FILENO, O_WRONLY);
    hold(STDOUT_FILENO, O_RDONLY);
    hold(STDERR_FILENO, O_RDONLY);
}

void say(std::FILE* stream, const std::string& text) {
    std::fwrite(text.data(), 1, text.size(), stream);
    std::fflush(stream);
}

std::string clipped(const std::string& text, int columns) {
    if (columns <= 0) return text;
    std::size_t end = 0;
    for (int seen = 0; end < text.size(); ++end) {
        const bool continues = (static_cast<unsigned char>(text[end]) & 0xc0U) == 0x80U;
        if (!continues && seen++ == columns) break;
    }
    return text.substr(0, end);
}

int terminal_columns(std::FILE* stream) {
    winsize size{};
    return ::ioctl(::fileno(stream), TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

}  // namespace endoflow
