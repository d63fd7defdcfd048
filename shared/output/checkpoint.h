#pragma once

#include <map>
#include <string>
#include <vector>

namespace endoflow {

/// Everything an engine needs to go on: the engine decides the names. Attributes of HDF5 are limited to 64 kB, so
/// numbers that come in bulk belong into `arrays`.
struct Checkpoint {
    double time_us = 0;
    std::map<std::string, double> scalars;
    std::map<std::string, std::vector<double>> arrays;
    std::map<std::string, std::string> texts;

    /// Throw IoError when the checkpoint holds nothing of that name.
    [[nodiscard]] double scalar(const std::string& name) const;
    [[nodiscard]] const std::vector<double>& array(const std::string& name) const;
    [[nodiscard]] const std::string& text(const std::string& name) const;
};

}  // namespace endoflow
