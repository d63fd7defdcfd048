// endoflow-modes: azimuthal modes of a finished run of the sharp engine.

#include <cblas.h>
#include <fmt/format.h>

#include <charconv>
#include <cstdio>

#include "boundary_integral/modes/run_modes.h"
#include "command_line.h"
#include "process.h"
#include "shared/support/console.h"
#include "shared/support/error.h"
#include "shared/support/fast_blas.h"

namespace endoflow::cli {

namespace {

// "FIRST:LAST" or one number.
void read_range(const std::string& text, int& first, int& last) {
    const auto number = [&](std::string_view part) {
        int value = 0;
        const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
        if (error != std::errc{} || end != part.data() + part.size() || part.empty()) {
            throw InputError("--modes: FIRST:LAST, not '" + text + "'");
        }
        return value;
    };
    const std::size_t colon = text.find(':');
    first = number(std::string_view(text).substr(0, colon));
    last = colon == std::string::npos ? first : number(std::string_view(text).substr(colon + 1));
}

int run(int argc, char** argv) {
    CLI::App app("Azimuthal modes of a finished run of the boundary-integral engine: does the bud stay round?",
                 "endoflow modes");
    boundary_integral::ModesRequest request;
    std::string modes = "1:8";
    app.add_option("RUN_DIR", request.run, "directory of the run")->required()->type_name("");
    app.add_option("-o,--output", request.directory, "directory of the result [RUN_DIR/modes]")->type_name("DIR");
    app.add_option("--modes", modes, "azimuthal modes [1:8]")->type_name("FIRST:LAST");
    app.add_option("--times", request.times, "at this many evenly spread times, and at budding [20]")->type_name("N");
    app.add_option("--tolerance", request.tolerance, "relative error of a perturbation in one step [0.01]")
        ->type_name("X");
    bool noise = false;
    double temperature = 310.0;
    CLI::Option* const with_noise =
        app.add_flag("--noise", noise, "thermal noise about the run as well, of modes 0 to LAST");
    app.add_option("--temperature", temperature, "of the noise, in kelvin [310]")->type_name("K")->needs(with_noise);
    app.add_option("--ensemble", request.ensemble, "as many nonlinear runs from random starts, to check the noise [0]")
        ->type_name("N")
        ->needs(with_noise);
    app.add_option("--seed", request.seed, "of their starts [1]")->type_name("N");
    bool tables_only = false;
    app.add_flag("--tables-only", tables_only, "no plots, no page, no surfaces");
    if (!parse(app, argc, argv)) return 0;
    read_range(modes, request.first_mode, request.last_mode);
    if (noise) request.temperature = temperature;
    if (request.directory.empty()) request.directory = request.run / "modes";
    require_one_process("endoflow modes", "");
    openblas_set_num_threads(1);  // the layers' own threads share the work
    boundary_integral::write_modes(request, [](const std::string& line) { say(stdout, line + "\n"); });
    say(stdout, fmt::format("results in {}\n", request.directory.string()));
    if (tables_only) return 0;
    become_python("comparisons", {"modes", request.directory.string(), "--run", request.run.string()});
}

}  // namespace

}  // namespace endoflow::cli

int main(int argc, char** argv) {
    using namespace endoflow::cli;
    endoflow::require_fast_blas(argv);
    return report(attempt([&] { return run(argc, argv); }));
}
