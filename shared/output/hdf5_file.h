#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace endoflow {

/// Of the library this process is linked to.
[[nodiscard]] std::string hdf5_version();

/// The few HDF5 operations a run directory needs: one-dimensional arrays of doubles, and attributes.
/// Every failure is an IoError that names the file. Objects are addressed by their absolute name, "/shapes/000012/r".
class Hdf5File {
  public:
    enum class Mode { read, create, extend };

    Hdf5File(const std::filesystem::path& file, Mode mode);
    ~Hdf5File();
    Hdf5File(const Hdf5File&) = delete;
    Hdf5File& operator=(const Hdf5File&) = delete;

    void create_group(const std::string& name);
    /// Stored with a checksum (Fletcher 32), verified by the library when read.
    void write_array(const std::string& name, const std::vector<double>& values);
    void write_attribute(const std::string& object, const std::string& name, const std::string& text);
    void write_attribute(const std::string& object, const std::string& name, double value);
    void remove(const std::string& name);
    void flush();

    [[nodiscard]] std::vector<std::string> members(const std::string& group) const;
    [[nodiscard]] std::vector<double> read_array(const std::string& name) const;
    [[nodiscard]] std::string read_text_attribute(const std::string& object, const std::string& name) const;
    [[nodiscard]] double read_number_attribute(const std::string& object, const std::string& name) const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace endoflow
