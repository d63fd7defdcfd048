// endoflow-phase-field: what `endoflow run phase-field` becomes, one process of possibly many.

#include <mpi.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <stop_token>
#include <string>
#include <thread>

#include "command_line.h"
#include "engine_run.h"
#include "phasefield/simulation.h"
#include "shared/model/loads.h"
#include "shared/output/run_output.h"
#include "shared/support/error.h"
#include "shared/support/interruption.h"

namespace endoflow::cli {

namespace {

/// The first process opens the directory; the others follow when that went well, and get nothing when there is nothing
/// to do.
std::unique_ptr<RunOutput> open_output(const RunRequest& request, int rank, int processes) {
    const StartMode mode = request.restart ? StartMode::restart : StartMode::fresh;
    const auto open = [&](OutputRole role) {
        return std::make_unique<RunOutput>(request.parameters, phasefield::identity(processes), request.directory, mode,
                                           role);
    };
    std::unique_ptr<RunOutput> output;
    std::exception_ptr failure;
    if (rank == 0) {
        try {
            output = open(OutputRole::owner);
        } catch (const std::exception&) {
            failure = std::current_exception();
        }
    }
    enum { opened, nothing_to_do, failed };
    int outcome = failure ? failed : output && output->nothing_to_do() ? nothing_to_do : opened;
    MPI_Bcast(&outcome, 1, MPI_INT, 0, MPI_COMM_WORLD);
    if (failure) std::rethrow_exception(failure);
    if (outcome == failed) throw IoError("the first process could not open the run's directory");
    if (rank != 0 && outcome == opened) return open(OutputRole::observer);
    return output;
}

/// mpirun kills its processes a second after it has asked them to end (odls_base_sigkill_timeout), often before a step
/// is done. So a thread of the first process waits half of that after a signal, then writes the run's last word; what
/// the last checkpoint holds is on the disk already.
class LastWords {
  public:
    LastWords(RunOutput& output, int processes) {
        if (processes > 1) thread_ = std::jthread([&output](const std::stop_token& ended) { watch(output, ended); });
    }

  private:
    static void watch(RunOutput& output, const std::stop_token& ended) {
        constexpr auto pause = std::chrono::milliseconds(20);
        constexpr int pauses_for_the_step = 25;
        for (int waited = 0; !ended.stop_requested() && waited < pauses_for_the_step;) {
            std::this_thread::sleep_for(pause);
            if (interruption_signal() != 0) ++waited;
        }
        if (ended.stop_requested()) return;
        try {
            output.leave_interrupted();
        } catch (const Error& error) {
            std::fputs((std::string("endoflow: ") + error.what() + "\n").c_str(), stderr);
        }
        std::_Exit(exit_code_of_signal(interruption_signal()));
    }

    std::jthread thread_;
};

int run(int argc, char** argv, int rank, int processes) {
    const auto request = parse_run_request(argc, argv, "phase-field");
    if (!request) return 0;
    if (request->parameters.phase_field.scheme == PhaseFieldScheme::paper)
        require_no_loads(request->parameters, "phase-field (scheme paper)");
    require_no_coupling(request->parameters, "phase-field");
    install_signal_handlers();
    const auto output = open_output(*request, rank, processes);
    if (!output) return 0;
    const LastWords last_words(*output, processes);
    return run_to_the_end(*output, [&] { return phasefield::simulate(request->parameters, *output, MPI_COMM_WORLD); });
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
