#pragma once

#include "phasefield/fem/space.h"

namespace endoflow::phasefield {

/// The cell as one of another space on the same mesh.
inline dealii::DoFHandler<2>::active_cell_iterator same_cell(const dealii::DoFHandler<2>::active_cell_iterator& cell,
                                                             const dealii::DoFHandler<2>& dofs) {
    return {&cell->get_triangulation(), cell->level(), cell->index(), &dofs};
}
inline dealii::DoFHandler<2>::active_cell_iterator same_cell(const dealii::DoFHandler<2>::active_cell_iterator& cell,
                                                             const Space& space) {
    return same_cell(cell, space.dofs);
}

}  // namespace endoflow::phasefield
