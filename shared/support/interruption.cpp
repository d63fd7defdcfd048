#include "shared/support/interruption.h"

#include <csignal>

namespace endoflow {

namespace {

volatile std::sig_atomic_t received_signal = 0;

void remember_signal(int signal_number) {
    if (received_signal != 0) {
        std::signal(signal_number, SIG_DFL);
        std::raise(signal_number);
    }
    received_signal = signal_number;
}

}  // namespace

void install_signal_handlers() {
    std::signal(SIGINT, remember_signal);
    std::signal(SIGTERM, remember_signal);
    std::signal(SIGHUP, remember_signal);
    std::signal(SIGPIPE, SIG_IGN);  // nobody reads the terminal's lines any more: the run goes on
    std::signal(SIGXFSZ, SIG_IGN);  // a file over the limit of ulimit -f: the write fails and is reported
}

int interruption_signal() noexcept {
    return received_signal;
}

void share_interruption(int signal_number) noexcept {
    if (received_signal == 0) received_signal = signal_number;
}

void give_up_if_interrupted() {
    if (received_signal != 0) throw Interrupted();
}

}  // namespace endoflow
