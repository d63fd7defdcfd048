#include "phasefield/schemes/production/point_geometry.h"

namespace endoflow::phasefield::production {

namespace {

constexpr double largest_sheet_bend = constant("largest_sheet_bend");

/// The inverse of 1 + κψ from a sheet's own curvature.
double inverse_stretch(double curvature, double psi) {
    return 1 - bounded(curvature * psi, largest_sheet_bend).value;
}

}  // namespace

ValueAndDerivatives bounded(double x, double bound) {
    const double relative = x / bound, square = relative * relative, fourth = square * square;
    const double seventh = relative * square * fourth, eighth = fourth * fourth;
    const double factor = 1 / std::sqrt(std::sqrt(std::sqrt(1 + eighth))), first = factor / (1 + eighth);
    return {factor * x, first, -9 * first * seventh / ((1 + eighth) * bound)};
}

double sheet_arc(double psi, double around, double laplacian) {
    return 1 / inverse_stretch(laplacian - around, psi);
}

double sheet_metric(double psi, double around, double laplacian) {
    return inverse_stretch(around, psi) * sheet_arc(psi, around, laplacian);
}

}  // namespace endoflow::phasefield::production
