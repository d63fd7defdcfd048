#include "phasefield/checkpoint/mesh_checkpoint.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <array>
#include <boost/crc.hpp>
#include <fstream>
#include <system_error>
#include <vector>

#include "shared/output/atomic_file.h"
#include "shared/support/error.h"

namespace endoflow::phasefield {

namespace {

std::uint32_t checksum(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw IoError(file.string() + ": cannot be read; check its permissions");
    boost::crc_32_type crc;
    std::array<char, 1 << 16> block;
    do {
        stream.read(block.data(), block.size());
        crc.process_bytes(block.data(), static_cast<std::size_t>(stream.gcount()));
    } while (stream);
    return crc.checksum();
}

std::vector<std::filesystem::path> files_in(const std::filesystem::path& directory) {
    std::error_code failure;
    std::vector<std::filesystem::path> files;
    for (std::filesystem::directory_iterator file(directory, failure), end; !failure && file != end;
         file.increment(failure))
        files.push_back(file->path());
    if (failure) throw IoError(directory.string() + ": cannot be read: " + failure.message());
    std::sort(files.begin(), files.end());
    return files;
}

}  // namespace

void require_whole(const std::filesystem::path& directory, std::uint64_t cells) {
    std::ifstream info(directory / "mesh.info");
    std::string names;
    std::getline(info, names);
    std::uint64_t version = 0, processes = 0, objects = 0;
    info >> version >> processes >> objects;
    // deal.II's layout: where each object of a cell ends, the last being the bytes of a cell; then the cells.
    const auto file = directory / "mesh_fixed.data";
    std::vector<std::uint32_t> ends(objects + 1);
    std::ifstream(file, std::ios::binary)
        .read(reinterpret_cast<char*>(ends.data()), static_cast<std::streamsize>(ends.size() * sizeof(std::uint32_t)));
    std::error_code failure;
    const auto size = std::filesystem::file_size(file, failure);
    if (!info || failure || size != ends.size() * sizeof(std::uint32_t) + cells * ends.back())
        throw IoError(directory.string() + ": cannot be written whole; check that the disk has space left");
    for (const auto& written : files_in(directory)) flush_to_disk(written);
}

std::string describe_files(const std::filesystem::path& directory) {
    std::string text;
    for (const auto& file : files_in(directory))
        text += file.filename().string() + " " + std::to_string(std::filesystem::file_size(file)) + " " +
                std::to_string(checksum(file)) + "\n";
    return text;
}

void require_files(const std::filesystem::path& directory, const std::string& description) {
    if (describe_files(directory) != description)
        throw IoError(directory.string() + ": damaged: not the mesh of this checkpoint; run without --restart");
}

void make_empty_directory(const std::filesystem::path& directory, MPI_Comm communicator) {
    if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0) {
        std::error_code failure;
        std::filesystem::remove_all(directory, failure);
        if (!failure) std::filesystem::create_directory(directory, failure);
        if (failure)
            throw IoError(directory.string() + ": cannot be made anew: " + failure.message() +
                          "; check that the run's directory exists and is writable");
    }
    MPI_Barrier(communicator);
}

void load_mesh(const std::filesystem::path& directory, Mesh& mesh) {
    if (!std::filesystem::exists(directory / "mesh.info"))
        throw IoError("checkpoint " + directory.string() + " holds no mesh; start the run afresh");
    try {
        mesh.load((directory / "mesh").string());
    } catch (const dealii::ExceptionBase&) {
        throw IoError("checkpoint " + directory.string() + ": its mesh is not one of this case; run without --restart");
    }
}

}  // namespace endoflow::phasefield
