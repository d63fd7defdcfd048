#pragma once

#include "phasefield/fem/scalar_basis.h"
#include "phasefield/fem/space.h"

namespace endoflow::phasefield {

/// One component of a vector and its first derivatives at the points of a quadrature, cell by cell.
class ComponentField {
  public:
    ComponentField(const Space& space, unsigned int component, const dealii::Quadrature<2>& quadrature)
        : space_(&space),
          component_(component),
          basis_(space.degrees[component], quadrature),
          values_(space.element.n_dofs_per_cell()) {}
    /// Valid until the next call.
    const ScalarField& on(const dealii::DoFHandler<2>::active_cell_iterator& cell, const CellBox& box,
                          const Vector& vector) {
        cell->get_dof_values(vector, values_);
        component_values(*space_, component_, values_, coefficients_);
        evaluate(basis_, box, coefficients_, Derivatives::first, field_);
        return field_;
    }

  private:
    const Space* space_;
    unsigned int component_;
    ScalarBasis basis_;
    dealii::Vector<double> values_;
    std::vector<double> coefficients_;
    ScalarField field_;
};

}  // namespace endoflow::phasefield
