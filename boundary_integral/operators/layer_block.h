#pragma once

// What the layer-potential builders share: targets, result blocks, and the queue that feeds the ring kernels.

#include <vector>

#include <Eigen/Core>

#include "boundary_integral/kernels/ring_kernels.h"
#include "boundary_integral/splines/spline_space.h"

namespace endoflow::boundary_integral {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// One ring of the meridian plane where velocities are wanted.
struct Target {
    double r = 0.0;
    double z = 0.0;
};

/// Which rows of the two velocity components of one target are wanted: row index or -1.
struct TargetRows {
    Index radial = -1;
    Index axial = -1;
};

}  // namespace endoflow::boundary_integral
