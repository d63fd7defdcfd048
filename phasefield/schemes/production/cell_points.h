#pragma once

#include <deal.II/base/quadrature.h>

#include <utility>
#include <vector>

#include "phasefield/fem/component_field.h"
#include "phasefield/fem/same_cell.h"
#include "phasefield/schemes/production/fields.h"
#include "phasefield/schemes/production/step_numbers.h"

namespace endoflow::phasefield::production {

using Cell = dealii::DoFHandler<2>::active_cell_iterator;

/// Calls visit(cell, box) for every cell of this process.
template <class Visit>
void for_each_cell(const Space& space, const Visit& visit) {
    for (const auto& cell : space.dofs.active_cell_iterators())
        if (cell->is_locally_owned()) visit(cell, cell_box(cell));
}

/// A point of a quadrature.
struct CellPoint {
    const Cell& cell;
    unsigned int q;
    double r, z;     // [nm]
    double measure;  // 2π r dr dz times the rule's weight [nm³]
    PointThickness thickness;
};

/// Components that are asked for of a vector with ghost values, on a space of the same mesh.
struct Wanted {
    const Space* space;
    const Vector* vector;
    std::vector<unsigned int> components;
};

/// Calls visit(point, x) at the quadrature points of the cells of this process; x[i] has what the i-th of `wanted` asks
/// for, with first derivatives, under the number of its component. After those of a cell calls finish(cell).
template <class Visit, class Finish>
void for_each_point(const Space& space, const StepNumbers& step, const dealii::Quadrature<2>& quadrature,
                    const std::vector<Wanted>& wanted, const Visit& visit, const Finish& finish) {
    std::vector<std::vector<std::pair<ComponentField, const ScalarField*>>> readers(wanted.size());
    for (std::size_t i = 0; i < wanted.size(); ++i)
        for (const unsigned int component : wanted[i].components)
            readers[i].emplace_back(ComponentField(*wanted[i].space, component, quadrature), nullptr);
    std::vector<Fields<double>> x(wanted.size());
    for_each_cell(space, [&](const Cell& cell, const CellBox& box) {
        for (std::size_t i = 0; i < wanted.size(); ++i)
            for (auto& [reader, field] : readers[i])
                field = &reader.on(same_cell(cell, *wanted[i].space), box, *wanted[i].vector);
        for (unsigned int q = 0; q < quadrature.size(); ++q) {
            for (std::size_t i = 0; i < wanted.size(); ++i)
                for (std::size_t k = 0; k < readers[i].size(); ++k) {
                    const ScalarField& field = *readers[i][k].second;
                    x[i][wanted[i].components[k]] = {field.value[q], field.r[q], field.z[q]};
                }
            const auto& at = quadrature.point(q);
            const double r = box.r0 + box.hr * at[0];
            visit(CellPoint{cell, q, r, box.z0 + box.hz * at[1], two_pi * r * box.hr * box.hz * quadrature.weight(q),
                            step.thickness_at(cell->active_cell_index(), box, at[0], at[1])},
                  std::as_const(x));
        }
        finish(cell);
    });
}
template <class Visit>
void for_each_point(const Space& space, const StepNumbers& step, const dealii::Quadrature<2>& quadrature,
                    const std::vector<Wanted>& wanted, const Visit& visit) {
    for_each_point(space, step, quadrature, wanted, visit, [](const Cell& /*cell*/) {});
}

}  // namespace endoflow::phasefield::production
