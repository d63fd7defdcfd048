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

/// Cells closer than the reach of one of the points get at least this level; those farther than `slack` from what all
/// reach need it no longer [nm].
struct RefinedBand {
    struct Point {
        PlanePoint at;
        double reach;
    };
    std::vector<Point> points;
    unsigned int level;
    double slack;
};

/// The least distance of a cell from what the band's points reach: negative inside [nm].
double distance_from_band(const CellBox& box, const RefinedBand& band);

/// Sets refinement flags, one level per call. Returns true (on all ranks) when the mesh would change.
bool flag_bands(Mesh& mesh, const std::vector<RefinedBand>& bands);

}  // namespace endoflow::phasefield
