// endoflow-boundary-integral: what `endoflow run boundary-integral` becomes.

#include "boundary_integral/simulation.h"
#include "command_line.h"
#include "shared/output/run_output.h"
#include "shared/support/interruption.h"

namespace endoflow::cli {

namespace {

int run(int argc, char** argv) {
    const auto request = parse_run_request(argc, argv, "boundary-integral");
    if (!request) return 0;
    install_signal_handlers();
    RunOutput output(request->parameters, boundary_integral::identity(), request->directory,
                     request->restart ? StartMode::restart : StartMode::fresh);
    try {
        const ExitReason reason = boundary_integral::simulate(request->parameters, output);
        output.finish(reason);
        return reason == ExitReason::interrupted ? exit_code_of_signal(interruption_signal()) : 0;
    } catch (const std::exception& failure) {
        output.finish_with_error(failure.what());
        throw;
    }
}

}  // namespace

}  // namespace endoflow::cli

int main(int argc, char** argv) {
    using namespace endoflow::cli;
    return report(attempt([&] { return run(argc, argv); }));
}
