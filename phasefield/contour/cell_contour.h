#pragma once

#include <deal.II/fe/fe_q.h>

#include "phasefield/contour/chain.h"
#include "phasefield/monolithic/coupled_step.h"

namespace endoflow::phasefield {

/// The pieces of φ = 0 inside single cells: marching squares on a lattice of `subdivisions`² squares per cell, with the
/// end points found as roots of the polynomial φ along the lattice lines.
class CellContour {
  public:
    CellContour(const Spaces& spaces, unsigned int subdivisions);
    void add_segments(const dealii::DoFHandler<2>::active_cell_iterator& flow_cell, const State& state,
                      std::vector<ContourSegment>& segments);

  private:
    struct Edge {
        double x0, y0, x1, y1;  // unit coordinates
    };
    [[nodiscard]] double phi_at(double x, double y) const;
    [[nodiscard]] ContourPoint root(const Edge& edge) const;
    [[nodiscard]] ContourPoint point(double x, double y) const;
    void add_square(unsigned int i, unsigned int k, std::vector<ContourSegment>& segments) const;

    const Spaces* spaces_;
    unsigned int subdivisions_;
    dealii::FE_Q<2> phi_element_, velocity_element_, tension_element_, molecule_element_;
    std::vector<std::vector<double>> lattice_shapes_;
    CellBox box_{};
    dealii::Vector<double> flow_values_, molecule_values_;
    std::vector<double> phi_, u_r_, u_z_, lambda_, c_, lattice_;
};

}  // namespace endoflow::phasefield
