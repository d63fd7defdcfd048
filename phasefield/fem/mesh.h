#pragma once

#include <memory>

#include "phasefield/fem/scalar_basis.h"
#include "phasefield/fem/space.h"
#include "shared/parameters/parameters.h"

namespace endoflow::phasefield {

/// A point of the half plane.
struct PlanePoint {
    double r, z;
};

/// The size of the cells within the layer [nm], rounded so that whole cells fill the box.
double layer_cell_size(const Parameters& parameters);

/// Coarse cells of about 2^far_refinements h, square to a few per cent; boundary ids as in `Boundary`. The number of
/// coarse cells in z is even and the pin band's edges fall on grid lines whenever h divides them.
std::unique_ptr<Mesh> coarse_mesh(const Parameters& parameters, MPI_Comm communicator);

/// Distance of a cell from a polyline: zero when they meet [nm].
double distance_to_cell(const CellBox& box, const std::vector<PlanePoint>& curve);

/// Cells within `inner` [nm] of the curve get at least this level; those farther than `outer` need it no longer.
struct RefinedBand {
    std::vector<PlanePoint> curve;
    unsigned int level;
    double inner, outer;
};

/// Sets refinement flags, one level per call. Returns true (on all ranks) when the mesh would change.
bool flag_bands(Mesh& mesh, const std::vector<RefinedBand>& bands);

}  // namespace endoflow::phasefield
