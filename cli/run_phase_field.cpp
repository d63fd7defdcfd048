// endoflow-phase-field: what `endoflow run phase-field` becomes, one process of possibly many.

#include <fmt/format.h>
#include <mpi.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "command_line.h"
#include "engine_run.h"
#include "phasefield/simulation.h"
#include "shared/model/loads.h"
#include "shared/output/run_files.h"
#include "shared/output/run_observer.h"
#include "shared/support/console.h"
#include "shared/support/error.h"
#include "shared/support/interruption.h"

namespace endoflow::cli {

namespace {

/// What a process says its run to: to the directory, in the first one.
struct Output {
    std::unique_ptr<RunFiles> files;
    std::unique_ptr<RunObserver> observer;

    [[nodiscard]] RunOutput* get() const { return files ? static_cast<RunOutput*>(files.get()) : observer.get(); }
};

/// The first process opens the directory; the others follow when that went well. Empty when there is nothing to do.
Output open_output(const RunRequest& request, int rank, int processes) {
    Output output;
    std::exception_ptr failure;
    if (rank == 0) {
        try {
            output.files =
                std::make_unique<RunFiles>(request.parameters, phasefield::identity(processes), request.directory,
                                           request.restart ? StartMode::restart : StartMode::fresh);
        } catch (const std::exception&) {
            failure = std::current_exception();
        }
    }
    enum { opened, idle, failed };
    int outcome = failure ? failed : output.files && nothing_to_do(*output.files) ? idle : opened;
    MPI_Bcast(&outcome, 1, MPI_INT, 0, MPI_COMM_WORLD);
    if (failure) std::rethrow_exception(failure);
    if (outcome == failed) throw IoError("the first process could not open the run's directory");
    if (outcome == idle) return {};
    if (rank != 0)
        output.observer = std::make_unique<RunObserver>(request.parameters, phasefield::identity(processes),
                                                        request.directory, request.restart);
    return output;
}

/// The other processes of the run that the first one can see: those on its host.
class Others {
  public:
    /// Collective.
    Others() {
        MPI_Comm host = MPI_COMM_NULL;
        MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &host);
        int size = 0;
        MPI_Comm_size(host, &size);
        const int own = ::getpid();
        processes_.resize(static_cast<std::size_t>(size));
        MPI_Allgather(&own, 1, MPI_INT, processes_.data(), 1, MPI_INT, host);
        MPI_Comm_free(&host);
        std::erase_if(processes_, is_gone);  // they have a table of processes of their own
    }

    /// One that has ended; empty when all are there.
    [[nodiscard]] std::optional<int> gone() const {
        const auto found = std::find_if(processes_.begin(), processes_.end(), is_gone);
        return found == processes_.end() ? std::nullopt : std::optional(*found);
    }

  private:
    static bool is_gone(int process) { return ::kill(process, 0) != 0 && errno == ESRCH; }

    std::vector<int> processes_;
};

/// mpirun kills its processes a second after it has sent them SIGTERM (odls_base_sigkill_timeout), perhaps while they
/// factorise, because somebody has interrupted the run or one of the processes has ended. So a thread of the first
/// process writes the run's last word at once. After an interruption that is as of the checkpoint on the disk, and the
/// step may end or be given up for most of that second. Nobody hurries after another signal, which mpirun does not
/// send.
class LastWords {
  public:
    LastWords(RunFiles& output, Others others) {
        thread_ = std::jthread(
            [&output, others = std::move(others)](const std::stop_token& ended) { watch(output, others, ended); });
    }

  private:
    static void watch(RunFiles& output, const Others& others, const std::stop_token& ended) {
        constexpr auto pause = std::chrono::milliseconds(20);
        constexpr int pauses_for_the_step = 35;
        for (int waited = 0; !ended.stop_requested() && waited < pauses_for_the_step;) {
            std::this_thread::sleep_for(pause);
            if (interruption_signal() != SIGTERM) continue;
            if (waited == 0) end_with_another(output, others);
            if (waited == 0) tell(output, leave_word(output));
            ++waited;
        }
        if (ended.stop_requested()) return;
        leave_word(output);
        std::_Exit(exit_code_of_signal(interruption_signal()));
    }

    static void end_with_another(RunFiles& output, const Others& others) {
        std::string reason = word_of_another(output);
        if (const auto gone = others.gone(); reason.empty() && gone)
            reason = fmt::format("process {} ended without a word, killed perhaps for want of memory", *gone);
        if (reason.empty()) return;
        output.leave_failed(reason);
        std::_Exit(static_cast<int>(ExitCode::solver_stopped));
    }

    static std::string word_of_another(const RunFiles& output) {
        try {
            return output.word_of_another_process();
        } catch (const Error&) {
            return "another process ended";
        }
    }

    /// Whether there is a checkpoint to tell of.
    static bool leave_word(RunFiles& output) {
        try {
            return output.leave_interrupted();
        } catch (const Error& error) {
            say(stderr, std::string("endoflow: ") + error.what() + "\n");
            return false;
        }
    }

    static void tell(const RunOutput& output, bool checkpoint) {
        say(stdout,
            std::string("\ninterrupted within a step, ") +
                (checkpoint ? "continue from the last checkpoint with --restart" : "before the first checkpoint") +
                "; results in " + one_line(output.directory().string()) + "\n");
    }

    std::jthread thread_;
};

/// A failure of all processes is told by the first one, which ends them all; a failure of one that is not the first
/// need not have reached it.
void wait_for_the_first_process(int rank) {
    constexpr int seconds_for_the_first_process = 5;
    if (rank != 0) std::this_thread::sleep_for(std::chrono::seconds(seconds_for_the_first_process));
}

int run(int argc, char** argv, int rank, int processes) {
    const auto request = parse_run_request(argc, argv, "phase-field");
    if (!request) return 0;
    if (request->parameters.phase_field.scheme == PhaseFieldScheme::paper)
        require_no_loads(request->parameters, "phase-field (scheme paper)");
    install_signal_handlers();
    const auto output = open_output(*request, rank, processes);
    if (output.get() == nullptr) return 0;
    std::optional<LastWords> last_words;
    if (Others others; processes > 1 && output.files) last_words.emplace(*output.files, std::move(others));
    RunOutput& said = *output.get();
    return run_to_the_end(said, [&] {
        try {
            return phasefield::simulate(request->parameters, said, MPI_COMM_WORLD);
        } catch (const std::exception&) {
            wait_for_the_first_process(rank);
            throw;
        }
    });
}

/// One process speaks for all. A failure need not have reached the others, which may be waiting for this process, so
/// several processes end through MPI_Abort.
int end_after_failure(int code, int rank, int processes) {
    if (processes == 1) return code;
    wait_for_the_first_process(rank);
    MPI_Abort(MPI_COMM_WORLD, code);
    return code;
}

}  // namespace

}  // namespace endoflow::cli

int main(int argc, char** argv) {
    using namespace endoflow;
    const phasefield::Environment environment(argv);
    int rank = 0, processes = 1;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &processes);
    const cli::Outcome outcome = cli::attempt([&] { return cli::run(argc, argv, rank, processes); });
    if (rank == 0) cli::report(outcome);
    return outcome.error.empty() ? outcome.exit_code : cli::end_after_failure(outcome.exit_code, rank, processes);
}
