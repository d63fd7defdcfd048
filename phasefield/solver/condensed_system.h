#pragma once

#include <deal.II/lac/lapack_full_matrix.h>

#include <string>
#include <variant>
#include <vector>

#include "phasefield/solver/subdomain_system.h"

namespace endoflow::phasefield {

/// Of matrices and factors.
enum class Precision { single, full };

/// A linear system for some components of a space, from which the unknowns inside of the cells (with cubic elements
/// more than two fifths of all) are eliminated cell by cell, before the rest goes to the sparse solver: static
/// condensation. The elimination takes no communication, and small dense products are faster than the sparse solver's
/// many small fronts.
///
/// With i the inner and o the other unknowns of a cell, A_oo − A_oi A_ii⁻¹ A_io and r_o − A_oi A_ii⁻¹ r_i are
/// assembled, and then x_i = A_ii⁻¹ (r_i − A_io x_o).
class CondensedSystem {
  public:
    using Cell = dealii::DoFHandler<2>::active_cell_iterator;
    using Index = dealii::types::global_dof_index;

    /// `components` ascend.
    CondensedSystem(MPI_Comm communicator, std::string name, std::vector<unsigned int> components);

    /// Allocates for the present mesh, in single precision; `process`: the one that eliminates what an own cell has on
    /// its vertices and faces.
    void reinit(const Space& space, const std::vector<unsigned int>& process);
    /// A cell's n × n matrix, of the whole space and in the cell's numbering; read are the components' rows and
    /// columns. Set those of all own cells, then solve().
    void set(const Cell& cell, const dealii::FullMatrix<double>& matrix);
    /// A cell's n right-hand sides. After its matrix. Set those of all own cells, then solve() or apply_factors().
    void set(const Cell& cell, const dealii::Vector<double>& right_hand_side);

    /// Of the next factors. Where that changes, those there are are forgotten.
    void use(Precision precision);
    [[nodiscard]] Precision precision() const;
    /// As of SubdomainSystem, with its errors, also when the block of a cell's inner unknowns is singular; the
    /// components of `solution` are set and all its ghost values updated.
    void forget_factors();
    [[nodiscard]] bool has_factors() const;
    void solve(const Space& space, Vector& solution);
    void apply_factors(const Space& space, Vector& solution);
    [[nodiscard]] Index shared_unknowns() const;
    [[nodiscard]] double operations() const;

    [[nodiscard]] const std::vector<unsigned int>& components() const { return components_; }
    /// Their unknowns in a cell's numbering.
    [[nodiscard]] const std::vector<unsigned int>& in_cell() const { return in_cell_; }
    /// Of this process, and which one of them an own cell is.
    [[nodiscard]] std::size_t own_cells() const { return cells_.size(); }
    [[nodiscard]] std::size_t position(const Cell& cell) const { return positions_[cell->active_cell_index()]; }

  private:
    using Dense = dealii::LAPACKFullMatrix<double>;

    /// An outer unknown is a sum over free ones, the system's: itself, or where it hangs those it hangs on.
    struct Part {
        unsigned int outer, free;
        double weight;
    };
    /// An own cell.
    struct Place {
        std::vector<Index> unknowns;      // in the space
        std::vector<unsigned int> fixed;  // of the inner ones, by constraints
        std::vector<Part> parts;          // of the outer ones
    };
    /// All numbers of one precision. Cells are eliminated in double precision, and rounded once.
    template <class Real>
    struct Numbers {
        /// What is kept of a cell.
        struct Elimination {
            bool undetermined = false;                                     // the inner unknowns
            dealii::LAPACKFullMatrix<Real> inverse, to_inner, from_inner;  // A_ii⁻¹, −A_ii⁻¹ A_io, −A_oi A_ii⁻¹
            dealii::Vector<Real> residual;                                 // r_i, which vanishes with that of the whole
        };

        Numbers(MPI_Comm communicator, const std::string& name) : system(communicator, name) {}

        SubdomainSystem<Real> system;
        std::vector<Elimination> cells;
        dealii::Vector<Real> outer, inner;
    };

    /// The free unknowns behind a cell's outer ones.
    static std::vector<Index> express_by_free(const std::vector<Index>& unknowns,
                                              const dealii::AffineConstraints<double>& constraints,
                                              std::vector<Part>& parts);
    template <class Real>
    void allocate();
    template <class Real>
    void eliminate(const dealii::FullMatrix<double>& matrix, const Place& place,
                   typename Numbers<Real>::Elimination& cell);
    void expand(const Space& space, Vector& solution);

    MPI_Comm communicator_;
    std::string name_;
    std::vector<unsigned int> components_;
    std::vector<unsigned int> in_cell_;       // the components' unknowns in a cell's numbering, of which
    unsigned int n_outer_ = 0, n_inner_ = 0;  // the outer ones come first
    std::vector<Place> cells_;
    std::vector<std::size_t> positions_;             // in cells_, by the active cell's index
    std::vector<std::vector<Index>> free_unknowns_;  // of the cells
    std::vector<unsigned int> process_;
    dealii::IndexSet owned_;
    std::variant<Numbers<float>, Numbers<double>> numbers_;
    Dense inverse_, to_inner_, from_inner_, A_oi_, S_;
    dealii::Vector<double> free_residual_, outer_solution_;
};

}  // namespace endoflow::phasefield
