#include "phasefield/schemes/production/point_geometry.h"

namespace endoflow::phasefield::production {

namespace {

constexpr double largest_sheet_bend = constant("largest_sheet_bend");

/// x, smoothly kept below the bound.
double bounded(double x) {
    const double relative = x / largest_sheet_bend;
    return x * std::pow(1 + std::pow(relative, 8), -0.125);
}

}  // namespace

double sheet_metric(double psi, double around, double laplacian) {
    return (1 - bounded(around * psi)) / (1 - bounded((laplacian - around) * psi));
}

}  // namespace endoflow::phasefield::production
