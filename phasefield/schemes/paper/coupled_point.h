#pragma once

#include <cstddef>
#include <type_traits>
#include <vector>

#include "phasefield/fem/local_system.h"
#include "phasefield/schemes/paper/bending.h"
#include "phasefield/schemes/paper/fields.h"
#include "phasefield/schemes/paper/interface_geometry.h"

namespace endoflow::phasefield::paper {

/// Everything the coupled weak form of one time step needs on one cell besides the iterate (which LocalSystem holds):
/// the fields of time level n at the quadrature points. One entry per quadrature point.
struct CoupledPoint {
    double r, measure;              // radius [nm]; r dr dz with the quadrature weight [nm³]
    LevelSetPoint phi;              // φⁿ
    LayerGeometry layer;            // |∇φⁿ|, n, P
    ProfileRelaxation relaxation;   // zero unless it is switched on
    double viscosity;               // ν(φⁿ)
    double velocity_r, velocity_z;  // uⁿ (inertia)
    double moment;                  // (β f)ⁿ
    double moment_per_unknown;      // w: β f = w X, X being the unknown of (37); 1 or β(cⁿ)
    double per_unknown_r;           // ∂_r w
    double per_unknown_z;           // ∂_z w
    double c_r, c_z;                // ∇cⁿ
    BendingCoefficients bending;    // β(cⁿ), C(cⁿ)
    double stretching;              // sⁿ
};

/// Numbers of one time step.
struct StepCoefficients {
    double tau;  // [µs]
    PhaseFieldParameters numerics;
    FluidParameters fluid;
};

using CoupledPoints = std::vector<CoupledPoint>;

/// A term's coefficient at all quadrature points: coefficient(point), or coefficient(point, number) for what the
/// iterate holds.
template <class Function>
Coefficients at_points(const CoupledPoints& points, const Function& coefficient) {
    Coefficients out(points.size());
    for (std::size_t q = 0; q < points.size(); ++q) {
        if constexpr (std::is_invocable_v<Function, const CoupledPoint&, std::size_t>) {
            out[q] = coefficient(points[q], q);
        } else {
            out[q] = coefficient(points[q]);
        }
    }
    return out;
}

/// Terms of (32)-(34) and of (35)-(37), time-discretised as in Sec. 3. Each adds its residual and Jacobian.
void add_flow_terms(const CoupledPoints& points, const StepCoefficients& step, LocalSystem& local);
void add_willmore_terms(const CoupledPoints& points, const StepCoefficients& step, LocalSystem& local);

}  // namespace endoflow::phasefield::paper
