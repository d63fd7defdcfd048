#pragma once

#include <string>
#include <type_traits>
#include <vector>

#include "shared/output/checkpoint.h"

namespace endoflow {

// One function serialize(archive) of a state names its numbers, archive(name, number), for writing and reading. A
// number is a double, a bool or a count, or a vector of doubles.

class CheckpointWriter {
  public:
    explicit CheckpointWriter(Checkpoint& checkpoint) : checkpoint_(&checkpoint) {}

    template <class Number>
    void operator()(const std::string& name, const Number& number) const {
        if constexpr (std::is_arithmetic_v<Number>)
            checkpoint_->scalars[name] = static_cast<double>(number);
        else
            checkpoint_->arrays[name] = number;
    }

  private:
    Checkpoint* checkpoint_;
};

/// Throws IoError where the checkpoint holds nothing of a name.
class CheckpointReader {
  public:
    explicit CheckpointReader(const Checkpoint& checkpoint) : checkpoint_(&checkpoint) {}

    template <class Number>
    void operator()(const std::string& name, Number& number) const {
        if constexpr (std::is_arithmetic_v<Number>)
            number = static_cast<Number>(checkpoint_->scalar(name));
        else
            number = checkpoint_->array(name);
    }

  private:
    const Checkpoint* checkpoint_;
};

}  // namespace endoflow
