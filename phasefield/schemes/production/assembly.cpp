#include "phasefield/schemes/production/assembly.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <array>
#include <type_traits>

#include "phasefield/schemes/production/cell_points.h"
#include "phasefield/schemes/production/external_loads.h"
#include "shared/numerics/vector_clones.h"

namespace endoflow::phasefield::production {

namespace {

constexpr Op operations[3] = {Op::value, Op::dr, Op::dz};
using FeatureDual = Dual<n_variables, float>;  // the factors are of single precision

template <class Number>
const Number& feature(const AtPoint<Number>& at, unsigned int operation) {
    return operation == 0 ? at.value : operation == 1 ? at.r : at.z;
}

template <class Number>
Fields<Number> fields_from(const PointValues& values) {
    Fields<Number> x;
    for (unsigned int f = 0; f < n_fields; ++f) {
        Number* parts[3] = {&x[f].value, &x[f].r, &x[f].z};
        for (unsigned int o = 0; o < 3; ++o) {
            *parts[o] = values[f][o];
            if constexpr (std::is_same_v<Number, FeatureDual>) parts[o]->partial[3 * f + o] = 1;
        }
    }
    return x;
}

/// From ψ's second derivatives rr, rz, zz, the last variables, where the normal is n.
template <class Number>
GradientChange<Number> change_from(const std::array<double, 3>& second, const PlaneVector<Number>& n,
                                   const Number& around) {
    std::array<Number, 3> x;
    for (unsigned int o = 0; o < 3; ++o) {
        x[o] = second[o];
        if constexpr (std::is_same_v<Number, FeatureDual>) x[o].partial[n_features + o] = 1;
    }
    return gradient_change(n, x[0], x[1], x[2], around);
}

}  // namespace

// The equations are most of an assembly, and vector arithmetic: 36 derivatives of each number, or those of W.
ENDOFLOW_VECTOR_CLONES [[gnu::flatten]] Fields<FeatureDual> equations_at(const Fields<FeatureDual>& x, double r,
                                                                         const PointPast& past,
                                                                         const GradientChange<FeatureDual>& change,
                                                                         const StepNumbers& step,
                                                                         const LayerEnergy& energy) {
    return point_equations(x, r, past, change, step, energy);
}
ENDOFLOW_VECTOR_CLONES [[gnu::flatten]] Fields<double> equations_at(const Fields<double>& x, double r,
                                                                    const PointPast& past,
                                                                    const GradientChange<double>& change,
                                                                    const StepNumbers& step,
                                                                    const LayerEnergy& energy) {
    return point_equations(x, r, past, change, step, energy);
}

unsigned int gauss_points(const PhaseFieldParameters& p) {
    return static_cast<unsigned int>(std::max({p.degree, p.velocity_degree, p.surface_degree})) + 3;
}

namespace {

/// The equations at the quadrature points of one cell after the other.
class CellEquations {
  public:
    CellEquations(const StepProblem& problem, const Vector& iterate)
        : quadrature(gauss_points(problem.numbers.numerics)),
          local(problem.space, quadrature, distance),
          problem_(&problem),
          iterate_(&iterate),
          values_(problem.space.element.n_dofs_per_cell()) {}

    /// Calls visit(q, measure, rows) at the quadrature points of the cell; measure is r dr dz.
    template <class Number, class Visit>
    void on_cell(const Cell& cell, const CellBox& box, const Visit& visit) {
        const auto& past = problem_->past.points.at(cell->active_cell_index());
        const auto& manufactured = problem_->past.manufactured;
        cell->get_dof_values(*iterate_, values_);
        local.start(box, values_);
        const ScalarField& psi = local.field(distance);
        for (unsigned int q = 0; q < quadrature.size(); ++q) {
            const double r = box.r0 + box.hr * quadrature.point(q)[0];
            PointValues values;
            for (unsigned int f = 0; f < n_fields; ++f)
                values[f] = {local.field(f).value[q], local.field(f).r[q], local.field(f).z[q]};
            const auto x = fields_from<Number>(values);
            const auto change = change_from<Number>({psi.rr[q], psi.rz[q], psi.zz[q]}, own_normal(x[distance], past[q]),
                                                    x[distance].r / r);
            auto rows = equations_at(x, r, past[q], change, problem_->numbers, problem_->energy);
            if (manufactured)
                take_off(manufactured(r, box.z0 + box.hz * quadrature.point(q)[1]), r, past[q],
                         {value_of(change.r), value_of(change.z), value_of(change.laplacian)}, rows);
            visit(q, quadrature.weight(q) * box.hr * box.hz * r, rows);
        }
    }

    const dealii::QGauss<2> quadrature;
    BasicLocalSystem<float> local;

  private:
    template <class Number>
    void take_off(const PointValues& solution, double r, const PointPast& past, const GradientChange<double>& change,
                  Fields<Number>& rows) const {
        const auto own =
            equations_at(fields_from<double>(solution), r, past, change, problem_->numbers, problem_->energy);
        for (unsigned int f = 0; f < n_fields; ++f) {
            rows[f].value = rows[f].value - own[f].value;
            rows[f].r = rows[f].r - own[f].r;
            rows[f].z = rows[f].z - own[f].z;
        }
    }

    const StepProblem* problem_;
    const Vector* iterate_;
    dealii::Vector<double> values_;
};

/// The loop over cells: residual, and the Jacobian when Number carries derivatives.
template <class Number>
void assemble_cells(const StepProblem& problem, const std::vector<PatternEntry>& pattern, const Vector& iterate,
                    BlockGaussSeidel& system) {
    constexpr bool with_jacobian = std::is_same_v<Number, FeatureDual>;
    const Space& space = problem.space;
    CellEquations equations(problem, iterate);
    RimTension rim(space, problem.numbers);
    auto& local = equations.local;
    const unsigned int n = space.element.n_dofs_per_cell(), n_points = equations.quadrature.size();
    dealii::FullMatrix<double> cell_matrix(with_jacobian ? n : 0, with_jacobian ? n : 0);
    dealii::Vector<double> cell_rhs(n);
    std::vector<Coefficients> residual(n_features, Coefficients(n_points));
    std::vector<std::vector<float>> jacobian(with_jacobian ? pattern.size() : 0, std::vector<float>(n_points));

    for_each_cell(space, [&](const Cell& cell, const CellBox& box) {
        equations.on_cell<Number>(cell, box, [&](unsigned int q, double measure, const auto& rows) {
            for (unsigned int k = 0; k < n_features; ++k)
                residual[k][q] = measure * value_of(feature(rows[k / 3], k % 3));
            if constexpr (with_jacobian)
                for (std::size_t k = 0; k < pattern.size(); ++k) {
                    const auto [row, column] = pattern[k];
                    jacobian[k][q] = static_cast<float>(measure) * feature(rows[row / 3], row % 3).partial[column];
                }
        });
        for (unsigned int k = 0; k < n_features; ++k) local.residual(k / 3, operations[k % 3], residual[k]);
        if constexpr (with_jacobian) {
            for (std::size_t k = 0; k < pattern.size();) {  // all derivatives by one field follow each other
                const unsigned int row = pattern[k].row, group = pattern[k].column / 3;
                const bool twice = group == n_fields;
                BasicLocalSystem<float>::Weights weights{};
                for (; k < pattern.size() && pattern[k].row == row && pattern[k].column / 3 == group; ++k)
                    weights[pattern[k].column % 3 + (twice ? 3 : 0)] = &jacobian[k];
                local.jacobian(row / 3, operations[row % 3], twice ? unsigned{distance} : group, weights);
            }
            local.write_jacobian(cell_matrix);
        }
        local.write_residual(cell_rhs);
        rim.add(cell, iterate, cell_rhs);
        if constexpr (with_jacobian)
            system.set(cell, cell_matrix, cell_rhs);
        else
            system.set(cell, cell_rhs);
    });
}

}  // namespace

void assemble(const StepProblem& problem, const std::vector<PatternEntry>& pattern, const Vector& iterate,
              BlockGaussSeidel& system) {
    assemble_cells<FeatureDual>(problem, pattern, iterate, system);
}

void assemble_residual(const StepProblem& problem, const Vector& iterate, BlockGaussSeidel& system) {
    assemble_cells<double>(problem, {}, iterate, system);
}

double net_vertical_force(const StepProblem& problem, const Vector& solution) {
    CellEquations equations(problem, solution);
    double sum = 0;
    for_each_cell(problem.space, [&](const Cell& cell, const CellBox& box) {
        equations.on_cell<double>(cell, box, [&](unsigned int /*q*/, double measure, const auto& rows) {
            sum -= two_pi * measure * rows[velocity_z].value;
        });
    });
    return dealii::Utilities::MPI::sum(sum, problem.space.dofs.get_communicator());
}

}  // namespace endoflow::phasefield::production
