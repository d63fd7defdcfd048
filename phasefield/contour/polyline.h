#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace endoflow::phasefield {

/// A quantity given at the points of a polyline [nm], at the polyline's point closest to (at_r, at_z): linear between
/// the points. The polyline is not empty.
inline double at_closest_point(const std::vector<double>& r, const std::vector<double>& z,
                               const std::vector<double>& values, double at_r, double at_z) {
    double least = std::numeric_limits<double>::max(), out = values.front();
    for (std::size_t i = 0; i + 1 < r.size(); ++i) {
        const double edge_r = r[i + 1] - r[i], edge_z = z[i + 1] - z[i];
        const double square = edge_r * edge_r + edge_z * edge_z;
        const double projected = (at_r - r[i]) * edge_r + (at_z - z[i]) * edge_z;
        const double t = square > 0 ? std::clamp(projected / square, 0.0, 1.0) : 0;
        const double to_r = r[i] + t * edge_r - at_r, to_z = z[i] + t * edge_z - at_z;
        const double distance = to_r * to_r + to_z * to_z;
        if (distance >= least) continue;
        least = distance;
        out = values[i] + t * (values[i + 1] - values[i]);
    }
    return out;
}

}  // namespace endoflow::phasefield
