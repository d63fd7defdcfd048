#pragma once

// The one builder of boundary-integral layers as matrices. A surface says at which points a layer is integrated for a
// target, a kernel set what these points do to it, columns which functions of the surface the densities are made of
// and where that goes: for each target component i, density component j and function k
//     matrix(row i, first + stride k) += factor ∫ kernel_ij φ_k dS.

#include <array>
#include <optional>
#include <vector>

#include "boundary_integral/kernels/ring_kernels.h"
#include "boundary_integral/operators/surface_points.h"
#include "boundary_integral/support/parallel.h"

namespace endoflow::boundary_integral {

enum class Layer { single, doubled };  // ∫ f.G dS, PV ∫ u.T.n dS

/// The columns of one component of a layer's density.
struct LayerColumns {
    Layer layer;
    std::size_t component;  // of the density
    std::size_t table;      // of the surface: its functions
    RowMatrix* matrix;
    Index first = 0, stride = 1;
    double factor = 1.0;
};

/// Sums over the points of a surface, four at a time.
class LayerSums {
  public:
    void start(const SurfacePoints& points) { points_ = &points; }
    void add(const LayerColumns& columns, const std::vector<double>& kernel, Index row);
    /// After the last one.
    void finish();

  private:
    struct Entry {
        const LayerColumns* columns;
        std::size_t group;  // of the functions
        const double* kernel;
        Index row;
    };
    const SurfacePoints* points_ = nullptr;
    std::array<Entry, 4> entries_;
    std::size_t count_ = 0;
    std::array<std::vector<double>, 4> sums_;
};

/// Serves one target after the other; one object for each thread.
///   Surface   nodes(): SurfacePoints, with which it is integrated where a target is far;
///             points(target, piece): others, where a piece needs them for this target
///   Kernels   kernels(target radius, sources): one LayerKernels for each azimuthal mode
template <class Surface, class Kernels>
class LayerBuilder {
  public:
    /// `columns` of each mode.
    template <class MakeKernels>
    LayerBuilder(const Surface& surface, const std::vector<std::vector<LayerColumns>>& columns,
                 const MakeKernels& make_kernels)
        : surface_(surface), columns_(columns), kernels_(make_kernels()), nodes_(surface.nodes()) {}

    void add(const LayerTarget& target) {
        nodes_.show(target.at);
        nodes_.measure = surface_.nodes().measure;
        for (Index piece = 0; piece < nodes_.pieces; ++piece) {
            const std::optional<SurfacePoints> points = surface_.points(target, piece);
            if (!points) continue;
            deposit(target, *points);
            nodes_.leave_out(piece);
        }
        deposit(target, nodes_);
    }

  private:
    const Surface& surface_;
    const std::vector<std::vector<LayerColumns>>& columns_;
    Kernels kernels_;
    SurfacePoints nodes_;
    LayerSums sums_;

    template <std::size_t components>
    static std::array<Index, components> rows_of(const LayerKernels<components>&, const TargetRows& rows) {
        if constexpr (components == 2) return {rows.radial, rows.axial};
        if constexpr (components == 3) return {rows.radial, rows.azimuthal, rows.axial};
    }

    void deposit(const LayerTarget& target, const SurfacePoints& points) {
        const auto modes = kernels_(target.at.r, points.sources);
        const auto rows = rows_of(modes[0], target.rows);
        sums_.start(points);
        for (std::size_t mode = 0; mode < modes.size(); ++mode) {
            for (const LayerColumns& columns : columns_[mode]) {
                const auto& kernels = columns.layer == Layer::single ? modes[mode].single : modes[mode].doubled;
                for (std::size_t i = 0; i < rows.size(); ++i) {
                    if (rows[i] >= 0) sums_.add(columns, kernels[i][columns.component], rows[i]);
                }
            }
        }
        sums_.finish();
    }
};

/// Adds the layers of a surface to the rows of all targets. make_kernels() gives the kernel set of one thread.
template <class Surface, class MakeKernels>
void add_layers(const Surface& surface, const std::vector<LayerTarget>& targets,
                const std::vector<std::vector<LayerColumns>>& columns, int threads, const MakeKernels& make_kernels) {
    // Every target owns its rows.
    parallel_parts(static_cast<Index>(targets.size()), threads, [&](Index begin, Index end) {
        LayerBuilder<Surface, decltype(make_kernels())> builder(surface, columns, make_kernels);
        for (Index i = begin; i < end; ++i) builder.add(targets[at(i)]);
    });
}

}  // namespace endoflow::boundary_integral
