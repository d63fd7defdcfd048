#include "phasefield/output/field_file.h"

#include <deal.II/base/mpi.h>

#include <fstream>
#include <string>
#include <system_error>

#include "shared/output/atomic_file.h"
#include "shared/output/field_index.h"
#include "shared/support/error.h"

namespace endoflow::phasefield {

namespace {

/// Throws IoError unless the file ends as a VTU file does: libraries of MPI need not report a write that failed.
void require_whole(const std::filesystem::path& file) {
    const std::string end = "</VTKFile>\n";
    std::ifstream stream(file, std::ios::binary);
    stream.seekg(-static_cast<std::streamoff>(end.size()), std::ios::end);
    std::string found(end.size(), '\0');
    stream.read(found.data(), static_cast<std::streamsize>(found.size()));
    if (!stream || found != end)
        throw IoError(file.string() + ": cannot be written whole; check that the disk has space left");
}

}  // namespace

void write_field_file(const std::filesystem::path& run_directory, std::vector<double>& times, double time,
                      MPI_Comm communicator, const dealii::DataOut<2>& data) {
    const bool first = dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
    const RunDirectory directory{run_directory};
    const auto file = field_file(directory, times.size());
    std::error_code failure;
    if (first) std::filesystem::create_directories(file.parent_path(), failure);
    if (failure) throw IoError(file.parent_path().string() + ": cannot be created: " + failure.message());
    MPI_Barrier(communicator);
    auto part = file;
    part += ".part";
    try {
        data.write_vtu_in_parallel(part.string(), communicator);
    } catch (const dealii::ExceptionBase&) {
        throw IoError(part.string() + ": cannot be written; check the disk's space and permissions");
    }
    times.push_back(time);
    if (!first) return;
    require_whole(part);
    publish_file(part, file);
    write_field_list(directory, times);
}

}  // namespace endoflow::phasefield
