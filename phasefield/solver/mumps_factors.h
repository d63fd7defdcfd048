#pragma once

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/vector.h>

#include <memory>

namespace endoflow::phasefield {

/// Of the factors.
enum class Precision { single, full };

/// LU factors by MUMPS, on one process, of a sparse matrix all but whose last `kept` unknowns are eliminated. With i
/// the eliminated and k the kept unknowns, what is left is A_kk − A_ki A_ii⁻¹ A_ik.
///
/// Those of single precision, half as large and sooner made, are for iterations that find the residual in full
/// precision: Newton's method, or iterative refinement (Buttari et al., ACM TOMS 34(4), 2008).
class MumpsFactors {
  public:
    MumpsFactors() = default;
    virtual ~MumpsFactors() = default;
    MumpsFactors(const MumpsFactors&) = delete;
    MumpsFactors& operator=(const MumpsFactors&) = delete;

    /// What is left, kept × kept. This and the following are false when MUMPS reports an error: a singular matrix, or
    /// not enough memory.
    [[nodiscard]] virtual bool factorise(const dealii::SparseMatrix<double>& matrix,
                                         dealii::FullMatrix<double>& left) = 0;
    /// The right-hand side of the kept unknowns, r_k − A_ki A_ii⁻¹ r_i. Remembers r_i for the next expand().
    [[nodiscard]] virtual bool reduce(const dealii::Vector<double>& right_hand_side,
                                      dealii::Vector<double>& reduced) = 0;
    /// All unknowns from the kept ones.
    [[nodiscard]] virtual bool expand(const dealii::Vector<double>& kept, dealii::Vector<double>& solution) = 0;
};

/// Orders the unknowns.
std::unique_ptr<MumpsFactors> mumps_factors(const dealii::SparsityPattern& pattern, unsigned int kept,
                                            Precision precision);

}  // namespace endoflow::phasefield
