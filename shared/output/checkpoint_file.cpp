#include "shared/output/checkpoint_file.h"

#include <fmt/format.h>

#include "shared/output/atomic_file.h"
#include "shared/output/hdf5_file.h"
#include "shared/support/error.h"
#include "shared/support/version.h"

namespace endoflow {

namespace {

constexpr const char* format_name = "endoflow checkpoint";
constexpr double format_version = 1;

/// Texts of any length, as arrays of character codes.
std::vector<double> codes(const std::string& text) {
    std::vector<double> values;
    values.reserve(text.size());
    for (const char c : text) values.push_back(static_cast<unsigned char>(c));
    return values;
}

std::string from_codes(const std::vector<double>& values) {
    std::string text;
    text.reserve(values.size());
    for (const double v : values) text += static_cast<char>(static_cast<unsigned char>(v));
    return text;
}

Checkpoint read_one(const std::filesystem::path& file) {
    const Hdf5File hdf5(file, Hdf5File::Mode::read);
    if (hdf5.read_text_attribute("/", "format") != format_name)
        throw IoError(file.string() + ": not a checkpoint of endoflow");
    if (const double version = hdf5.read_number_attribute("/", "version"); version != format_version)
        throw IoError(fmt::format("{}: checkpoint version {}, this program reads {}; run without --restart",
                                  file.string(), version, format_version));
    Checkpoint result;
    result.time_us = hdf5.read_number_attribute("/", "time_us");
    for (const auto& name : hdf5.members("/scalars")) {
        const auto values = hdf5.read_array("/scalars/" + name);
        if (values.size() != 1) throw IoError(file.string() + ": damaged checkpoint: no single value of " + name);
        result.scalars[name] = values.front();
    }
    for (const auto& name : hdf5.members("/arrays")) result.arrays[name] = hdf5.read_array("/arrays/" + name);
    for (const auto& name : hdf5.members("/texts")) result.texts[name] = from_codes(hdf5.read_array("/texts/" + name));
    return result;
}

}  // namespace

void write_checkpoint_file(const std::filesystem::path& directory, const Checkpoint& checkpoint) {
    const auto current = directory / "state.h5", part = directory / "state.h5.part";
    {
        Hdf5File hdf5(part, Hdf5File::Mode::create);
        hdf5.write_attribute("/", "format", format_name);
        hdf5.write_attribute("/", "version", format_version);
        hdf5.write_attribute("/", "written_by", written_by());
        hdf5.write_attribute("/", "time_us", checkpoint.time_us);
        for (const char* group : {"/scalars", "/arrays", "/texts"}) hdf5.create_group(group);
        for (const auto& [name, value] : checkpoint.scalars) hdf5.write_array("/scalars/" + name, {value});
        for (const auto& [name, values] : checkpoint.arrays) hdf5.write_array("/arrays/" + name, values);
        for (const auto& [name, text] : checkpoint.texts) hdf5.write_array("/texts/" + name, codes(text));
        hdf5.flush();
    }
    if (std::filesystem::exists(current)) publish_file(current, directory / "state.previous.h5");
    publish_file(part, current);
}

std::optional<Checkpoint> read_checkpoint_file(const std::filesystem::path& directory) {
    std::optional<IoError> failure;
    for (const char* name : {"state.h5", "state.previous.h5"}) {
        const auto file = directory / name;
        std::error_code ignored;
        if (!std::filesystem::exists(file, ignored)) continue;
        try {
            return read_one(file);
        } catch (const IoError& error) {
            if (!failure) failure = error;
        }
    }
    if (failure) throw *failure;
    return std::nullopt;
}

}  // namespace endoflow
