#pragma once

// Azimuthal modes of a finished run: what `endoflow-modes` computes and writes.

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace endoflow::boundary_integral {

struct ModesRequest {
    std::filesystem::path run, directory;
    int first_mode = 1, last_mode = 8;
    std::size_t times = 20;                  // spread evenly from the run's start to its end; budding comes in addition
    double tolerance = 1e-2;                 // relative error of a perturbation in one step, of a covariance as well
    std::optional<double> temperature = {};  // K, of thermal noise in modes 0 ... last_mode; none: no noise
    std::size_t ensemble = 0;                // nonlinear runs beside it
    unsigned int seed = 1;                   // of their starts
};

/// Writes into the directory
///     modes.csv           growth rates of the fastest modes at each time
///     perturbations.csv   what perturbations of the start have become by then
///     eigenshapes.h5      base shape, fastest mode and worst perturbation at each time
/// and with a temperature noise.csv, noise_modes.csv, noise.h5 and noise.json, with an ensemble noise_ensemble.csv, see
/// docs/noise.md, and calls `progress` with lines of text. Throws InputError, IoError and SolverError.
void write_modes(const ModesRequest& request, const std::function<void(const std::string&)>& progress);

}  // namespace endoflow::boundary_integral
