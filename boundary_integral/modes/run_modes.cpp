#include "boundary_integral/modes/run_modes.h"

#include <fmt/format.h>

#include <algorithm>

#include "boundary_integral/modes/mode_files.h"
#include "shared/output/run_directory.h"
#include "shared/support/error.h"

namespace endoflow::boundary_integral {

namespace {

/// Evenly spread from the start to the end, and budding.
std::vector<double> times_of(const BaseTrajectory& trajectory, std::size_t count) {
    std::vector<double> times;
    for (std::size_t i = 0; i < count; ++i) {
        const double part = count == 1 ? 1.0 : static_cast<double>(i) / static_cast<double>(count - 1);
        times.push_back(part * trajectory.end());
    }
    if (const auto budding = trajectory.budding()) times.push_back(*budding);
    std::ranges::sort(times);
    times.erase(std::unique(times.begin(), times.end()), times.end());
    return times;
}

}  // namespace

void write_modes(const ModesRequest& request, const std::function<void(const std::string&)>& progress) {
    if (request.first_mode < 1 || request.last_mode < request.first_mode || request.last_mode > 16) {
        throw InputError("--modes: FIRST:LAST with 1 <= FIRST <= LAST <= 16");
    }
    if (request.times < 1) throw InputError("--times: at least 1");
    if (!(request.tolerance > 0.0 && request.tolerance < 1.0)) throw InputError("--tolerance: between 0 and 1");
    const RecordedRun recorded(request.run);
    RunDirectory{request.directory}.make_root();  // before the work for what it is to hold
    const AlongRun run(recorded, request.first_mode, request.last_mode);
    progress(fmt::format("the run's shapes lie within {:.2g} nm of the motion that is followed", run.distance()));
    ModeFiles files(request.directory, run);
    PerturbationGrowth growth(run, request.tolerance);
    for (const double time : times_of(run.trajectory(), request.times)) {
        growth.advance(time);
        std::string line = fmt::format("t = {:.6g} µs   growth, 1/µs:", time);
        int mode = request.first_mode;
        for (const double rate : files.add(growth)) line += fmt::format("  {}: {:.4g}", mode++, rate);
        progress(line);
    }
    files.finish();
    progress(fmt::format("perturbations followed in {} steps", growth.steps()));
}

}  // namespace endoflow::boundary_integral
