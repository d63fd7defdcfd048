#include "boundary_integral/fields/field_grid.h"

#include <algorithm>
#include <cmath>

#include "boundary_integral/fields/flow_field.h"
#include "boundary_integral/support/parallel.h"

namespace endoflow::boundary_integral {

namespace {

constexpr double margin_in_spacings = 1e-3;

std::vector<double> equidistant(double end, double spacing) {
    const auto cells = std::max(1L, std::lround(end / spacing));
    std::vector<double> values;
    for (long i = 0; i <= cells; ++i) values.push_back(end * static_cast<double>(i) / static_cast<double>(cells));
    return values;
}

}  // namespace

QuadGrid field_grid(const Parameters& parameters, const MembraneDynamics& dynamics, const MembraneState& state,
                    const FlowSolution& flow, const Eigen::VectorXd& wall_unknowns, double spacing) {
    const BoxFlow& box = *dynamics.box();
    const MembraneSamples samples = sample(dynamics.space(), state);
    const FlowField field(parameters, dynamics.space(), state, samples, {flow.velocity, flow.force}, box.walls(),
                          wall_unknowns);
    QuadGrid grid{equidistant(parameters.domain.radius, spacing), equidistant(parameters.domain.height, spacing), {}};
    const std::size_t columns = grid.x.size(), rows = grid.y.size();
    std::vector<double> velocity(3 * columns * rows), pressure(columns * rows), phi(columns * rows);
    parallel_parts(static_cast<Index>(rows), box.threads(), [&](Index begin, Index end) {
        RingLayers layers;
        for (auto j = static_cast<std::size_t>(begin); j < static_cast<std::size_t>(end); ++j) {
            for (std::size_t i = 0; i < columns; ++i) {
                const FieldValue value = field.at({grid.x[i], grid.y[j]}, margin_in_spacings * spacing, layers);
                const std::size_t point = j * columns + i;
                const bool outside = value.phase == Phase::extracellular;  // of the cell
                velocity[3 * point] = value.u_r;
                velocity[3 * point + 1] = value.u_z;
                pressure[point] = value.pressure + (outside ? parameters.fluid.pressure_difference : 0.0);
                phi[point] = outside ? 1.0 : -1.0;
            }
        }
    });
    grid.data = {
        {"velocity", 3, std::move(velocity)}, {"pressure", 1, std::move(pressure)}, {"phi", 1, std::move(phi)}};
    return grid;
}

}  // namespace endoflow::boundary_integral
