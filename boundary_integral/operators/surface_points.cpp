#include "boundary_integral/operators/surface_points.h"

#include <algorithm>

namespace endoflow::boundary_integral {

BasisTable::BasisTable(std::size_t functions, std::size_t points)
    : functions_(functions), width_((functions + basis_stride - 1) / basis_stride * basis_stride) {
    values_.reserve(width_ * points);
}

void BasisTable::begin_piece(std::span<const Index> index) {
    index_.insert(index_.end(), index.begin(), index.end());
}

void BasisTable::add(std::span<const double> values, double factor) {
    const std::size_t first = values_.size();
    values_.resize(first + width_);
    for (std::size_t j = 0; j < values.size(); ++j) values_[first + j] = factor * values[j];
}

void BasisTable::scatter(std::size_t piece, std::size_t group, const double* sums, double factor, double* row,
                         Index stride) const {
    const std::size_t first = basis_stride * group, count = std::min(basis_stride, functions_ - first);
    const Index* index = index_.data() + functions_ * piece + first;
    constexpr std::size_t splines = BasisRow::capacity;
    if (count == splines && stride == 1 && index[splines - 1] == index[0] + static_cast<Index>(splines) - 1) {
        double* begin = row + index[0];  // side by side: six at once
        for (std::size_t j = 0; j < splines; ++j) begin[j] += factor * sums[j];
        return;
    }
    for (std::size_t j = 0; j < count; ++j) row[stride * index[j]] += factor * sums[j];
}

void SurfacePoints::add(double radius, double delta_r, double delta_z, double normal_r, double normal_offset,
                        double weight) {
    sources.radius.push_back(radius);
    sources.delta_r.push_back(delta_r);
    sources.delta_z.push_back(delta_z);
    sources.normal_r.push_back(normal_r);
    sources.normal_offset.push_back(normal_offset);
    measure.push_back(weight);
}

void SurfacePoints::add_node(double radius, double height, double normal_r, double normal_up, double weight) {
    add(radius, 0.0, 0.0, normal_r, 0.0, weight);
    z.push_back(height);
    normal_z.push_back(normal_up);
}

void SurfacePoints::show(const Target& target) {
    for (std::size_t i = 0; i < z.size(); ++i) {
        const double dr = sources.radius[i] - target.r, dz = z[i] - target.z;
        sources.delta_r[i] = dr;
        sources.delta_z[i] = dz;
        sources.normal_offset[i] = sources.normal_r[i] * dr + normal_z[i] * dz;
    }
}

void SurfacePoints::leave_out(Index piece) {
    const std::size_t per_piece = measure.size() / at(pieces);
    for (std::size_t i = at(piece) * per_piece; i < at(piece + 1) * per_piece; ++i) {
        measure[i] = 0.0;
        sources.delta_r[i] = 1.0;  // the target may be this very point, and 0 times its kernels is not 0
    }
}

}  // namespace endoflow::boundary_integral
