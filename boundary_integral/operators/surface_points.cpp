#include "boundary_integral/operators/surface_points.h"

#include <algorithm>

#include "boundary_integral/kernels/point_sums.h"

namespace endoflow::boundary_integral {

BasisTable::BasisTable(std::size_t functions, std::size_t points) : functions_(functions) {
    index_.reserve(functions_ * points);
    values_.reserve(width() * points);
}

void BasisTable::add(std::span<const Index> index, std::span<const double> values, double factor) {
    index_.insert(index_.end(), index.begin(), index.end());
    for (const double value : values) values_.push_back(factor * value);
    values_.insert(values_.end(), width() - functions_, 0.0);
}

std::size_t BasisTable::groups() const {
    return (functions_ + basis_stride - 1) / basis_stride;
}

std::size_t BasisTable::width() const {
    return basis_stride * groups();
}

const double* BasisTable::values(std::size_t group) const {
    return values_.data() + basis_stride * group;
}

void BasisTable::scatter(std::size_t point, std::size_t group, const double* sums, double factor, double* row,
                         Index stride) const {
    const std::size_t first = basis_stride * group;
    const std::size_t count = std::min(basis_stride, functions_ - first);
    const Index* index = index_.data() + functions_ * point + first;
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
