// endoflow-phase-field: what `endoflow run phase-field` becomes, one process of possibly many.

#include <mpi.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>

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

/// mpirun kills its processes a second after it has sent them SIGTERM (odls_base_sigkill_timeout), perhaps while they
/// factorise. So a thread of the first process writes the run's last word at once, as of the checkpoint that is on the
/// disk, and lets the step end or be given up for most of that second. Nobody hurries after another signal, which
/// mpirun does not send.
class LastWords {
  public:
    explicit LastWords(RunFiles& output) {
        thread_ = std::jthread([&output](const std::stop_token& ended) { watch(output, ended); });
    }

  private:
    static void watch(RunFiles& output, const std::stop_token& ended) {
        constexpr auto pause = std::chrono::milliseconds(20);
        constexpr int pauses_for_the_step = 35;
        for (int waited = 0; !ended.stop_requested() && waited < pauses_for_the_step;) {
            std::this_thread::sleep_for(pause);
            if (interruption_signal() != SIGTERM) continue;
            if (waited == 0) tell(output, leave_word(output));
            ++waited;
        }
        if (ended.stop_requested()) return;
        leave_word(output);
        std::_Exit(exit_code_of_signal(interruption_signal()));
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

int run(int argc, char** argv, int rank, int processes) {
    const auto request = parse_run_request(argc, argv, "phase-field");
    if (!request) return 0;
    if (request->parameters.phase_field.scheme == PhaseFieldScheme::paper)
        require_no_loads(request->parameters, "phase-field (scheme paper)");
    install_signal_handlers();
    const auto output = open_output(*request, rank, processes);
    if (output.get() == nullptr) return 0;
    std::optional<LastWords> last_words;
    if (processes > 1 && output.files) last_words.emplace(*output.files);
    RunOutput& said = *output.get();
    return run_to_the_end(said, [&] { return phasefield::simulate(request->parameters, said, MPI_COMM_WORLD); });
}

/// One process speaks for all. A failure need not have reached the others, which may be waiting for this process, so
/// several processes end through MPI_Abort; those that do not speak give the one that does time to.
int end_after_failure(int code, int rank, int processes) {
    constexpr int seconds_for_the_first_process = 5;
    if (processes == 1) return code;
    if (rank != 0) std::this_thread::sleep_for(std::chrono::seconds(seconds_for_the_first_process));
    MPI_Abort(MPI_COMM_WORLD, code);
    return code;
}

}  // namespace

}  // namespace endoflow::cli

int main(int argc, char** argv) {
    using namespace endoflow;
    const phasefield::Environment environment(argc, argv);
    int rank = 0, processes = 1;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &processes);
    const cli::Outcome outcome = cli::attempt([&] { return cli::run(argc, argv, rank, processes); });
    if (rank == 0) cli::report(outcome);
    return outcome.error.empty() ? outcome.exit_code : cli::end_after_failure(outcome.exit_code, rank, processes);
}
