// A manufactured flow in the box: both fluids, the membrane between them, free walls and pin band.
//
// The exact velocity is that of two point forces on the axis outside the box, the same in both fluids; then the stress
// is nu_k times one field S, the membrane carries the force density f = (nu1 - nu2) S.n and the walls the traction t =
// nu_k S.m. Prescribed are f, t on the free walls, and u_z and t_r in the pin band. Wanted are u on the membrane, u on
// the free walls, and u_r and t_z in the band. The integrals of the prescribed wall data are the test's own.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "boundary_integral/flow/dense_solver.h"
#include "boundary_integral/operators/membrane_layers.h"
#include "boundary_integral/walls/wall_layers.h"
#include "curves.h"

namespace {

using namespace endoflow;
using namespace endoflow::boundary_integral;
using namespace endoflow::boundary_integral::testing;

using std::numbers::pi;

struct Meridional {
    double r, z;
};

// One point force of strength 8 pi mu along the axis.
struct PointForce {
    double height, strength;
};
const std::vector<PointForce> forces = {{230, 1}, {-50, -0.6}};  // nm; the box is 0 < z < 160

Meridional exact_velocity(double r, double z) {
    Meridional u{0, 0};
    for (const PointForce& force : forces) {
        const double dz = z - force.height, rho = std::hypot(r, dz);
        u.r += force.strength * r * dz / std::pow(rho, 3);
        u.z += force.strength * (1 / rho + dz * dz / std::pow(rho, 3));
    }
    return u;
}

// S.n for unit viscosity: T_ijk n_k = -6 x_i x_j x_k n_k/rho^5.
Meridional exact_traction(double r, double z, double normal_r, double normal_z) {
    Meridional t{0, 0};
    for (const PointForce& force : forces) {
        const double dz = z - force.height, rho = std::hypot(r, dz);
        const double factor = -6 * force.strength * dz * (r * normal_r + dz * normal_z) / std::pow(rho, 5);
        t.r += factor * r;
        t.z += factor * dz;
    }
    return t;
}

// What the prescribed wall data contribute at one place:
//     sum_k int_{wall k} t.G dS - sum_k nu_k PV int_band u_z e_z.T.m dS,   with t_z left out in the band.
// Intervals are halved towards the place until they are short against their distance from it: the integrands are
// smooth or logarithmic.
Meridional prescribed_part(const WallPanels& walls, const Target& at) {
    static const QuadratureRule rule = gauss_legendre(16);
    Meridional sum{0, 0};
    RingSources sources;
    RingKernels kernels;
    const auto interval = [&](const WallSegment& segment, double begin, double end) {
        sources.resize(rule.nodes.size());
        for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
            const double fraction = 0.5 * (begin + end) + 0.5 * (end - begin) * rule.nodes[i];
            const double r = segment.r_begin + fraction * (segment.r_end - segment.r_begin);
            const double z = segment.z_begin + fraction * (segment.z_end - segment.z_begin);
            sources.radius[i] = r;
            sources.delta_r[i] = r - at.r;
            sources.delta_z[i] = z - at.z;
            sources.normal_r[i] = segment.normal_r;
            sources.normal_offset[i] =
                segment.normal_r * (segment.r_begin - at.r) + segment.normal_z * (segment.z_begin - at.z);
        }
        evaluate_ring_kernels(at.r, sources, kernels);
        for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
            const double r = sources.radius[i], z = sources.delta_z[i] + at.z;
            const double measure = 0.5 * (end - begin) * rule.weights[i] * segment.length() * r * segment.viscosity;
            const Meridional t = exact_traction(r, z, segment.normal_r, segment.normal_z);
            sum.r += measure * t.r * kernels.single[0][0][i];
            sum.z += measure * t.r * kernels.single[1][0][i];
            if (segment.kind == WallKind::free) {
                sum.r += measure * t.z * kernels.single[0][1][i];
                sum.z += measure * t.z * kernels.single[1][1][i];
            } else {
                const double u_z = exact_velocity(r, z).z;
                sum.r -= measure * u_z * kernels.doubled[0][1][i];
                sum.z -= measure * u_z * kernels.doubled[1][1][i];
            }
        }
    };
    for (const WallSegment& segment : walls.segments()) {
        const double length = segment.length();
        const double along = std::clamp(((at.r - segment.r_begin) * (segment.r_end - segment.r_begin) +
                                         (at.z - segment.z_begin) * (segment.z_end - segment.z_begin)) /
                                            (length * length),
                                        0.0, 1.0);
        const double distance = std::hypot(segment.r_begin + along * (segment.r_end - segment.r_begin) - at.r,
                                           segment.z_begin + along * (segment.z_end - segment.z_begin) - at.z);
        const bool on_segment = distance < 1e-12 * length;
        const double shortest = on_segment ? 1e-12 : distance / length;
        for (const double side : {-1.0, 1.0}) {
            double reach = side < 0 ? along : 1 - along;
            for (; reach > shortest; reach *= 0.5) {
                const double from = along + side * 0.5 * reach, to = along + side * reach;
                interval(segment, std::min(from, to), std::max(from, to));
            }
            const double to = along + side * reach;
            if (reach > 0 && !on_segment) interval(segment, std::min(along, to), std::max(along, to));
        }
    }
    return sum;
}

struct Errors {
    double membrane_velocity, wall_velocity;  // relative to the largest velocity
    double band_traction;                     // relative to the largest traction in the band, edges left out
};

std::vector<LayerTarget> rows_of(const MembraneSpace& space, const MembraneState& state, const WallPanels& walls) {
    std::vector<LayerTarget> rows;
    Index next = 0;
    const double last = 1 - 0.05 * space.element_width();  // as in the engine: beside the rim
    const auto add = [&](double xi, bool radial) {
        const double beside = std::min(xi, radial ? last : 0.5 * (1 + last));
        const CurvePoint p = curve_point(space.radial().basis(beside), space.axial().basis(beside), state);
        rows.push_back({{p.r, p.z}, radial ? TargetRows{next, -1} : TargetRows{-1, next}, beside});
        ++next;
    };
    for (const double xi : space.radial().greville_points()) add(xi, true);
    for (const double xi : space.axial().greville_points()) add(xi, false);
    for (std::size_t i = 0; i < walls.nodes().size(); ++i) {
        rows.push_back({{walls.nodes()[i].r, walls.nodes()[i].z}, {next, next + 1}, -1, static_cast<Index>(i)});
        next += 2;
    }
    return rows;
}

Errors solve(Index elements, int nodes_per_panel) {
    const Parameters parameters;
    const double below = parameters.fluid.viscosity_extracellular, above = parameters.fluid.viscosity_intracellular;
    const MembraneSpace space(elements, 8);
    const MembraneState state = bulge(space, 40);
    const MembraneSamples samples = sample(space, state);
    const WallPanels walls(parameters.domain, parameters.fluid, nodes_per_panel);
    const Index on_curve = space.curve_count(), unknowns = on_curve + walls.unknowns();

    const std::vector<LayerTarget> rows = rows_of(space, state, walls);
    const MembraneLayers membrane = membrane_layers(space, state, samples, rows, unknowns, {});
    Eigen::MatrixXd matrix(unknowns, unknowns);
    matrix << (below - above) * membrane.doubled, wall_layers(walls, rows, unknowns);

    Eigen::VectorXd force(space.force_count());
    const auto force_at = [&](double xi) {
        const CurvePoint p = curve_point(space.radial().basis(xi), space.axial().basis(xi), state);
        const Meridional t = exact_traction(p.r, p.z, p.normal_r, p.normal_z);
        return Meridional{(below - above) * t.r, (below - above) * t.z};
    };
    force << spline_of(space.radial(), [&](double xi) { return force_at(xi).r; }),
        spline_of(space.force(), [&](double xi) { return force_at(xi).z; });
    Eigen::VectorXd right = membrane.single * force;

    for (const LayerTarget& row : rows) {
        const Index radial = row.rows.radial, axial = row.rows.axial;
        const Meridional prescribed = prescribed_part(walls, row.at);
        if (radial >= 0) right[radial] += prescribed.r;
        if (axial >= 0) right[axial] += prescribed.z;
        if (row.node < 0) {
            const bool is_radial = radial >= 0;
            const BasisRow basis = (is_radial ? space.radial() : space.axial()).basis(row.xi);
            for (std::size_t j = 0; j < 6; ++j) {
                matrix(is_radial ? radial : axial, (is_radial ? 0 : space.radial_count()) + basis.index[j]) +=
                    4 * pi * (below + above) * basis.value[0][j];
            }
        } else {
            const WallNode& node = walls.nodes()[static_cast<std::size_t>(row.node)];
            const double own = 4 * pi * walls.segments()[node.segment].viscosity;
            matrix(radial, on_curve + 2 * row.node) += own;
            if (walls.is_band(node)) {
                right[axial] -= own * exact_velocity(node.r, node.z).z;
            } else {
                matrix(axial, on_curve + 2 * row.node + 1) += own;
            }
        }
    }
    const Eigen::VectorXd solution = LuFactors(matrix, "box").solve(right);
    REQUIRE(solution.allFinite());

    Errors errors{0, 0, 0};
    double speed = 0, traction = 0;
    const Eigen::VectorXd u_r = solution.head(space.radial_count()),
                          u_z = solution.segment(space.radial_count(), space.axial_count());
    for (std::size_t i = 0; i < space.xi.size(); ++i) {
        const Meridional exact = exact_velocity(samples.curve[i].r, samples.curve[i].z);
        speed = std::max(speed, std::hypot(exact.r, exact.z));
        errors.membrane_velocity = std::max(
            errors.membrane_velocity,
            std::hypot(space.radial_rows[i].evaluate(u_r) - exact.r, space.axial_rows[i].evaluate(u_z) - exact.z));
    }
    for (const LayerTarget& row : rows) {
        if (row.node < 0) continue;
        const WallNode& node = walls.nodes()[static_cast<std::size_t>(row.node)];
        const WallSegment& segment = walls.segments()[node.segment];
        const Meridional exact = exact_velocity(node.r, node.z);
        const double first = solution[on_curve + 2 * row.node], second = solution[on_curve + 2 * row.node + 1];
        errors.wall_velocity = std::max(errors.wall_velocity, std::abs(first - exact.r));
        if (segment.kind == WallKind::free) {
            errors.wall_velocity = std::max(errors.wall_velocity, std::abs(second - exact.z));
        } else if (node.speed > 0.2 * segment.length()) {  // the unknown t_z ds/dtau vanishes at the edges
            const double t_z = segment.viscosity * exact_traction(node.r, node.z, segment.normal_r, segment.normal_z).z;
            traction = std::max(traction, std::abs(t_z));
            errors.band_traction = std::max(errors.band_traction, std::abs(second / node.speed - t_z));
        }
    }
    errors.membrane_velocity /= speed;
    errors.wall_velocity /= speed;
    errors.band_traction /= traction;
    return errors;
}

}  // namespace

TEST_CASE("a manufactured flow of both fluids in the box: the membrane's elements", "[verification]") {
    const Errors coarse = solve(16, 10), fine = solve(48, 10);
    CAPTURE(coarse.membrane_velocity, fine.membrane_velocity);
    CHECK(fine.membrane_velocity < 1e-8);
    CHECK(std::log(coarse.membrane_velocity / fine.membrane_velocity) / std::log(3) > 5);  // quintic splines: 6
}

TEST_CASE("a manufactured flow of both fluids in the box: the walls' panels", "[verification]") {
    const Errors coarse = solve(32, 4), fine = solve(32, 8);
    CAPTURE(coarse.wall_velocity, fine.wall_velocity, coarse.band_traction, fine.band_traction);
    // Spectral in the number of nodes: twice as many square the error, down to what the membrane's end at the rim
    // leaves.
    CHECK(fine.wall_velocity < 1e-6);
    CHECK(coarse.wall_velocity / fine.wall_velocity > 100);
    CHECK(fine.band_traction < 5e-5);
    CHECK(coarse.band_traction / fine.band_traction > 50);
}
