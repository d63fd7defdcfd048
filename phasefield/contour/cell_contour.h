#pragma once

#include <deal.II/fe/fe_q.h>

#include <array>

#include "phasefield/contour/chain.h"
#include "phasefield/fem/scalar_basis.h"
#include "phasefield/fem/space.h"

namespace endoflow::phasefield {

/// Where a curve and the fields on it are found: components of vectors on one mesh. `level_set` vanishes on the curve
/// and is positive on the extracellular side.
struct ContourFields {
    const Space* flow_space;
    const Vector* flow;
    unsigned int level_set, velocity_r, velocity_z, tension;
    double tension_factor;  // sharp tension = factor × tension
    const Space* molecule_space;
    const Vector* molecules;
    unsigned int concentration;
};

/// The pieces of the level set inside single cells: marching squares on a lattice of `subdivisions`² squares per cell,
/// with the end points found as roots of the polynomial along the lattice lines. Along a face with finer cells on its
/// other side the squares have those cells' lattice points as corners, too: else a level set nearly along the face
/// could cross it twice on one side and not at all on the other, and the curve would have a gap.
class CellContour {
  public:
    CellContour(const ContourFields& fields, unsigned int subdivisions);
    void add_segments(const dealii::DoFHandler<2>::active_cell_iterator& flow_cell,
                      std::vector<ContourSegment>& segments);

  private:
    struct Corner {
        double x, y;  // unit coordinates
        bool positive;
    };
    [[nodiscard]] double phi_at(double x, double y) const;
    [[nodiscard]] ContourPoint root(Corner a, Corner b) const;
    [[nodiscard]] ContourPoint point(double x, double y) const;
    [[nodiscard]] std::vector<Corner> corners(unsigned int i, unsigned int k) const;
    void add_square(unsigned int i, unsigned int k, std::vector<ContourSegment>& segments) const;

    ContourFields fields_;
    unsigned int subdivisions_;
    dealii::FE_Q<2> phi_element_, velocity_element_, tension_element_, molecule_element_;
    std::vector<std::vector<double>> lattice_shapes_;
    std::array<bool, 4> finer_beyond_{};  // left, right, lower, upper face
    CellBox box_{};
    dealii::Vector<double> flow_values_, molecule_values_;
    std::vector<double> phi_, u_r_, u_z_, lambda_, c_, lattice_;
};

}  // namespace endoflow::phasefield
