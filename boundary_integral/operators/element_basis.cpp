#include "boundary_integral/operators/element_basis.h"

#include <utility>

namespace endoflow::boundary_integral {

void BasisTable::clear() {
    functions_.clear();
    values_.clear();
}

void BasisTable::begin_element(const BasisRow& row) {
    Functions functions{row.index, true};
    for (std::size_t j = 1; j < BasisRow::capacity; ++j) {
        if (row.index[j] != row.index[0] + static_cast<Index>(j)) functions.consecutive = false;
    }
    functions_.push_back(functions);
}

void BasisTable::add(const BasisRow& row) {
    values_.insert(values_.end(), row.value[0].begin(), row.value[0].end());
    values_.insert(values_.end(), basis_stride - BasisRow::capacity, 0.0);
}

void BasisTable::scatter(std::size_t element, const double* sums, double* row) const {
    const Functions& functions = functions_[element];
    if (functions.consecutive) {
        double* begin = row + functions.index[0];
        for (std::size_t j = 0; j < BasisRow::capacity; ++j) begin[j] += sums[j];
    } else {
        for (std::size_t j = 0; j < BasisRow::capacity; ++j) row[functions.index[j]] += sums[j];
    }
}

void ElementBasis::clear() {
    radial.clear();
    axial.clear();
    force.clear();
}

void ElementBasis::add(const BasisRow& radial_row, const BasisRow& axial_row, const BasisRow& force_row,
                       bool first_of_element) {
    if (first_of_element) {
        radial.begin_element(radial_row);
        axial.begin_element(axial_row);
        force.begin_element(force_row);
    }
    radial.add(radial_row);
    axial.add(axial_row);
    force.add(force_row);
}

OwnElements own_elements(const MembraneSpace& space, double xi, const QuadratureRule& base) {
    constexpr double slack = 1e-12;
    OwnElements result;
    for (Index element = 0; element < space.elements(); ++element) {
        const double begin = static_cast<double>(element) * space.element_width();
        const double end = begin + space.element_width();
        if (xi < begin - slack || xi > end + slack) continue;
        OwnElement own;
        own.element = element;
        own.rule = logarithmic_rule(begin, end, xi, base);
        for (std::size_t i = 0; i < own.rule.offsets.size(); ++i) {
            const double at = own.rule.origin + own.rule.offsets[i];
            own.radial_rows.push_back(space.radial().basis(at, element));
            own.axial_rows.push_back(space.axial().basis(at, element));
            own.basis.add(own.radial_rows.back(), own.axial_rows.back(), space.force().basis(at), i == 0);
        }
        result.push_back(std::move(own));
    }
    return result;
}

}  // namespace endoflow::boundary_integral
