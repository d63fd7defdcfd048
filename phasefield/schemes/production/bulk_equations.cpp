#include "phasefield/schemes/production/bulk_equations.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>

#include "phasefield/fem/component_field.h"
#include "phasefield/fem/local_system.h"
#include "phasefield/fem/reduction.h"
#include "phasefield/layer/boundary_flux.h"
#include "phasefield/schemes/production/assembly.h"

namespace endoflow::phasefield::production {

namespace {

constexpr double bulk_floor = constant("bulk_floor");
constexpr double supply_alignment = constant("supply_alignment");

using Cell = dealii::DoFHandler<2>::active_cell_iterator;

/// χ of the fluid that has the molecules.
double bulk_indicator(double phi, const BulkNumbers& numbers) {
    return 0.5 + numbers.sign * membrane_indicator(phi, {}) + bulk_floor;  // of δ itself
}

/// What the bulk's equations ask for at one quadrature point; `measure` is r dr dz.
struct BulkPoint {
    double measure, indicator, velocity_r, velocity_z;
    double delta, surface;  // δ, and with its floor [1/nm]
    double alignment;       // 1000 ε² [nm²]
    Direction normal;
    double coming, by_supply;  // j [1/µs] and its derivative by c_b/c_∞
};

class BulkPoints {
  public:
    BulkPoints(const BulkProblem& problem, BulkExchange exchange, const dealii::Quadrature<2>& quadrature)
        : problem_(&problem),
          exchange_(exchange),
          quadrature_(&quadrature),
          psi_(*problem.space, distance, quadrature),
          velocity_r_(*problem.space, production::velocity_r, quadrature),
          velocity_z_(*problem.space, production::velocity_z, quadrature),
          molecules_(*problem.space, molecule_density, quadrature),
          moment_(*problem.space, moment, quadrature),
          supply_(problem.step->supply, quadrature) {}

    /// Valid until the next call.
    const std::vector<BulkPoint>& on(const Cell& cell, const CellBox& box) {
        const StepNumbers& step = *problem_->step;
        const Vector& x = *problem_->membrane;
        const auto &psi = psi_.on(cell, box, x), &ur = velocity_r_.on(cell, box, x), &uz = velocity_z_.on(cell, box, x),
                   &c = molecules_.on(cell, box, x), &b = moment_.on(cell, box, x);
        const auto& supply = supply_.on(cell, box);
        points_.clear();
        for (unsigned int q = 0; q < quadrature_->size(); ++q) {
            const auto& at = quadrature_->point(q);
            const double r = box.r0 + box.hr * at[0];
            const PointThickness thickness = step.thickness_at(cell->active_cell_index(), box, at[0], at[1]);
            const double epsilon = thickness.value;
            const auto layer = layer_profile(psi.value[q], epsilon);
            const double length = std::max(std::hypot(psi.r[q], psi.z[q]), constant("shortest_gradient"));
            BulkPoint point{quadrature_->weight(q) * box.hr * box.hz * r,
                            bulk_indicator(layer.phi, *problem_->numbers),
                            ur.value[q],
                            uz.value[q],
                            layer.delta,
                            layer.delta + surface_floor / epsilon,
                            supply_alignment * epsilon * epsilon,
                            {psi.r[q] / length, psi.z[q] / length},
                            0,
                            0};
            const auto sheet = sheet_gradient(AtPoint<double>{psi.value[q], psi.r[q], psi.z[q]}, thickness);
            const double slope = (c.z[q] * sheet.r - c.r[q] * sheet.z) / std::hypot(sheet.r, sheet.z, gradient_floor);
            set_exchange(b.value[q], c.value[q], slope, sheet_curvature(psi.r[q], r, epsilon).scaled, epsilon,
                         supply[q], point);
            points_.push_back(point);
        }
        return points_;
    }

  private:
    /// j at given moment b, c, t·∇c and c_b/c_∞. One that is implicit takes molecules at a rate that falls with c_b
    /// alone: c, which then is extrapolated, must not be beyond 1.
    void set_exchange(double b, double c, double slope, double around, double epsilon, double supply,
                      BulkPoint& point) const {
        const StepNumbers& step = *problem_->step;
        const LayerEnergy& energy = *problem_->energy;
        const bool implicit = exchange_ == BulkExchange::implicit;
        const double covered = implicit ? std::clamp(c, 0.0, 1.0) : c;
        const auto state = sheet_state(energy, b, covered, slope, around, epsilon);
        const auto rate = step.exchange.rate<Dual<1>>(covered, bending_by_concentration(energy, state, covered),
                                                      step.molecules, Dual<1>::variable(implicit ? 1 : supply, 0));
        point.coming = rate.value;
        point.by_supply = implicit ? rate.partial[0] : 0;
    }

    const BulkProblem* problem_;
    BulkExchange exchange_;
    const dealii::Quadrature<2>* quadrature_;
    ComponentField psi_, velocity_r_, velocity_z_, molecules_, moment_;
    SupplyAtPoints supply_;
    std::vector<BulkPoint> points_;
};

/// Faces of cells on walls, with what flows through them.
class BulkWalls {
  public:
    explicit BulkWalls(const BulkProblem& problem) : problem_(&problem), n_(problem.bulk->degrees[depletion] + 2) {
        for (unsigned int number = 0; number < 4; ++number) {
            const auto quadrature = face_quadrature(number, n_);
            faces_.push_back({quadrature,
                              ComponentField(*problem.space, number < 2 ? velocity_r : velocity_z, quadrature),
                              ComponentField(*problem.space, distance, quadrature),
                              ComponentField(*problem.bulk, depletion, quadrature),
                              ScalarBasis(problem.bulk->degrees[depletion], quadrature)});
        }
    }

    /// Calls visit(face, q, measure, χ, u·n_w) at the points on the walls of a cell; measure is r times the length.
    template <class Visit>
    void on(const Cell& cell, const CellBox& box, const Visit& visit) {
        if (!cell->at_boundary()) return;
        const StepNumbers& step = *problem_->step;
        for (const unsigned int number : cell->face_indices()) {
            if (!cell->face(number)->at_boundary() || cell->face(number)->boundary_id() == Boundary::axis) continue;
            Face& face = faces_[number];
            const auto &psi = face.distance.on(cell, box, *problem_->membrane),
                       &velocity = face.velocity.on(cell, box, *problem_->membrane);
            const double outward = number % 2 == 1 ? 1 : -1, length = number < 2 ? box.hz : box.hr;
            for (unsigned int q = 0; q < n_; ++q) {
                const auto& at = face.quadrature.point(q);
                const double epsilon = step.thickness_at(cell->active_cell_index(), box, at[0], at[1]).value;
                const double r = box.r0 + box.hr * at[0];
                visit(face, q, r * length * face.quadrature.weight(q),
                      bulk_indicator(equilibrium_profile(psi.value[q], epsilon), *problem_->numbers),
                      outward * velocity.value[q]);
            }
        }
    }

    struct Face {
        dealii::Quadrature<2> quadrature;
        ComponentField velocity, distance, depletion;
        ScalarBasis basis;
    };

  private:
    const BulkProblem* problem_;
    unsigned int n_;
    std::vector<Face> faces_;
};

unsigned int bulk_gauss_points(const BulkProblem& problem) {
    return gauss_points(problem.step->numerics);
}

/// Fluid that comes in brings c_∞, and beyond the walls there is c_∞ after the length ℓ.
void add_walls(const BulkProblem& problem, BulkWalls& walls, const Cell& cell, const CellBox& box,
               dealii::FullMatrix<double>& matrix) {
    const auto& rows = problem.bulk->local[depletion];
    walls.on(cell, box, [&](BulkWalls::Face& face, unsigned int q, double measure, double indicator, double outflow) {
        const double weight = measure * indicator * (std::max(-outflow, 0.0) + problem.numbers->exchange_with_outside);
        const double* shape = &face.basis.value[q * face.basis.n_dofs];
        for (std::size_t i = 0; i < rows.size(); ++i)
            for (std::size_t k = 0; k < rows.size(); ++k) matrix(rows[i], rows[k]) += weight * shape[i] * shape[k];
    });
}

}  // namespace

void assemble_bulk(const BulkProblem& problem, BulkExchange exchange, const Vector& past, LinearSystem& system) {
    const Space& bulk = *problem.bulk;
    const BulkNumbers& numbers = *problem.numbers;
    const dealii::QGauss<2> quadrature(bulk_gauss_points(problem));
    BulkPoints at_points(problem, exchange, quadrature);
    BulkWalls walls(problem);
    LocalSystem local(bulk, quadrature);
    const unsigned int n = bulk.element.n_dofs_per_cell(), n_points = quadrature.size();
    dealii::FullMatrix<double> matrix(n, n);
    dealii::Vector<double> right_hand_side(n), values(n);
    std::vector<dealii::types::global_dof_index> indices(n);
    // d's row: χ (a₀ d + past + u·∇d), χD∇d, and what the exchange takes; d̄'s row: s (d̄ − d), 1000 ε² s n n·∇d̄.
    Coefficients changing(n_points), carried_r(n_points), carried_z(n_points), conducting(n_points), taking(n_points),
        source(n_points), seen(n_points), unseen(n_points), rr(n_points), rz(n_points), zz(n_points);
    system.start();
    for (const auto& cell : problem.space->dofs.active_cell_iterators()) {
        if (!cell->is_locally_owned()) continue;
        const CellBox box = cell_box(cell);
        const auto bulk_cell = same_cell(cell, bulk);
        bulk_cell->get_dof_values(past, values);
        local.start(box, values);
        const auto& before = local.field(depletion).value;
        const auto& points = at_points.on(cell, box);
        for (unsigned int q = 0; q < n_points; ++q) {
            const BulkPoint& p = points[q];
            const double fluid = p.measure * p.indicator, layer = p.measure * p.delta / numbers.coat;
            changing[q] = fluid * problem.step->rate;
            carried_r[q] = fluid * p.velocity_r;
            carried_z[q] = fluid * p.velocity_z;
            conducting[q] = fluid * numbers.diffusivity;
            taking[q] = layer * p.by_supply;
            source[q] = fluid * before[q] - layer * p.coming;
            seen[q] = p.measure * p.surface;
            unseen[q] = -seen[q];
            const double aligning = seen[q] * p.alignment;
            rr[q] = aligning * p.normal.r * p.normal.r;
            rz[q] = aligning * p.normal.r * p.normal.z;
            zz[q] = aligning * p.normal.z * p.normal.z;
        }
        local.jacobian(depletion, Op::value, depletion, {&changing, &carried_r, &carried_z});
        local.jacobian(depletion, Op::dr, depletion, {nullptr, &conducting, nullptr});
        local.jacobian(depletion, Op::dz, depletion, {nullptr, nullptr, &conducting});
        local.jacobian(depletion, Op::value, depletion_at_membrane, Op::value, taking);
        local.jacobian(depletion_at_membrane, Op::value, depletion_at_membrane, Op::value, seen);
        local.jacobian(depletion_at_membrane, Op::value, depletion, Op::value, unseen);
        local.jacobian(depletion_at_membrane, Op::dr, depletion_at_membrane, {nullptr, &rr, &rz});
        local.jacobian(depletion_at_membrane, Op::dz, depletion_at_membrane, {nullptr, &rz, &zz});
        local.residual(depletion, Op::value, source);
        local.write(matrix, right_hand_side);
        add_walls(problem, walls, cell, box, matrix);
        bulk_cell->get_dof_indices(indices);
        bulk.constraints.distribute_local_to_global(matrix, right_hand_side, indices, system.matrix,
                                                    system.right_hand_side);
    }
}

void assemble_unit_exchange(const BulkProblem& problem, LinearSystem& system) {
    const Space& bulk = *problem.bulk;
    const dealii::QGauss<2> quadrature(bulk_gauss_points(problem));
    ComponentField psi(*problem.space, distance, quadrature);
    LocalSystem local(bulk, quadrature);
    const unsigned int n = bulk.element.n_dofs_per_cell();
    dealii::Vector<double> right_hand_side(n), zero(n);
    std::vector<dealii::types::global_dof_index> indices(n);
    Coefficients source(quadrature.size());
    system.right_hand_side = 0;
    for (const auto& cell : problem.space->dofs.active_cell_iterators()) {
        if (!cell->is_locally_owned()) continue;
        const CellBox box = cell_box(cell);
        local.start(box, zero);
        const auto& position = psi.on(cell, box, *problem.membrane);
        for (unsigned int q = 0; q < quadrature.size(); ++q) {
            const auto& at = quadrature.point(q);
            const double epsilon = problem.step->thickness_at(cell->active_cell_index(), box, at[0], at[1]).value;
            const double r = box.r0 + box.hr * at[0];
            source[q] = -quadrature.weight(q) * box.hr * box.hz * r / problem.numbers->coat *
                        layer_profile(position.value[q], epsilon).delta;
        }
        local.residual(depletion, Op::value, source);
        local.write_residual(right_hand_side);
        same_cell(cell, bulk)->get_dof_indices(indices);
        bulk.constraints.distribute_local_to_global(right_hand_side, indices, system.right_hand_side);
    }
}

BulkIntegrals integrate_bulk(const BulkProblem& problem, const Vector& solution) {
    const BulkNumbers& numbers = *problem.numbers;
    const dealii::QGauss<2> quadrature(bulk_gauss_points(problem));
    ComponentField psi(*problem.space, distance, quadrature), missing(*problem.bulk, depletion, quadrature),
        seen(*problem.bulk, depletion_at_membrane, quadrature);
    BulkWalls walls(problem);
    BulkIntegrals out;
    for (const auto& cell : problem.space->dofs.active_cell_iterators()) {
        if (!cell->is_locally_owned()) continue;
        const CellBox box = cell_box(cell);
        const auto bulk_cell = same_cell(cell, *problem.bulk);
        const auto &position = psi.on(cell, box, *problem.membrane), &d = missing.on(bulk_cell, box, solution),
                   &at_membrane = seen.on(bulk_cell, box, solution);
        for (unsigned int q = 0; q < quadrature.size(); ++q) {
            const auto& at = quadrature.point(q);
            const double epsilon = problem.step->thickness_at(cell->active_cell_index(), box, at[0], at[1]).value;
            const auto layer = layer_profile(position.value[q], epsilon);
            const double w = two_pi * quadrature.weight(q) * box.hr * box.hz * (box.r0 + box.hr * at[0]);
            const double fluid = w * bulk_indicator(layer.phi, numbers);
            out.missing += numbers.coat * fluid * d.value[q];
            out.molecules += numbers.concentration * fluid * (1 - d.value[q]);
            out.area += w * layer.delta;
            out.at_membrane += w * layer.delta * (1 - at_membrane.value[q]);
        }
        walls.on(cell, box,
                 [&](BulkWalls::Face& face, unsigned int q, double measure, double indicator, double outflow) {
                     const double depleted = face.depletion.on(bulk_cell, box, solution).value[q];
                     out.leaving += two_pi * measure * numbers.coat * indicator *
                                    (std::max(outflow, 0.0) + numbers.exchange_with_outside) * depleted;
                 });
    }
    sum_over_processes({&out.missing, &out.leaving, &out.molecules, &out.area, &out.at_membrane},
                       problem.space->dofs.get_communicator());
    return out;
}

}  // namespace endoflow::phasefield::production
