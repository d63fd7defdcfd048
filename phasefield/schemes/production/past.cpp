#include "phasefield/schemes/production/past.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "phasefield/contour/closest_normal.h"
#include "phasefield/contour/contour.h"
#include "phasefield/fem/scalar_basis.h"
#include "phasefield/layer/constants.h"
#include "phasefield/schemes/production/assembly.h"
#include "phasefield/schemes/production/cell_points.h"

namespace endoflow::phasefield::production {

namespace {

/// Σ_j a_j y(t_j) and the predicted normals at the quadrature points of one cell.
class PastFields {
  public:
    PastFields(const Space& space, const dealii::Quadrature<2>& quadrature, const StepNumbers& step,
               const StepPast& history)
        : space_(&space),
          quadrature_(&quadrature),
          step_(&step),
          history_(&history),
          membrane_(contour_segments(contour_fields(space, history.solutions->front()))),
          supply_(step.supply, quadrature),
          values_(space.element.n_dofs_per_cell()) {
        for (const unsigned int degree : space.degrees)
            if (!bases_.contains(degree)) bases_.emplace(degree, ScalarBasis(degree, quadrature));
    }

    void evaluate_cell(const Cell& cell, const CellBox& box, std::vector<PointPast>& points) {
        for (std::size_t q = 0; q < points.size(); ++q) {
            const auto& x = quadrature_->point(static_cast<unsigned int>(q));
            points[q].thickness = step_->thickness_at(cell->active_cell_index(), box, x[0], x[1]);
        }
        ahead_r_.assign(points.size(), 0);
        ahead_z_.assign(points.size(), 0);
        for (std::size_t j = 0; j < history_->weights.size(); ++j) {
            cell->get_dof_values((*history_->solutions)[j], values_);
            add_past(box, history_->weights[j], history_->ahead[j], points);
        }
        // The predicted normal in the layer. Far from it, where extrapolation would amplify what is there and ψ may
        // have valleys, the membrane's at the last solution: with those of ψ itself valleys would stay for ever.
        membrane_.start(box);
        const auto& supply = supply_.on(cell, box);
        cell->get_dof_values(history_->solutions->front(), values_);
        field(distance, box, psi_);
        cell->get_dof_values(*history_->extrapolated, values_);
        field(distance, box, predicted_, Derivatives::second);
        for (std::size_t q = 0; q < points.size(); ++q) {
            const double well = layer_profile(psi_.value[q], points[q].thickness.value).well;
            const auto& x = quadrature_->point(static_cast<unsigned int>(q));
            const auto last = membrane_.at(box.r0 + box.hr * x[0], box.z0 + box.hz * x[1]);
            const auto normal = [&](double r, double z, double last_below) {
                const double w = well / (well + last_below);
                return direction<double>(w * r + (1 - w) * last.r, w * z + (1 - w) * last.z);
            };
            if (step_->material_force && well > weight_cut * weight_cut)
                points[q].material_force = step_->material_force->at(box.r0 + box.hr * x[0], box.z0 + box.hz * x[1]);
            const double around = predicted_.r[q] / (box.r0 + box.hr * x[0]);
            points[q].bulk = supply[q];
            points[q].normal = normal(predicted_.r[q], predicted_.z[q], tail_cut);
            const auto change =
                gradient_change(points[q].normal, predicted_.rr[q], predicted_.rz[q], predicted_.zz[q], around);
            points[q].arc = sheet_arc(predicted_.value[q], around, change.laplacian);
            points[q].metric = sheet_metric(predicted_.value[q], around, change.laplacian);
            points[q].even = evenness(change, points[q].thickness.value);
            points[q].own = well / (well + tail_cut);
            points[q].closest = {last.r, last.z};
            points[q].molecules_normal = normal(ahead_r_[q], ahead_z_[q], weight_cut);
        }
    }

  private:
    void field(unsigned int component, const CellBox& box, ScalarField& out, Derivatives wanted = Derivatives::first) {
        component_values(*space_, component, values_, coefficients_);
        evaluate(bases_.at(space_->degrees[component]), box, coefficients_, wanted, out);
    }

    void add_past(const CellBox& box, double weight, double ahead, std::vector<PointPast>& points) {
        field(distance, box, psi_);
        field(molecule_density, box, c_);
        field(membrane_stretch, box, s_);
        field(velocity_r, box, u_r_);
        field(velocity_z, box, u_z_);
        for (std::size_t q = 0; q < points.size(); ++q) {
            const auto layer = layer_profile(psi_.value[q], points[q].thickness.value);
            const double density = delta_Gamma(layer, step_->weight);
            points[q].distance += weight * psi_.value[q];
            points[q].indicator += weight * H_Gamma(layer.phi, step_->weight);
            points[q].slope_r += weight * psi_.r[q];
            points[q].slope_z += weight * psi_.z[q];
            ahead_r_[q] += ahead * psi_.r[q];
            ahead_z_[q] += ahead * psi_.z[q];
            points[q].molecules += weight * density * c_.value[q];
            points[q].stretching += weight * density * s_.value[q];
            points[q].velocity_r += weight * u_r_.value[q];
            points[q].velocity_z += weight * u_z_.value[q];
        }
    }

    const Space* space_;
    const dealii::Quadrature<2>* quadrature_;
    const StepNumbers* step_;
    const StepPast* history_;
    ClosestNormal membrane_;
    SupplyAtPoints supply_;
    std::map<unsigned int, ScalarBasis> bases_;
    dealii::Vector<double> values_;
    std::vector<double> coefficients_, ahead_r_, ahead_z_;
    ScalarField psi_, predicted_, c_, s_, u_r_, u_z_;
};

}  // namespace

StepPast::StepPast(const Space& space, const StepNumbers& step, const std::vector<Vector>& past,
                   std::vector<double> bdf_weights, std::vector<double> weights_ahead, const Vector& guess)
    : solutions(&past),
      weights(std::move(bdf_weights)),
      ahead(std::move(weights_ahead)),
      extrapolated(&guess),
      points(space.dofs.get_triangulation().n_active_cells()) {
    const dealii::QGauss<2> quadrature(gauss_points(step.numerics));
    PastFields fields(space, quadrature, step, *this);
    for_each_cell(space, [&](const Cell& cell, const CellBox& box) {
        auto& of_cell = points[cell->active_cell_index()];
        of_cell.resize(quadrature.size());
        fields.evaluate_cell(cell, box, of_cell);
    });
}

}  // namespace endoflow::phasefield::production
