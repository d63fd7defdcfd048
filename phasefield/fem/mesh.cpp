#include "phasefield/fem/mesh.h"

#include <deal.II/grid/grid_generator.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "phasefield/fem/flow_domain.h"

namespace endoflow::phasefield {

namespace {

/// Cells of the coarse mesh in the directions r and z.
std::vector<unsigned int> coarse_cells(const Parameters& p) {
    if (!(p.phase_field.cell_size > 0)) throw std::invalid_argument("coarse mesh: the cell size has not been chosen");
    const FlowDomain domain = flow_domain(p);
    const double size = p.phase_field.cell_size * std::exp2(layer_level(p));
    const auto cells = [size](double length, unsigned int multiple) {
        return multiple * std::max(1u, static_cast<unsigned int>(std::lround(length / (size * multiple))));
    };
    return {cells(domain.radius, 1), cells(domain.top - domain.bottom, 2)};
}

}  // namespace

double layer_cell_size(const Parameters& p) {
    const auto cells = coarse_cells(p);
    const FlowDomain domain = flow_domain(p);
    return std::max(domain.radius / cells[0], (domain.top - domain.bottom) / cells[1]) / std::exp2(layer_level(p));
}

std::unique_ptr<Mesh> coarse_mesh(const Parameters& p, MPI_Comm communicator) {
    auto mesh = std::make_unique<Mesh>(communicator, dealii::Triangulation<2>::limit_level_difference_at_vertices);
    const FlowDomain domain = flow_domain(p);
    dealii::GridGenerator::subdivided_hyper_rectangle(*mesh, coarse_cells(p), dealii::Point<2>(0, domain.bottom),
                                                      dealii::Point<2>(domain.radius, domain.top), true);
    return mesh;
}

double distance_from_band(const CellBox& box, const RefinedBand& band) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& [at, reach] : band.points) {
        const double dr = std::max({box.r0 - at.r, at.r - box.r0 - box.hr, 0.0});
        const double dz = std::max({box.z0 - at.z, at.z - box.z0 - box.hz, 0.0});
        nearest = std::min(nearest, std::hypot(dr, dz) - reach);
    }
    return nearest;
}

bool flag_bands(Mesh& mesh, const std::vector<RefinedBand>& bands) {
    for (const auto& cell : mesh.active_cell_iterators()) {
        if (!cell->is_locally_owned()) continue;
        const CellBox box = cell_box(cell);
        const auto level = static_cast<unsigned int>(cell->level());
        bool refine = false, keep = level == 0;
        for (const auto& band : bands) {
            if (band.level < level) continue;
            const double distance = distance_from_band(box, band);
            refine = refine || (band.level > level && distance < 0);
            keep = keep || distance <= band.slack;
        }
        if (refine)
            cell->set_refine_flag();
        else if (!keep)
            cell->set_coarsen_flag();
    }
    mesh.prepare_coarsening_and_refinement();
    bool changes = false;
    for (const auto& cell : mesh.active_cell_iterators())
        changes = changes || (cell->is_locally_owned() && (cell->refine_flag_set() || cell->coarsen_flag_set()));
    return dealii::Utilities::MPI::max(changes ? 1 : 0, mesh.get_communicator()) == 1;
}

}  // namespace endoflow::phasefield
