// endoflow-statics: what `endoflow statics` becomes.

#include "command_line.h"
#include "engine_run.h"
#include "locations.h"
#include "process.h"
#include "shared/case/case_file.h"
#include "shared/output/run_files.h"
#include "shared/support/interruption.h"
#include "statics/simulation.h"

namespace endoflow::cli {

namespace {

int run(int argc, char** argv) {
    CLI::App app(
        "Stationary shape of the membrane in the box: no flow, no pressure difference, no tension at the rim; or "
        "of a vesicle with the area and volume of the case's spheroid (domain.kind = \"free-space\")",
        "endoflow statics");
    std::filesystem::path case_file, directory;
    std::vector<std::string> overrides;
    std::string continuation, family, hold;
    statics::Request request;
    app.add_option("CASE", case_file, case_help)->required()->type_name("");
    app.add_option("-o,--output", directory, "directory of the result [out/CASE/statics]")->type_name("DIR");
    app.add_option("--set", overrides, "overrides the case file; may be repeated")
        ->type_name(setting)
        ->allow_extra_args(false);
    app.add_option("--continue-in", continuation, "all stationary shapes from the case's value to END")
        ->type_name("section.key=END");
    app.add_option(
           "--hold", hold,
           "shapes whose neck is held at radii from R1 to R2 (nm), the force that holds it, the work; R1 may be "
           "`open`: the widest neck there is")
        ->type_name("neck_radius=R1:R2");
    app.add_flag("--disc-mass", request.disc_mass,
                 "the molecules' mass is π patch_radius², not that of the initial profile, which is a little larger");
    app.add_option("--elements", request.resolution.elements,
                   "of the collocation while a branch is followed; a state is solved on twice as many")
        ->type_name("N")
        ->capture_default_str();
    app.add_option("--family", family, "of a vesicle: prolate, oblate or stomatocyte [as the case's spheroid is]")
        ->type_name("NAME");
    if (!parse(app, argc, argv)) return 0;
    require_one_process("endoflow statics", "");
    if (!family.empty()) request.family = statics::parse_family(family);
    case_file = find_case(case_file);
    const Parameters parameters = read_case(case_file, overrides);
    if (!hold.empty()) request.hold = statics::parse_hold(hold, parameters);
    if (!continuation.empty()) request.continuation = statics::parse_continuation(continuation, parameters);
    statics::require_stationary_model(parameters, request);
    if (directory.empty()) directory = std::filesystem::path("out") / case_file.stem() / "statics";

    install_signal_handlers();
    RunFiles output(parameters, statics::identity(parameters), directory, StartMode::fresh);
    return run_to_the_end(output, [&] { return statics::simulate(parameters, request, output); });
}

}  // namespace

}  // namespace endoflow::cli

int main(int argc, char** argv) {
    using namespace endoflow::cli;
    return report(attempt([&] { return run(argc, argv); }));
}
