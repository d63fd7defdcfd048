#include "shared/output/hdf5_file.h"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>

#include "shared/support/error.h"

namespace endoflow {

namespace {

/// No array of a run directory comes near this; a larger size in a file means that the file is damaged.
constexpr hsize_t largest_array = hsize_t{1} << 28;

/// Our handles close what they opened. HDF5's own clean-up would try again what failed on a full disk, and crash. At
/// exit it can be declined before the first other call only; with MPI's end it comes if HDF5 starts after MPI.
[[maybe_unused]] const herr_t no_clean_up = H5dont_atexit() < 0 ? -1 : H5open();

/// An HDF5 identifier that closes itself.
class Handle {
  public:
    Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
    ~Handle() {
        if (id_ >= 0) close_(id_);
    }
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    operator hid_t() const { return id_; }

  private:
    hid_t id_;
    herr_t (*close_)(hid_t);
};

hid_t open_file(const std::filesystem::path& file, Hdf5File::Mode mode) {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    // Without locks: who looks at the results of a run must not stop it.
    const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_file_locking(access, 0, 1);
    switch (mode) {
        case Hdf5File::Mode::read:
            return H5Fopen(file.c_str(), H5F_ACC_RDONLY, access);
        case Hdf5File::Mode::create:
            return H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
        case Hdf5File::Mode::extend:
            return H5Fopen(file.c_str(), H5F_ACC_RDWR, access);
    }
    return -1;
}

}  // namespace

struct Hdf5File::Implementation {
    std::filesystem::path path;
    Handle file;

    template <class Result>
    Result require(Result outcome, const std::string& action) const {
        if (outcome < 0)
            throw IoError(fmt::format("{}: cannot {}; the file may be damaged, foreign, or the disk full",
                                      path.string(), action));
        return outcome;
    }
};

std::string hdf5_version() {
    unsigned major = 0, minor = 0, release = 0;
    H5get_libversion(&major, &minor, &release);
    return fmt::format("{}.{}.{}", major, minor, release);
}

Hdf5File::Hdf5File(const std::filesystem::path& file, Mode mode)
    : implementation_(new Implementation{file, Handle(open_file(file, mode), H5Fclose)}) {
    implementation_->require(hid_t{implementation_->file}, "open it as HDF5");
}

Hdf5File::~Hdf5File() = default;

void Hdf5File::create_group(const std::string& name) {
    const Handle group(H5Gcreate2(implementation_->file, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                       H5Gclose);
    implementation_->require(hid_t{group}, "create group " + name);
}

void Hdf5File::write_array(const std::string& name, const std::vector<double>& values) {
    const hsize_t size = values.size();
    const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose);
    const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    if (size > 0) {
        H5Pset_chunk(properties, 1, &size);
        H5Pset_fletcher32(properties);
    }
    const Handle dataset(
        H5Dcreate2(implementation_->file, name.c_str(), H5T_IEEE_F64LE, space, H5P_DEFAULT, properties, H5P_DEFAULT),
        H5Dclose);
    implementation_->require(hid_t{dataset}, "create array " + name);
    if (size > 0)
        implementation_->require(H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
                                 "write array " + name);
}

void Hdf5File::write_attribute(const std::string& object, const std::string& name, const std::string& text) {
    const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type, std::max<std::size_t>(text.size(), 1));
    H5Tset_cset(type, H5T_CSET_UTF8);
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    const Handle attribute(H5Acreate_by_name(implementation_->file, object.c_str(), name.c_str(), type, space,
                                             H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                           H5Aclose);
    implementation_->require(hid_t{attribute}, "create attribute " + object + "@" + name);
    implementation_->require(H5Awrite(attribute, type, text.c_str()), "write attribute " + object + "@" + name);
}

void Hdf5File::write_attribute(const std::string& object, const std::string& name, double value) {
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    const Handle attribute(H5Acreate_by_name(implementation_->file, object.c_str(), name.c_str(), H5T_IEEE_F64LE, space,
                                             H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                           H5Aclose);
    implementation_->require(hid_t{attribute}, "create attribute " + object + "@" + name);
    implementation_->require(H5Awrite(attribute, H5T_NATIVE_DOUBLE, &value), "write attribute " + object + "@" + name);
}

void Hdf5File::remove(const std::string& name) {
    implementation_->require(H5Ldelete(implementation_->file, name.c_str(), H5P_DEFAULT), "remove " + name);
}

void Hdf5File::flush() {
    implementation_->require(H5Fflush(implementation_->file, H5F_SCOPE_GLOBAL), "flush it");
}

std::vector<std::string> Hdf5File::members(const std::string& group) const {
    const Handle opened(H5Gopen2(implementation_->file, group.c_str(), H5P_DEFAULT), H5Gclose);
    implementation_->require(hid_t{opened}, "open group " + group);
    H5G_info_t info{};
    implementation_->require(H5Gget_info(opened, &info), "list group " + group);
    std::vector<std::string> names;
    for (hsize_t i = 0; i < info.nlinks; ++i) {
        const auto length = implementation_->require(
            H5Lget_name_by_idx(opened, ".", H5_INDEX_NAME, H5_ITER_INC, i, nullptr, 0, H5P_DEFAULT),
            "list group " + group);
        std::string name(static_cast<std::size_t>(length) + 1, '\0');
        H5Lget_name_by_idx(opened, ".", H5_INDEX_NAME, H5_ITER_INC, i, name.data(), name.size(), H5P_DEFAULT);
        name.resize(static_cast<std::size_t>(length));
        names.push_back(name);
    }
    return names;
}

std::vector<double> Hdf5File::read_array(const std::string& name) const {
    const Handle dataset(H5Dopen2(implementation_->file, name.c_str(), H5P_DEFAULT), H5Dclose);
    implementation_->require(hid_t{dataset}, "open array " + name);
    const Handle space(H5Dget_space(dataset), H5Sclose);
    const hssize_t size = implementation_->require(H5Sget_simple_extent_npoints(space), "size array " + name);
    if (H5Sget_simple_extent_ndims(space) != 1 || static_cast<hsize_t>(size) > largest_array)
        implementation_->require(-1, "read array " + name + ", which has an impossible size");
    std::vector<double> values(static_cast<std::size_t>(size));
    if (size > 0)
        implementation_->require(H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
                                 "read array " + name);
    return values;
}

std::string Hdf5File::read_text_attribute(const std::string& object, const std::string& name) const {
    const Handle attribute(
        H5Aopen_by_name(implementation_->file, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    implementation_->require(hid_t{attribute}, "open attribute " + object + "@" + name);
    const Handle type(H5Aget_type(attribute), H5Tclose);
    const std::size_t size = H5Tget_size(type);
    if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0 || size > largest_array)
        implementation_->require(-1, "read attribute " + object + "@" + name + " as text");
    std::string text(size, '\0');
    implementation_->require(H5Aread(attribute, type, text.data()), "read attribute " + object + "@" + name);
    text.resize(std::min(text.size(), text.find('\0')));
    return text;
}

double Hdf5File::read_number_attribute(const std::string& object, const std::string& name) const {
    const Handle attribute(
        H5Aopen_by_name(implementation_->file, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    implementation_->require(hid_t{attribute}, "open attribute " + object + "@" + name);
    double value = 0;
    implementation_->require(H5Aread(attribute, H5T_NATIVE_DOUBLE, &value), "read attribute " + object + "@" + name);
    return value;
}

}  // namespace endoflow
