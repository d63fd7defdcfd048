#include "phasefield/contour/parts_along.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <numeric>

#include "phasefield/contour/polyline.h"

namespace endoflow::phasefield {

namespace {

constexpr double slack = 0.015;  // of a part's cells, to either side of an equal cut

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

/// How many of all cells cost this share of all operations, if cells of a part cost the same.
double share_of_cells(const std::vector<PartAlong>& parts, double share) {
    double all = 0;
    for (const PartAlong& part : parts) all += part.operations;
    if (!(all > 0)) return share;
    double cells = 0, left = share * all;
    for (const PartAlong& part : parts) {
        if (left < part.operations) return cells + part.cells * left / part.operations;
        cells += part.cells;
        left -= part.operations;
    }
    return cells;
}

}  // namespace

std::vector<unsigned int> parts_along(const MembraneCurve& membrane, const Space& space,
                                      const std::vector<PartAlong>& last) {
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
    const auto n_cells = static_cast<double>(cells.size());
    const double part = n_cells / processes;
    const auto index = [n_cells](double place) {
        return static_cast<std::size_t>(std::clamp(place, 0.0, n_cells - 1));  // the first and last parts may be small
    };
    std::vector<double> cuts;
    for (unsigned int k = 1; k < processes; ++k) {
        const double middle = share_of_cells(last, static_cast<double>(k) / processes) * n_cells;
        double best = cells[index(middle)];
        std::size_t fewest = faces_met(best);
        for (std::size_t i = index(middle - slack * part); i <= index(middle + slack * part); ++i) {
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

std::vector<PartAlong> measured_parts(const std::vector<unsigned int>& part_of_cell, double operations,
                                      const Space& space) {
    const MPI_Comm communicator = space.dofs.get_communicator();
    std::vector<double> cells(dealii::Utilities::MPI::n_mpi_processes(communicator));
    for (const unsigned int part : part_of_cell) cells[part] += 1;
    dealii::Utilities::MPI::sum(cells, communicator, cells);
    const auto all = static_cast<double>(space.dofs.get_triangulation().n_global_active_cells());
    const auto costs = dealii::Utilities::MPI::all_gather(communicator, operations);
    std::vector<PartAlong> out;
    for (std::size_t part = 0; part < cells.size(); ++part) out.push_back({cells[part] / all, costs[part]});
    return out;
}

}  // namespace endoflow::phasefield
