#pragma once

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace endoflow::phasefield {

/// Where the dense matrices of cells stand in the matrix that is their sum. Their entries follow each other cell by
/// cell, column by column.
struct CellMatrices {
    unsigned int size = 0;      // of the sum
    std::vector<int> begin{1};  // in `unknowns`, of each cell and of what would be the next; from 1, as below
    std::vector<int> unknowns;  // of the cells, one after the other

    [[nodiscard]] std::size_t cells() const { return begin.size() - 1; }
    /// Calls visit(unknowns of a cell, their number, where its entries begin); unknowns count from 1.
    template <class Visit>
    void for_each(const Visit& visit) const {
        std::size_t entry = 0;
        for (std::size_t cell = 0; cell < cells(); ++cell) {
            const auto n = static_cast<std::size_t>(begin[cell + 1] - begin[cell]);
            visit(&unknowns[static_cast<std::size_t>(begin[cell] - 1)], n, entry);
            entry += n * n;
        }
    }
};

/// LU factors by MUMPS, on one process, of a matrix all but whose last `kept` unknowns are eliminated. With i
/// the eliminated and k the kept unknowns, what is left is A_kk − A_ki A_ii⁻¹ A_ik.
///
/// Those of single precision, half as large and sooner made, are for iterations that find the residual in full
/// precision: Newton's method, or iterative refinement (Buttari et al., ACM TOMS 34(4), 2008).
template <class Real>
class MumpsFactors {
  public:
    MumpsFactors() = default;
    virtual ~MumpsFactors() = default;
    MumpsFactors(const MumpsFactors&) = delete;
    MumpsFactors& operator=(const MumpsFactors&) = delete;

    /// What is left, kept × kept, of the matrix with these entries, which are scaled for it. This and the following are
    /// false when MUMPS reports an error: a singular matrix, or not enough memory.
    [[nodiscard]] virtual bool factorise(std::vector<Real>& entries, dealii::FullMatrix<double>& left) = 0;
    /// The right-hand side of the kept unknowns, r_k − A_ki A_ii⁻¹ r_i. Remembers r_i for the next expand().
    [[nodiscard]] virtual bool reduce(const dealii::Vector<double>& right_hand_side,
                                      dealii::Vector<double>& reduced) = 0;
    /// Operations that a factorisation takes, as the order of elimination lets expect.
    [[nodiscard]] virtual double operations() const = 0;
    /// All unknowns from the kept ones.
    [[nodiscard]] virtual bool expand(const dealii::Vector<double>& kept, dealii::Vector<double>& solution) = 0;
};

/// Orders the unknowns. `cells` must stay where it is. Real: float or double.
template <class Real>
std::unique_ptr<MumpsFactors<Real>> mumps_factors(const CellMatrices& cells, unsigned int kept);

}  // namespace endoflow::phasefield
