#include "boundary_integral/modes/run_modes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "boundary_integral/modes/mode_files.h"
#include "boundary_integral/modes/noise_ensemble.h"
#include "boundary_integral/modes/noise_files.h"
#include "shared/output/atomic_file.h"
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

/// Returns the shape at each time.
std::vector<NoisyShape> write_noise(const ModesRequest& request, const AlongRun& run, const Progress& progress) {
    std::vector<NoisyShape> shapes;
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
        shapes.push_back(shape);
    }
    files.finish(growth);
    progress(fmt::format("noise followed in {} steps", growth.steps()));
    return shapes;
}

/// Beside the numbers of the members, the linear ones that they are to agree with: one shape for each time.
void write_ensemble(const ModesRequest& request, const AlongRun& run, const std::vector<NoisyShape>& linear,
                    const Progress& progress) {
    const std::vector<double> times = times_of(run.trajectory(), request.times);
    NoiseEnsemble ensemble(run, *request.temperature, request.seed);
    constexpr std::size_t between_lines = 20;
    while (ensemble.members() < request.ensemble) {
        ensemble.add(std::min(between_lines, request.ensemble - ensemble.members()), times);
        progress(fmt::format("{} of {} nonlinear runs", ensemble.members(), request.ensemble));
    }
    std::string table =
        "time_us,members,height_mean_nm,height_rms_nm,height_inherited_nm,neck_mean_nm,neck_rms_nm,"
        "neck_inherited_nm\n";
    for (std::size_t i = 0; i < times.size(); ++i) {
        const SampleSpread height = ensemble.height(i), neck = ensemble.neck(i);
        table += fmt::format("{:.9g},{},{:.6g},{:.6g},{:.6g}", times[i], ensemble.members(), height.mean,
                             height.deviation, linear[i].height_spread.inherited);
        if (linear[i].bud && std::isfinite(neck.mean))
            table += fmt::format(",{:.6g},{:.6g},{:.6g}\n", neck.mean, neck.deviation, linear[i].bud->neck.inherited);
        else
            table += ",,,\n";
    }
    write_file_atomically(request.directory / "noise_ensemble.csv", table);
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
    if (request.ensemble == 1) throw InputError("--ensemble: at least 2 runs have a spread");
    if (request.temperature) require_noise(request, recorded);
    RunDirectory{request.directory}.make_root();  // before the work for what it is to hold
    const AlongRun run(recorded, request.first_mode, request.last_mode);
    progress(fmt::format("the run's shapes lie within {:.2g} nm of the motion that is followed", run.distance()));
    write_growth(request, run, progress);
    if (!request.temperature) return;
    const std::vector<NoisyShape> shapes = write_noise(request, run, progress);
    std::filesystem::remove(request.directory / "noise_ensemble.csv");  // of another request
    if (request.ensemble > 0) write_ensemble(request, run, shapes, progress);
}

}  // namespace endoflow::boundary_integral
