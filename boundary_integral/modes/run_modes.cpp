#include "boundary_integral/modes/run_modes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "boundary_integral/modes/mode_files.h"
#include "boundary_integral/modes/noise_files.h"
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

using Progress = std::function<void(const std::string&)>;

void write_growth(const ModesRequest& request, const AlongRun& run, const Progress& progress) {
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

void write_noise(const ModesRequest& request, const AlongRun& run, const Progress& progress) {
    NoiseFiles files(request.directory, run, *request.temperature);
    NoiseGrowth growth(run, *request.temperature, request.tolerance);
    for (const double time : times_of(run.trajectory(), request.times)) {
        growth.advance(time);
        files.add(growth);
        const NoisyShape shape = growth.shape();
        std::string line =
            fmt::format("t = {:.6g} µs   height {:.4g} ± {:.2g} nm", time, shape.height, shape.height_spread.total);
        if (shape.bud) line += fmt::format("   neck {:.4g} ± {:.2g} nm", shape.bud->neck_radius, shape.bud->neck.total);
        progress(line);
    }
    files.finish(growth);
    progress(fmt::format("noise followed in {} steps", growth.steps()));
}

void require_noise(const ModesRequest& request, const RecordedRun& run) {
    if (!(*request.temperature > 0.0 && std::isfinite(*request.temperature))) {
        throw InputError("--temperature: above 0 K");
    }
    if (request.last_mode < 2) throw InputError("--noise: needs mode 2, as in --modes 1:2");
    if (run.parameters().domain.kind != DomainKind::box) {
        throw InputError("--noise: of a membrane that was flat before its coat came, domain.kind = \"box\"");
    }
}

}  // namespace

void write_modes(const ModesRequest& request, const Progress& progress) {
    if (request.first_mode < 1 || request.last_mode < request.first_mode || request.last_mode > 16) {
        throw InputError("--modes: FIRST:LAST with 1 <= FIRST <= LAST <= 16");
    }
    if (request.times < 1) throw InputError("--times: at least 1");
    if (!(request.tolerance > 0.0 && request.tolerance < 1.0)) throw InputError("--tolerance: between 0 and 1");
    const RecordedRun recorded(request.run);
    if (request.temperature) require_noise(request, recorded);
    RunDirectory{request.directory}.make_root();  // before the work for what it is to hold
    const AlongRun run(recorded, request.first_mode, request.last_mode);
    progress(fmt::format("the run's shapes lie within {:.2g} nm of the motion that is followed", run.distance()));
    write_growth(request, run, progress);
    if (request.temperature) write_noise(request, run, progress);
}

}  // namespace endoflow::boundary_integral
