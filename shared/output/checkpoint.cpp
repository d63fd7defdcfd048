#include "shared/output/checkpoint.h"

#include <fmt/format.h>

#include "shared/support/error.h"

namespace endoflow {

namespace {

template <class Map>
const auto& entry(const Map& map, const std::string& name) {
    const auto found = map.find(name);
    if (found == map.end())
        throw IoError(
            fmt::format("the checkpoint has no entry '{}': it was written by another engine or version; "
                        "run without --restart",
                        name));
    return found->second;
}

}  // namespace

double Checkpoint::scalar(const std::string& name) const {
    return entry(scalars, name);
}

const std::vector<double>& Checkpoint::array(const std::string& name) const {
    return entry(arrays, name);
}

const std::string& Checkpoint::text(const std::string& name) const {
    return entry(texts, name);
}

}  // namespace endoflow
