#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "shared/output/run_directory.h"

namespace endoflow {

/// fields/fields_NNNNNN.vtu
[[nodiscard]] std::filesystem::path field_file(const RunDirectory& directory, std::size_t number);

/// Writes fields.pvd: the field files 0, 1, … with these times [µs]. Throws IoError.
void write_field_list(const RunDirectory& directory, const std::vector<double>& times);

/// The field files of a run and fields.pvd, the list of them that ParaView opens.
class FieldIndex {
  public:
    /// A fresh run has no fields yet.
    explicit FieldIndex(RunDirectory directory);
    /// A restart: goes on with those up to `last_time_us`; later ones are dropped from the list. Throws IoError.
    FieldIndex(RunDirectory directory, double last_time_us);

    /// Writes fields/fields_NNNNNN.vtu with this content, then the list, each atomically. Throws IoError.
    void add(double time_us, const std::string& vtu);

    /// When the latest fields are from, µs.
    [[nodiscard]] std::optional<double> latest() const;

  private:
    RunDirectory directory_;
    std::vector<double> times_;
};

}  // namespace endoflow
