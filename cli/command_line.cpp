#include "command_line.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <new>
#include <nlohmann/json.hpp>
#include <system_error>

#include "locations.h"
#include "shared/case/case_file.h"
#include "shared/support/console.h"
#include "shared/support/error.h"

namespace endoflow::cli {

namespace {

using Json = nlohmann::ordered_json;

/// The options of a command as a table: what manual page and completions of shells are made from.
Json described(const CLI::App& app) {
    Json options = Json::array();
    for (const CLI::Option* option : app.get_options()) {
        std::vector<std::string> names;
        for (const auto& name : option->get_snames()) names.push_back("-" + name);
        for (const auto& name : option->get_lnames()) names.push_back("--" + name);
        options.push_back({{"names", names},
                           {"value", option->get_positional()               ? option->get_single_name()
                                     : option->get_items_expected_max() > 0 ? "VALUE"
                                                                            : ""},
                           {"required", option->get_required()},
                           {"help", option->get_description()},
                           {"choices", Json::array()}});
    }
    return {{"command", app.get_name()}, {"description", app.get_description()}, {"options", options}};
}

}  // namespace

bool parse(CLI::App& app, int argc, char** argv) {
    if (argc == 2 && std::string(argv[1]) == "--describe") {
        fmt::print("{}\n", described(app).dump());
        return false;
    }
    try {
        app.parse(argc, argv);
        return true;
    } catch (const CLI::Success& request) {
        app.exit(request);
        return false;
    } catch (const CLI::ParseError& failure) {
        throw InputError(
            fmt::format("command line: {}; '{} --help' shows what is allowed", failure.what(), app.get_name()));
    }
}

namespace {

/// What may follow `endoflow run ENGINE`.
struct RunOptions {
    CLI::App app;
    RunRequest request;
    std::vector<std::string> overrides;
    std::optional<std::string> until;
    bool certify = false;

    explicit RunOptions(const std::string& engine)
        : app("Runs a case with the " + engine + " engine", "endoflow run " + engine) {
        app.add_option("CASE", request.case_file, case_help)->required()->type_name("");
        app.add_option("-o,--output", request.directory, "directory of the run [out/CASE/" + engine + "]")
            ->type_name("DIR");
        app.add_option("--set", overrides, "overrides the case file; may be repeated")
            ->type_name(setting)
            ->allow_extra_args(false);
        app.add_option("--until", until, "time.end in µs")->type_name("T");
        app.add_flag("--restart", request.restart, "continue from the checkpoint in the run's directory");
        app.add_flag("--certify", certify,
                     "make more accurate runs, too, in DIR/certify: budding time, neck and area get an error; takes "
                     "--jobs N and --processes N as a sweep does");
    }
};

}  // namespace

std::string run_help() {
    return RunOptions("ENGINE").app.help() +
           "\nENGINE is boundary-integral or phase-field; mpirun -n N endoflow run phase-field ... uses N processes.\n";
}

std::optional<RunRequest> parse_run_request(int argc, char** argv, const std::string& engine) {
    RunOptions options(engine);
    if (!parse(options.app, argc, argv)) return std::nullopt;
    RunRequest& request = options.request;
    if (options.app.count("--output") > 0 && request.directory.empty())
        throw InputError("command line: -o: no directory is named; leave the option out for the one that --help shows");
    if (options.certify) throw InputError("command line: --certify is an option of `endoflow run`");
    if (options.until) options.overrides.push_back("time.end=" + *options.until);
    request.case_file = find_case(request.case_file);
    request.parameters = read_case(request.case_file, options.overrides);
    if (request.directory.empty()) request.directory = std::filesystem::path("out") / request.case_file.stem() / engine;
    return request;
}

int exit_code_of_signal(int signal_number) {
    return 128 + signal_number;
}

Outcome attempt(const std::function<int()>& body) {
    constexpr int stopped = static_cast<int>(ExitCode::solver_stopped);
    hold_standard_streams();
    try {
        return {body(), ""};
    } catch (const Error& error) {
        return {static_cast<int>(error.code()), error.what()};
    } catch (const std::filesystem::filesystem_error& failure) {
        return {static_cast<int>(ExitCode::io), failure.what()};
    } catch (const std::system_error& failure) {
        return {static_cast<int>(ExitCode::io), failure.what()};
    } catch (const std::bad_alloc&) {
        return {stopped, "out of memory: use fewer elements or larger cells"};
    } catch (const std::exception& failure) {
        return {stopped,
                one_line(fmt::format("internal error: {}; please report it with the case file", failure.what()))};
    }
}

int report(const Outcome& outcome) {
    const bool told = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
    const std::string reason = told ? "" : std::strerror(errno);
    if (!outcome.error.empty()) say(stderr, "endoflow: " + outcome.error + "\n");
    if (told || outcome.exit_code != 0) return outcome.exit_code;
    say(stderr, "endoflow: standard output cannot be written: " + reason + "\n");
    return static_cast<int>(ExitCode::io);
}

}  // namespace endoflow::cli
