#include "phasefield/contour/parts_along.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <numeric>

#include "phasefield/contour/polyline.h"

namespace endoflow::phasefield {

namespace {

constexpr double slack = 0.05;  // of a part's cells, to either side of an equal cut

/// Of all processes together.
std::vector<double> gathered(const std::vector<double>& own, MPI_Comm communicator) {
    std::vector<double> out;
    for (const auto& of_process : dealii::Utilities::MPI::all_gather(communicator, own))
        out.insert(out.end(), of_process.begin(), of_process.end());
    return out;
}

/// Places of own cells, and of the two cells on either side of a face: the lower and the higher one, twice for each
/// face.
struct Places {
    std::vector<double> cells, below, above;
};

Places places_along(const MembraneCurve& membrane, const Space& space) {
    std::vector<double> along(membrane.size());  // the membrane, by its points
    std::iota(along.begin(), along.end(), 0.0);
    std::vector<double> of_cell(space.dofs.get_triangulation().n_active_cells());
    for (const auto& cell : space.dofs.active_cell_iterators()) {
        if (cell->is_artificial()) continue;
        const auto middle = cell->center();
        of_cell[cell->active_cell_index()] = at_closest_point(membrane.r, membrane.z, along, middle[0], middle[1]);
    }
    Places out;
    for (const auto& cell : space.dofs.active_cell_iterators()) {
        if (!cell->is_locally_owned()) continue;
        const double here = of_cell[cell->active_cell_index()];
        out.cells.push_back(here);
        for (const unsigned int face : cell->face_indices()) {
            if (cell->at_boundary(face) || cell->neighbor(face)->has_children()) continue;
            const double there = of_cell[cell->neighbor(face)->active_cell_index()];
            // A smaller cell's face is its own alone; one between equal cells is met from either side.
            for (int k = cell->neighbor_is_coarser(face) ? 0 : 1; k < 2; ++k) {
                out.below.push_back(std::min(here, there));
                out.above.push_back(std::max(here, there));
            }
        }
    }
    return out;
}

}  // namespace

std::vector<unsigned int> parts_along(const MembraneCurve& membrane, const Space& space) {
    const MPI_Comm communicator = space.dofs.get_communicator();
    const auto processes = dealii::Utilities::MPI::n_mpi_processes(communicator);
    if (processes == 1) return std::vector<unsigned int>(space.dofs.get_triangulation().n_active_cells(), 0);
    const Places own = places_along(membrane, space);
    auto cells = gathered(own.cells, communicator);
    std::sort(cells.begin(), cells.end());
    const auto below = gathered(own.below, communicator), above = gathered(own.above, communicator);
    const auto faces_met = [&](double cut) {
        std::size_t count = 0;
        for (std::size_t face = 0; face < below.size(); ++face) count += below[face] < cut && cut <= above[face];
        return count;
    };
    const double part = static_cast<double>(cells.size()) / processes;
    std::vector<double> cuts;
    for (unsigned int k = 1; k < processes; ++k) {
        const auto first = static_cast<std::size_t>((k - slack) * part),
                   last = static_cast<std::size_t>((k + slack) * part);
        const auto equal = static_cast<std::size_t>(k * part);
        double best = cells[equal];
        std::size_t fewest = faces_met(best);
        for (std::size_t i = first; i <= last; ++i) {
            const std::size_t met = faces_met(cells[i]);
            if (met < fewest) {
                fewest = met;
                best = cells[i];
            }
        }
        cuts.push_back(best);
    }
    std::vector<unsigned int> out;
    for (const double at : own.cells)
        out.push_back(static_cast<unsigned int>(std::upper_bound(cuts.begin(), cuts.end(), at) - cuts.begin()));
    return out;
}

}  // namespace endoflow::phasefield
