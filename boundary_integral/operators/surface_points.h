#pragma once

// Points at which layers on a surface are integrated, as a target sees them. A surface is cut into pieces: elements of
// the membrane, panels of the walls.

#include <span>
#include <vector>

#include "boundary_integral/kernels/point_sums.h"
#include "boundary_integral/kernels/ring_kernels.h"
#include "boundary_integral/operators/layer_target.h"

namespace endoflow::boundary_integral {

/// Values of functions of one kind at points, laid out for point_sums: as many are other than 0 on each piece.
class BasisTable {
  public:
    /// With room for some points.
    BasisTable(std::size_t functions, std::size_t points);

    /// The indices of the functions that are other than 0 on the piece whose points come next.
    void begin_piece(std::span<const Index> index);
    /// One more point: factor times these values.
    void add(std::span<const double> values, double factor = 1.0);

    /// Functions come in groups of basis_stride; values of a group at the first point, and how far it is to the next.
    [[nodiscard]] std::size_t groups() const { return width_ / basis_stride; }
    [[nodiscard]] std::size_t width() const { return width_; }
    [[nodiscard]] const double* values(std::size_t group) const { return values_.data() + basis_stride * group; }

    /// row[stride × index of function j] += factor × sums[j] for a group of the functions on a piece.
    void scatter(std::size_t piece, std::size_t group, const double* sums, double factor, double* row,
                 Index stride) const;

  private:
    std::size_t functions_, width_;
    std::vector<Index> index_;
    std::vector<double> values_;
};

/// The points of one piece after the other, as many on each.
struct SurfacePoints {
    RingSources sources;
    std::vector<double> z, normal_z;  // of nodes alone
    std::vector<double> measure;      // weight r ds, nm²
    std::vector<BasisTable> basis;    // one for each kind of functions of the surface
    Index pieces = 1;

    void add(double radius, double delta_r, double delta_z, double normal_r, double normal_offset, double weight);
    /// A point that many targets see one after the other.
    void add_node(double radius, double height, double normal_r, double normal_up, double weight);
    /// Nodes as this target sees them.
    void show(const Target& target);
    /// Another rule integrates this piece.
    void leave_out(Index piece);
};

}  // namespace endoflow::boundary_integral
