#pragma once

#include <deal.II/base/quadrature.h>

#include <functional>

#include "phasefield/schemes/paper/coupled_step.h"

namespace endoflow::phasefield::paper {

/// What the surface equations need of the coupled system at the quadrature points of one cell.
struct LayerPoint {
    double r, measure;              // radius [nm]; r dr dz with the quadrature weight
    double weight_old, weight;      // |∇φⁿ|, |∇φⁿ⁺¹| [1/nm], floored
    double velocity_r, velocity_z;  // uⁿ⁺¹ [nm/µs]
    LayerGeometry layer;            // of φⁿ⁺¹
    double value_old;               // sⁿ or cⁿ
};

/// Evaluates LayerPoints cell by cell for one unknown of a surface space.
class LayerFields {
  public:
    LayerFields(const Spaces& spaces, const Space& surface, const Parameters& parameters,
                const dealii::Quadrature<2>& quadrature);
    void evaluate_cell(const dealii::DoFHandler<2>::active_cell_iterator& flow_cell, const CellBox& box,
                       const Vector& flow_old, const Vector& flow_new, const dealii::Vector<double>& surface_values,
                       std::vector<LayerPoint>& points);

  private:
    const Spaces* spaces_;
    const Space* surface_;
    double epsilon_;
    dealii::Quadrature<2> quadrature_;
    ScalarBasis velocity_basis_, phi_basis_, surface_basis_;
    dealii::Vector<double> old_values_, new_values_;
    std::vector<double> coefficients_;
    ScalarField phi_old_, phi_new_, u_r_, u_z_, surface_field_;
};

/// The terms of a surface equation in one cell.
using SurfaceTerms = std::function<void(const std::vector<LayerPoint>& points, LocalSystem& local)>;
/// What comes through the walls into one cell at the boundary: adds to its right-hand side.
using SurfaceInflow = std::function<void(const dealii::DoFHandler<2>::active_cell_iterator& flow_cell,
                                         const CellBox& box, dealii::Vector<double>& right_hand_side)>;

/// One implicit step of a surface space's unknowns, whose equations are linear or linearised about the last step.
/// `flow_old` and `flow_new` hold φⁿ and (u, φ)ⁿ⁺¹; `values` go from step n to step n + 1.
void advance_on_layer(const Spaces& spaces, const Space& surface, const Vector& flow_old, const Vector& flow_new,
                      const Parameters& parameters, const SurfaceTerms& add_terms, const SurfaceInflow& add_inflow,
                      LinearSystem& system, Vector& values);

}  // namespace endoflow::phasefield::paper
