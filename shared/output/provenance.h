#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace endoflow {

/// Versions of the libraries an engine is linked to, by name.
using LibraryVersions = std::map<std::string, std::string>;

/// Program version, git description, library versions, host, cores, processor: where and with what a run was made.
[[nodiscard]] nlohmann::ordered_json provenance(const LibraryVersions& libraries);

/// The name of the machine this process runs on.
[[nodiscard]] std::string host_name();

/// The present as "2026-01-31T12:34:56Z".
[[nodiscard]] std::string utc_now();

/// Time since some moment, which no change of the clock moves, s.
[[nodiscard]] double wall_seconds();

/// CPU time this process has used so far, all threads, s.
[[nodiscard]] double cpu_seconds();

}  // namespace endoflow
