#pragma once

// Whole runs in a scratch directory, and what they wrote.

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "boundary_integral/simulation.h"
#include "shared/output/checkpoint_file.h"
#include "shared/output/run_directory.h"
#include "shared/output/run_files.h"

namespace endoflow::boundary_integral::testing {

namespace fs = std::filesystem;

struct ScratchDirectory {
    fs::path path;
    explicit ScratchDirectory(const std::string& name) : path(fs::temp_directory_path() / ("endoflow-bi-" + name)) {
        fs::remove_all(path);
    }
    ~ScratchDirectory() { fs::remove_all(path); }
};

using Table = std::vector<std::map<std::string, double>>;

// CSV with a header; lines that start with # and empty cells are skipped.
inline Table read_table(const fs::path& file) {
    std::ifstream stream(file);
    std::vector<std::string> names;
    Table table;
    for (std::string line; std::getline(stream, line);) {
        if (line.empty() || line[0] == '#') continue;
        std::istringstream cells(line);
        std::vector<std::string> values;
        for (std::string cell; std::getline(cells, cell, ',');) values.push_back(cell);
        if (names.empty()) {
            names = values;
            continue;
        }
        auto& row = table.emplace_back();
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (!values[i].empty()) row[names[i]] = std::stod(values[i]);
        }
    }
    return table;
}

// A column of a run's history at a time, linearly between rows.
inline double at_time(const Table& history, const std::string& column, double time) {
    for (std::size_t i = 1; i < history.size(); ++i) {
        const double before = history[i - 1].at("time_us"), after = history[i].at("time_us");
        if (after < time) continue;
        const double part = (time - before) / (after - before);
        return history[i - 1].at(column) * (1 - part) + history[i].at(column) * part;
    }
    return history.back().at(column);
}

inline ExitReason run(const Parameters& parameters, const fs::path& directory, StartMode mode = StartMode::fresh) {
    RunFiles output(parameters, boundary_integral::identity(parameters), directory, mode);
    const ExitReason reason = boundary_integral::simulate(parameters, output);
    output.finish(reason);
    return reason;
}

inline nlohmann::json record_of(const fs::path& directory) {
    std::ifstream file(directory / "run.json");
    return nlohmann::json::parse(file);
}

inline double latest_checkpoint_time(const fs::path& directory) {
    const auto checkpoint = read_checkpoint_file(RunDirectory{directory}.checkpoint());
    REQUIRE(checkpoint);
    return checkpoint->time_us;
}

inline Parameters standard(int elements, double end) {
    Parameters parameters;
    parameters.boundary_integral.elements = elements;
    parameters.time.end = end;
    return parameters;
}

inline void check_never_rising_energy(const Table& history) {
    for (std::size_t i = 1; i < history.size(); ++i) {
        const double before = history[i - 1].at("bending_energy_pN_nm"), after = history[i].at("bending_energy_pN_nm");
        CHECK(after < before * (1 + 1e-9));
    }
}

}  // namespace endoflow::boundary_integral::testing
