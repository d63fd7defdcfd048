#pragma once

// Azimuthal modes of a finished run: what `endoflow-modes` computes and writes.

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace endoflow::boundary_integral {

struct ModesRequest {
    std::filesystem::path run, directory;
    int first_mode = 1, last_mode = 8;
    std::size_t times = 20;  // spread evenly over the run's shapes
};

/// Writes into the directory
///     modes.csv        growth rates of the fastest modes at each time
///     eigenshapes.h5   base shape and fastest mode at each time
/// and calls `progress` with a line for each time. Throws InputError and IoError.
void write_modes(const ModesRequest& request, const std::function<void(const std::string&)>& progress);

}  // namespace endoflow::boundary_integral
