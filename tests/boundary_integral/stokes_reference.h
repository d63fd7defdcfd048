#pragma once

// Rows of reference/stokes.csv: exact drag factors of Stokes flow.

#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace endoflow::boundary_integral::testing {

struct StokesRow {
    double parameter;  // the number behind "=" in the second column
    double factor;     // drag/(6 pi mu a U)
};

inline std::vector<StokesRow> stokes_reference(const std::string& problem) {
    std::ifstream file(ENDOFLOW_REFERENCE_DIR "/stokes.csv");
    if (!file) throw std::runtime_error("no " ENDOFLOW_REFERENCE_DIR "/stokes.csv");
    std::vector<StokesRow> rows;
    for (std::string line; std::getline(file, line);) {
        if (line.rfind(problem + ",", 0) != 0) continue;
        const auto equals = line.find('='), comma = line.find(',', equals);
        rows.push_back({std::stod(line.substr(equals + 1)), std::stod(line.substr(comma + 1))});
    }
    return rows;
}

}  // namespace endoflow::boundary_integral::testing
