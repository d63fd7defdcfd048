// endoflow-boundary-integral: what `endoflow run boundary-integral` becomes.

#include "boundary_integral/simulation.h"
#include "command_line.h"
#include "engine_run.h"
#include "process.h"
#include "shared/model/exchange.h"
#include "shared/output/run_files.h"
#include "shared/support/fast_blas.h"
#include "shared/support/interruption.h"

namespace endoflow::cli {

namespace {

int run(int argc, char** argv) {
    const auto request = parse_run_request(argc, argv, "boundary-integral");
    if (!request) return 0;
    require_no_bulk(request->parameters, "boundary-integral");
    require_one_process("the boundary-integral engine", "; boundary_integral.threads shares its work out");
    install_signal_handlers();
    RunFiles output(request->parameters, boundary_integral::identity(request->parameters), request->directory,
                    request->restart ? StartMode::restart : StartMode::fresh);
    if (nothing_to_do(output)) return 0;
    return run_to_the_end(output, [&] { return boundary_integral::simulate(request->parameters, output); });
}

}  // namespace

}  // namespace endoflow::cli

int main(int argc, char** argv) {
    using namespace endoflow::cli;
    endoflow::require_fast_blas(argv);
    return report(attempt([&] { return run(argc, argv); }));
}
