#include "shared/output/field_index.h"

#include <fmt/format.h>

#include <cstdlib>
#include <utility>

#include "shared/output/atomic_file.h"
#include "shared/support/error.h"
#include "shared/support/version.h"

namespace endoflow {

namespace {

constexpr std::uintmax_t largest_list = std::uintmax_t{1} << 26;

// The times of a list that write_field_list() wrote.
std::vector<double> read_times(const std::filesystem::path& list) {
    const std::string text = read_file(list, largest_list);
    const std::string key = "timestep=\"";
    std::vector<double> times;
    for (auto at = text.find(key); at != std::string::npos; at = text.find(key, at + 1)) {
        const char* begin = text.c_str() + at + key.size();
        char* end = nullptr;
        times.push_back(std::strtod(begin, &end));
        if (end == begin || *end != '"') throw IoError(list.string() + ": damaged list of fields; remove it");
    }
    return times;
}

}  // namespace

std::filesystem::path field_file(const RunDirectory& directory, std::size_t number) {
    return directory.fields() / fmt::format("fields_{:06d}.vtu", number);
}

void write_field_list(const RunDirectory& directory, const std::vector<double>& times) {
    std::string text = fmt::format(
        "<?xml version=\"1.0\"?>\n<!-- {} -->\n"
        "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n<Collection>\n",
        written_by());
    for (std::size_t i = 0; i < times.size(); ++i)
        text += fmt::format("<DataSet timestep=\"{}\" group=\"\" part=\"0\" file=\"{}\"/>\n", times[i],
                            field_file(directory, i).lexically_relative(directory.root).string());
    write_file_atomically(directory.field_index(), text + "</Collection>\n</VTKFile>\n");
}

FieldIndex::FieldIndex(RunDirectory directory) : directory_(std::move(directory)) {}

FieldIndex::FieldIndex(RunDirectory directory, double last_time_us) : directory_(std::move(directory)) {
    if (!std::filesystem::exists(directory_.field_index())) return;
    for (const double time : read_times(directory_.field_index()))
        if (time <= last_time_us) times_.push_back(time);
    write_field_list(directory_, times_);
}

void FieldIndex::add(double time_us, const std::string& vtu) {
    std::error_code failure;
    std::filesystem::create_directories(directory_.fields(), failure);
    if (failure) throw IoError(directory_.fields().string() + ": cannot be created: " + failure.message());
    write_file_atomically(field_file(directory_, times_.size()), vtu);
    times_.push_back(time_us);
    write_field_list(directory_, times_);
}

std::optional<double> FieldIndex::latest() const {
    if (times_.empty()) return std::nullopt;
    return times_.back();
}

}  // namespace endoflow
