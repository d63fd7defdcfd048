#pragma once

#include <deal.II/base/quadrature.h>

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "phasefield/fem/component_field.h"
#include "phasefield/fem/same_cell.h"

namespace endoflow::phasefield::production {

/// Unknowns of the bulk, relative to its initial concentration c_∞.
enum BulkField : unsigned int {
    depletion,              // 1 − c_b/c_∞
    depletion_at_membrane,  // what of it the membrane sees: its mean across the layer, constant along the normal
    n_bulk_fields,
};

/// The bulk that a step's exchange sees: data of the step, as the layer's thickness is.
struct BulkSupply {
    const Space* space;  // of the bulk, on the present mesh
    Vector values;       // with ghost values
};

/// c_b/c_∞ at the membrane at the points of a quadrature, cell by cell; 1 where there is no bulk.
class SupplyAtPoints {
  public:
    SupplyAtPoints(std::shared_ptr<const BulkSupply> supply, const dealii::Quadrature<2>& quadrature)
        : supply_(std::move(supply)), relative_(quadrature.size(), 1.0) {
        if (supply_) depletion_.emplace(*supply_->space, depletion_at_membrane, quadrature);
    }

    /// Of a cell of any space on the mesh; valid until the next call.
    const std::vector<double>& on(const dealii::DoFHandler<2>::active_cell_iterator& cell, const CellBox& box) {
        if (!supply_) return relative_;
        const auto& here = depletion_->on(same_cell(cell, *supply_->space), box, supply_->values);
        for (std::size_t q = 0; q < relative_.size(); ++q) relative_[q] = 1 - here.value[q];
        return relative_;
    }

  private:
    std::shared_ptr<const BulkSupply> supply_;
    std::optional<ComponentField> depletion_;
    std::vector<double> relative_;
};

}  // namespace endoflow::phasefield::production
