#include "phasefield/schemes/production/bulk_equations.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>

#include "phasefield/fem/component_field.h"
#include "phasefield/fem/local_system.h"
#include "phasefield/fem/reduction.h"
#include "phasefield/layer/boundary_flux.h"
#include "phasefield/schemes/production/assembly.h"
#include "phasefield/schemes/production/cell_points.h"

namespace endoflow::phasefield::production {

namespace {

constexpr double bulk_floor = constant("bulk_floor");

/// χ of the fluid that has the molecules.
double bulk_indicator(double phi, const BulkNumbers& numbers) {
    return 0.5 + numbers.sign * membrane_indicator(phi, {}) + bulk_floor;  // of δ itself
}

/// What the bulk's equations ask for at one quadrature point.
struct BulkPoint {
    double indicator, velocity_r, velocity_z;
    double delta, floored;  // δ, and with its floor [1/nm]
    double alignment;       // 1000 ε² [nm²]
    Direction normal;
    double coming, by_supply;  // j [1/µs] and its derivative by c_b/c_∞
};

/// Of the membrane's fields `x`; c_b/c_∞ is `supply`. A j that is implicit takes molecules at a rate that falls with
/// c_b alone: c, which then is extrapolated, must not be beyond 1.
BulkPoint bulk_point(const BulkProblem& problem, BulkExchange exchange, const CellPoint& at, const Fields<double>& x,
                     double supply) {
    const StepNumbers& step = *problem.step;
    const LayerEnergy& energy = *problem.energy;
    const auto &psi = x[distance], &c = x[molecule_density];
    const double epsilon = at.thickness.value;
    const auto layer = layer_profile(psi.value, epsilon);
    const double length = std::max(std::hypot(psi.r, psi.z), constant("shortest_gradient"));
    const bool implicit = exchange == BulkExchange::implicit;
    const double covered = implicit ? std::clamp(c.value, 0.0, 1.0) : c.value;
    const double along = along_sheet(c, sheet_normal(psi, at.thickness).N_epsilon);
    const auto state =
        sheet_state(energy, sheet_point(energy, x[moment].value, covered, along, psi.r, at.r, epsilon), epsilon);
    const auto j = step.exchange.rate<Dual<1>>(
        covered, bending_by_concentration(energy, state.curvature, state.by_concentration, covered), step.molecules,
        Dual<1>::variable(implicit ? 1 : supply, 0));
    return {bulk_indicator(layer.phi, *problem.numbers),
            x[velocity_r].value,
            x[velocity_z].value,
            layer.delta,
            layer.delta + surface_floor / epsilon,
            strong_alignment * epsilon * epsilon,
            {psi.r / length, psi.z / length},
            j.value,
            implicit ? j.partial[0] : 0};
}

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
    const Space &bulk = *problem.bulk, &space = *problem.space;
    const BulkNumbers& numbers = *problem.numbers;
    const StepNumbers& step = *problem.step;
    const dealii::QGauss<2> quadrature(bulk_gauss_points(problem));
    BulkWalls walls(problem);
    LocalSystem local(bulk, quadrature);
    const unsigned int n = bulk.element.n_dofs_per_cell(), n_points = quadrature.size();
    dealii::FullMatrix<double> matrix(n, n);
    dealii::Vector<double> right_hand_side(n), values(n);
    std::vector<dealii::types::global_dof_index> indices(n);
    // d's row: χ (a₀ d + past + u·∇d), χD∇d, and what the exchange takes; d̄'s row: s (d̄ − d), 1000 ε² s N N·∇d̄.
    Coefficients changing(n_points), carried_r(n_points), carried_z(n_points), conducting(n_points), taking(n_points),
        source(n_points), seen(n_points), unseen(n_points), rr(n_points), rz(n_points), zz(n_points);
    std::vector<Wanted> wanted{{&space, problem.membrane, {velocity_r, velocity_z, distance, molecule_density, moment}},
                               {&bulk, &past, {depletion}}};
    if (step.supply) wanted.push_back({step.supply->space, &step.supply->values, {depletion_at_membrane}});
    const auto add_point = [&](const CellPoint& at, const auto& x) {
        const unsigned int q = at.q;
        const double supply = step.supply ? 1 - x[2][depletion_at_membrane].value : 1;
        const BulkPoint p = bulk_point(problem, exchange, at, x[0], supply);
        const double measure = at.measure / two_pi, fluid = measure * p.indicator;
        const double layer = measure * p.delta / numbers.coat;
        changing[q] = fluid * step.rate;
        carried_r[q] = fluid * p.velocity_r;
        carried_z[q] = fluid * p.velocity_z;
        conducting[q] = fluid * numbers.diffusivity;
        taking[q] = layer * p.by_supply;
        source[q] = fluid * x[1][depletion].value - layer * p.coming;
        seen[q] = measure * p.floored;
        unseen[q] = -seen[q];
        const double aligning = seen[q] * p.alignment;
        rr[q] = aligning * p.normal.r * p.normal.r;
        rz[q] = aligning * p.normal.r * p.normal.z;
        zz[q] = aligning * p.normal.z * p.normal.z;
    };
    const auto add_cell = [&](const Cell& cell) {
        const CellBox box = cell_box(cell);
        local.start(box, values);
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
        same_cell(cell, bulk)->get_dof_indices(indices);
        bulk.constraints.distribute_local_to_global(matrix, right_hand_side, indices, system.matrix,
                                                    system.right_hand_side);
    };
    system.start();
    for_each_point(space, step, quadrature, wanted, add_point, add_cell);
}

void assemble_unit_exchange(const BulkProblem& problem, LinearSystem& system) {
    const Space& bulk = *problem.bulk;
    const dealii::QGauss<2> quadrature(bulk_gauss_points(problem));
    LocalSystem local(bulk, quadrature);
    const unsigned int n = bulk.element.n_dofs_per_cell();
    dealii::Vector<double> right_hand_side(n), zero(n);
    std::vector<dealii::types::global_dof_index> indices(n);
    Coefficients source(quadrature.size());
    system.right_hand_side = 0;
    for_each_point(
        *problem.space, *problem.step, quadrature, {{problem.space, problem.membrane, {distance}}},
        [&](const CellPoint& at, const auto& x) {
            const double delta = layer_profile(x[0][distance].value, at.thickness.value).delta;
            source[at.q] = -at.measure / two_pi / problem.numbers->coat * delta;
        },
        [&](const Cell& cell) {
            local.start(cell_box(cell), zero);
            local.residual(depletion, Op::value, source);
            local.write_residual(right_hand_side);
            same_cell(cell, bulk)->get_dof_indices(indices);
            bulk.constraints.distribute_local_to_global(right_hand_side, indices, system.right_hand_side);
        });
}

BulkIntegrals integrate_bulk(const BulkProblem& problem, const Vector& solution) {
    const BulkNumbers& numbers = *problem.numbers;
    const dealii::QGauss<2> quadrature(bulk_gauss_points(problem));
    BulkWalls walls(problem);
    BulkIntegrals out;
    for_each_point(
        *problem.space, *problem.step, quadrature,
        {{problem.space, problem.membrane, {distance}}, {problem.bulk, &solution, {depletion, depletion_at_membrane}}},
        [&](const CellPoint& at, const auto& x) {
            const auto layer = layer_profile(x[0][distance].value, at.thickness.value);
            const double fluid = at.measure * bulk_indicator(layer.phi, numbers), d = x[1][depletion].value;
            out.missing += numbers.coat * fluid * d;
            out.molecules += numbers.concentration * fluid * (1 - d);
            out.area += at.measure * layer.delta;
            out.at_membrane += at.measure * layer.delta * (1 - x[1][depletion_at_membrane].value);
        });
    for_each_cell(*problem.space, [&](const Cell& cell, const CellBox& box) {
        walls.on(cell, box,
                 [&](BulkWalls::Face& face, unsigned int q, double measure, double indicator, double outflow) {
                     const double depleted = face.depletion.on(same_cell(cell, *problem.bulk), box, solution).value[q];
                     out.leaving += two_pi * measure * numbers.coat * indicator *
                                    (std::max(outflow, 0.0) + numbers.exchange_with_outside) * depleted;
                 });
    });
    sum_over_processes({&out.missing, &out.leaving, &out.molecules, &out.area, &out.at_membrane},
                       problem.space->dofs.get_communicator());
    return out;
}

}  // namespace endoflow::phasefield::production
