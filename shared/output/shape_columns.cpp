#include "shared/output/shape_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "shared/support/error.h"

namespace endoflow {

void require_finite(const MembraneCurve& curve) {
    for (const auto& column : shape_columns) {
        const auto& values = curve.*column.values;
        if (values.size() != curve.size())
            throw std::logic_error("all columns of a membrane curve must have the same length");
        if (!std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); }))
            throw SolverError("not-finite", fmt::format("{} of the membrane is not finite", column.name),
                              "the step that led here should have been rejected: lower time.tolerance or "
                              "time.max_step");
    }
}

}  // namespace endoflow
