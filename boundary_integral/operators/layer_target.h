#pragma once

// Where layer potentials are wanted.

#include <vector>

#include <Eigen/Core>

#include "boundary_integral/splines/spline_space.h"

namespace endoflow::boundary_integral {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct ElementPoints;

/// One ring of the meridian plane.
struct Target {
    double r = 0.0;
    double z = 0.0;
};

/// Which rows of a matrix the velocity's components at one target are: row index, or -1 for one that is not wanted.
struct TargetRows {
    Index radial = -1;
    Index axial = -1;
    Index azimuthal = -1;  // of modes alone
};

/// A target and the surface that it lies on, if it does: a layer is integrated differently there.
struct LayerTarget {
    Target at;
    TargetRows rows = {};
    double xi = -1.0;                                 // its parameter on the membrane, else -1
    Index node = -1;                                  // its index among the walls' nodes, else -1
    const std::vector<ElementPoints>* own = nullptr;  // own_elements of ξ, when they are at hand
};

}  // namespace endoflow::boundary_integral
