// The command `endoflow`. It validates, shows and summarises by itself and hands runs and comparisons to the programs
// that do them, so that it needs neither MPI nor deal.II.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "command_line.h"
#include "laws.h"
#include "locations.h"
#include "process.h"
#include "shared/case/case_file.h"
#include "shared/case/resolution.h"
#include "shared/output/output_size.h"
#include "shared/parameters/parameter_rendering.h"
#include "shared/support/console.h"
#include "shared/support/error.h"
#include "shared/support/nearest_word.h"
#include "shared/support/version.h"
#include "summary.h"

namespace endoflow::cli {

namespace {

const std::vector<std::string> engines{"boundary-integral", "phase-field"};
std::string did_you_mean(const std::string& word, const std::vector<std::string>& known) {
    const auto nearest = nearest_word(word, known);
    return nearest ? fmt::format("did you mean '{}'?", *nearest) : fmt::format("known: {}", fmt::join(known, ", "));
}

int run(int argc, char** argv) {
    const std::string engine = argc > 1 ? argv[1] : "";
    if (engine == "--help" || engine == "-h" || engine.empty()) {
        fmt::print("{}", run_help());
        if (engine.empty()) throw InputError("command line: run needs an engine: boundary-integral or phase-field");
        return 0;
    }
    if (engine != engines[0] && engine != engines[1])
        throw InputError(fmt::format("command line: unknown engine '{}'; {}", engine, did_you_mean(engine, engines)));
    if (std::find(argv + 2, argv + argc, std::string("--certify")) != argv + argc) {
        require_one_process("endoflow run --certify", "; --processes N gives each run of the phase field N processes");
        std::vector<std::string> arguments{"certify"};
        arguments.insert(arguments.end(), argv + 1, argv + argc);
        become_python("comparisons", arguments);
    }
    // Parallelism is between processes there; threads of the linear algebra would only fight for the cores.
    if (engine == engines[1]) ::setenv("OPENBLAS_NUM_THREADS", "1", 0);
    become_program("endoflow-" + engine, {argv + 2, argv + argc});
}

int params(int argc, char** argv) {
    CLI::App app("Lists every parameter", "endoflow params");
    bool markdown = false, toml = false, json = false;
    std::string name;
    app.add_option("SECTION", name, "of this section, or the parameter section.key [all]")->type_name("");
    auto* first = app.add_flag("--markdown", markdown, "as Markdown tables");
    auto* second = app.add_flag("--toml", toml, "as an annotated case file")->excludes(first);
    app.add_flag("--json", json, "as a list with all that is known of each")->excludes(first)->excludes(second);
    if (!parse(app, argc, argv)) return 0;
    const ParameterRows rows = name.empty() ? parameter_table() : find_parameters(name);
    fmt::print("{}", json       ? describe_parameters(rows).dump(2) + "\n"
                     : markdown ? render_parameters_markdown(rows)
                     : toml     ? render_parameters_toml(Parameters{}, rows)
                                : render_parameters_text(rows));
    return 0;
}

int check(int argc, char** argv) {
    CLI::App app("Validates a case file", "endoflow check");
    std::string file;
    std::vector<std::string> overrides;
    app.add_option("CASE", file, case_help)->required()->type_name("");
    app.add_option("--set", overrides, "overrides the case file; may be repeated")
        ->type_name(setting)
        ->allow_extra_args(false);
    bool json = false;
    app.add_flag("--json", json, "print every parameter with its value");
    if (!parse(app, argc, argv)) return 0;
    const Parameters parameters = read_case(find_case(file), overrides);
    if (json)
        fmt::print("{}\n", parameters_to_json(parameters).dump(2));
    else
        fmt::print("{}: valid (case '{}')\n", file, parameters.case_.name);
    for (const auto& [engine, what, remedy] : foreseen_inaccuracies(parameters))
        say(stderr, fmt::format("warning: {}: {}; {}\n", engine, what, remedy));
    for (const std::string& engine : engines)
        if (const std::string told = much_output(parameters, engine); !told.empty())
            say(stderr, fmt::format("warning: {}; {}\n", told, less_output));
    return 0;
}

int laws(int argc, char** argv) {
    CLI::App app("Prints the constitutive laws as CSV", "endoflow laws");
    std::string file;
    std::vector<std::string> overrides;
    app.add_option("CASE", file, "case file (TOML) with another membrane than the paper's")->type_name("");
    app.add_option("--set", overrides, "overrides the case file; may be repeated")
        ->type_name(setting)
        ->allow_extra_args(false);
    if (!parse(app, argc, argv)) return 0;
    const Parameters parameters =
        file.empty() ? parse_case("", "the paper's case", overrides) : read_case(find_case(file), overrides);
    fmt::print("{}", constitutive_laws_csv(parameters.membrane));
    return 0;
}

int summary(int argc, char** argv) {
    CLI::App app("One screen about a run", "endoflow summary");
    std::string directory;
    app.add_option("DIR", directory, "directory of a run")->required()->type_name("");
    if (!parse(app, argc, argv)) return 0;
    fmt::print("{}", summarize_run(directory));
    return 0;
}

int dispatch(int argc, char** argv);

std::string overview();

/// `endoflow help run` is `endoflow run --help`.
int help(int argc, char** argv) {
    if (argc < 2) {
        fmt::print("{}", overview());
        return 0;
    }
    std::string option = "--help";
    std::vector<char*> words{argv[0], argv[1], option.data(), nullptr};
    return dispatch(3, words.data());
}

/// A module of comparisons/commands/, or what its options.py says becomes of the command.
int script(int argc, char** argv) {
    become_python("comparisons", {argv, argv + argc});
}

int statics(int argc, char** argv) {
    become_program("endoflow-statics", {argv + 1, argv + argc});
}

int modes(int argc, char** argv) {
    become_program("endoflow-modes", {argv + 1, argv + argc});
}

struct Command {
    std::string name;
    /// What becomes of it; its arguments begin with its name.
    int (*call)(int argc, char** argv);
    /// Its lines of the overview: what follows its name, and what it does.
    std::vector<std::pair<std::string, std::string>> lines;
};

/// Every command, in the order of the overview. Dispatch, completions and manual page come from here as well.
const std::vector<Command>& commands() {
    static const std::vector<Command> table{
        {"run",
         run,
         {{"boundary-integral CASE.toml [-o DIR] [--set section.key=value]... [--until T] [--restart]", ""},
          {"phase-field CASE.toml [the same]", "(mpirun -n N endoflow run phase-field ... uses N processes)"},
          {"ENGINE CASE.toml --certify", "the run and more accurate ones: value ± error"}}},
        {"compare", script, {{"DIR_A DIR_B [-o DIR]", "two runs: metrics.json, plots, report.html"}}},
        {"converge",
         script,
         {{"CASE.toml --epsilon E1,E2,...", "phase field against sharp membrane as the layer gets thin"}}},
        {"sweep",
         script,
         {{"CASE.toml --vary KEY=FIRST:LAST:STEP --engine ENGINE [-o DIR] [--jobs N]", "many runs of one case"}}},
        {"reproduce",
         script,
         {{"ITEM [--quick|--full] [-o DIR] [--jobs N]",
           "the paper: table2, fig3 ... fig7, figA2, attribution ... or all"}}},
        {"map",
         script,
         {{"CASE.toml --vary KEY=LOW:HIGH --vary KEY=LOW:HIGH [-o DIR]", "where outcomes change over two parameters"}}},
        {"infer",
         script,
         {{"STUDY.toml [-o DIR] [--calibrate N] [--sensitivity]", "parameters from measured or simulated data"}}},
        {"report", script, {{"DIR [-o DIR]", "a page of one run: plots, numbers, alarms, provenance"}}},
        {"crate", script, {{"DIR [--license URL]", "a run's directory described for archives (RO-Crate)"}}},
        {"movie", script, {{"DIR [-o FILE.mp4|FILE.gif]", "a run as a film (needs ffmpeg)"}}},
        {"revolve", script, {{"DIR [--angle DEGREES]", "a run's membrane as surfaces in space, for ParaView"}}},
        {"modes",
         modes,
         {{"DIR [--modes 1:8] [--noise]", "a sharp run's azimuthal modes: does the bud stay round? Thermal noise"}}},
        {"statics",
         statics,
         {{"CASE.toml [-o DIR] [--continue-in KEY=END]", "stationary shapes of the sharp membrane"}}},
        {"params",
         params,
         {{"[SECTION] [--markdown|--toml|--json]", "every parameter: default, unit, bounds, meaning"}}},
        {"laws", laws, {{"[CASE.toml] [--set section.key=value]...", "the constitutive laws b(c), H0(c) as CSV"}}},
        {"check",
         check,
         {{"CASE.toml [--set section.key=value]...", "validate a case file; --json prints all its parameters"}}},
        {"summary", summary, {{"DIR", "one screen about a run"}}},
        {"help", help, {{"[COMMAND]", "this text, or a command's own options"}}},
    };
    return table;
}

std::string overview() {
    std::string text = "endoflow: endocytosis in viscous fluid, computed by two independent engines\n\n";
    for (const Command& command : commands())
        for (const auto& [words, what] : command.lines)
            text += what.empty() ? fmt::format("  endoflow {} {}\n", command.name, words)
                                 : fmt::format("  endoflow {:<46}  {}\n", command.name + " " + words, what);
    return text + "  endoflow --version\n";
}

std::vector<std::string> command_names() {
    std::vector<std::string> names;
    for (const Command& command : commands()) names.push_back(command.name);
    return names;
}

int dispatch(int argc, char** argv) {
    const std::string name = argc > 1 ? argv[1] : "--help";
    if (name == "--help" || name == "-h") {
        fmt::print("{}", overview());
        return 0;
    }
    if (name == "--version") {
        fmt::print("endoflow {} ({})\n", version(), git_description());
        return 0;
    }
    if (name == "--describe") {  // for completions and manual page
        fmt::print("{}\n", fmt::join(command_names(), "\n"));
        return 0;
    }
    for (const Command& command : commands())
        if (command.name == name) return command.call(argc - 1, argv + 1);
    throw InputError(fmt::format("command line: unknown command '{}'; {}", name, did_you_mean(name, command_names())));
}

}  // namespace

}  // namespace endoflow::cli

int main(int argc, char** argv) {
    using namespace endoflow::cli;
    return report(attempt([&] { return dispatch(argc, argv); }));
}
