#pragma once

#include <string>
#include <vector>

namespace endoflow {

/// Values at the points of a grid, `components` numbers for each point.
struct PointData {
    std::string name;
    int components = 1;
    std::vector<double> values;
};

/// A grid of quadrilaterals with the corners (x_i, y_j); point j * x.size() + i.
struct QuadGrid {
    std::vector<double> x, y;
    std::vector<PointData> data;
};

/// The text of a VTK unstructured-grid file (.vtu, ASCII). Throws SolverError for values that are not finite.
[[nodiscard]] std::string vtu_text(const QuadGrid& grid);

}  // namespace endoflow
