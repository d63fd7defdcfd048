#pragma once

// The three bases of velocities and forces at the points of one element, laid out for point_sums.

#include <array>
#include <vector>

#include "boundary_integral/kernels/point_sums.h"
#include "boundary_integral/membrane/membrane_space.h"
#include "boundary_integral/quadrature/singular_rules.h"

namespace endoflow::boundary_integral {

/// Values of one spline space at points of one or several elements.
class BasisTable {
  public:
    void clear();
    /// The points of one element must follow each other; the first one of an element gives the functions' indices.
    void begin_element(const BasisRow& row);
    void add(const BasisRow& row);

    [[nodiscard]] const double* values() const { return values_.data(); }
    /// row[index of function j] += sums[j]
    void scatter(std::size_t element, const double* sums, double* row) const;

  private:
    struct Functions {
        std::array<Index, BasisRow::capacity> index;
        bool consecutive;
    };
    std::vector<Functions> functions_;
    std::vector<double> values_;
};

struct ElementBasis {
    BasisTable radial, axial, force;

    void clear();
    void add(const BasisRow& radial_row, const BasisRow& axial_row, const BasisRow& force_row, bool first_of_element);
};

/// Everything about the quadrature over the elements that hold a target of fixed parameter: it does not change as the
/// membrane moves.
struct OwnElement {
    Index element = 0;
    OffsetRule rule;
    std::vector<BasisRow> radial_rows, axial_rows;
    ElementBasis basis;
};
using OwnElements = std::vector<OwnElement>;

[[nodiscard]] OwnElements own_elements(const MembraneSpace& space, double xi, const QuadratureRule& base);

}  // namespace endoflow::boundary_integral
