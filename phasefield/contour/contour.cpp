#include "phasefield/contour/contour.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

#include "shared/support/error.h"

namespace endoflow::phasefield {

namespace {

constexpr unsigned int subdivisions = 2;

/// Gathers every process's segments everywhere, in the order of the processes.
std::vector<ContourSegment> all_gather(const std::vector<ContourSegment>& mine, MPI_Comm communicator) {
    std::vector<ContourSegment> all;
    for (const auto& part : dealii::Utilities::MPI::all_gather(communicator, mine))
        all.insert(all.end(), part.begin(), part.end());
    return all;
}

MembraneCurve to_curve(const ContourChain& chain) {
    MembraneCurve curve;
    double s = 0;
    for (std::size_t i = 0; i < chain.size(); ++i) {
        const auto& p = chain[i];
        if (i > 0) s += distance_between(chain[i - 1], p);
        curve.s.push_back(s);
        curve.r.push_back(p.r);
        curve.z.push_back(p.z);
        curve.c.push_back(p.molecules);
        curve.lambda.push_back(p.tension);
        curve.kappa.push_back(p.curvature);
        curve.u_r.push_back(p.velocity_r);
        curve.u_z.push_back(p.velocity_z);
    }
    return curve;
}

}  // namespace

std::vector<ContourSegment> contour_segments(const ContourFields& fields) {
    CellContour cell_contour(fields, subdivisions);
    std::vector<ContourSegment> segments;
    for (const auto& cell : fields.flow_space->dofs.active_cell_iterators())
        if (cell->is_locally_owned()) cell_contour.add_segments(cell, segments);
    return all_gather(segments, fields.flow_space->dofs.get_communicator());
}

Contour extract_contour(const ContourFields& fields, const Parameters& p) {
    const auto segments = contour_segments(fields);
    const double R = p.domain.radius, tolerance = 1e-7 * p.phase_field.cell_size;
    const bool closed = p.domain.kind == DomainKind::free_space;
    auto chains = join_segments(segments, tolerance);
    const auto on_axis = [&](const ContourPoint& point) { return std::abs(point.r) < tolerance; };
    const auto on_rim = [&](const ContourPoint& point) { return std::abs(point.r - R) < tolerance; };
    for (auto& chain : chains) {
        const bool backwards = closed ? chain.front().z < chain.back().z : on_rim(chain.front());
        if (backwards) std::reverse(chain.begin(), chain.end());
        if (!on_axis(chain.front()) || !(closed ? on_axis(chain.back()) : on_rim(chain.back()))) continue;
        chain.front().r = 0;
        if (closed) chain.back().r = 0;
        const double spacing = 0.4 * p.phase_field.cell_size / subdivisions;
        return {to_curve(thin_out(chain, spacing)), static_cast<unsigned int>(chains.size())};
    }
    throw SolverError("membrane-lost",
                      closed ? "the level set φ = 0 does not lead from pole to pole"
                             : "the level set φ = 0 does not connect the rim with the axis",
                      "use a smaller phase_field.cell_size or time.max_step");
}

std::vector<PlanePoint> positions(const MembraneCurve& curve) {
    std::vector<PlanePoint> out;
    for (std::size_t i = 0; i < curve.size(); ++i) out.push_back({curve.r[i], curve.z[i]});
    return out;
}

}  // namespace endoflow::phasefield
