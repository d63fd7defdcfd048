#pragma once

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/vector.h>

#include <memory>
#include <vector>

namespace endoflow::phasefield {

/// LU factors by MUMPS, on one process, of a sparse matrix all but whose last `kept` unknowns are eliminated. With i
/// the eliminated and k the kept unknowns, what is left is A_kk − A_ki A_ii⁻¹ A_ik.
///
/// They are of single precision, half as large as in double precision and sooner made, for iterations that find the
/// residual in double precision: Newton's method, or iterative refinement (Buttari et al., ACM TOMS 34(4), 2008).
class MumpsFactors {
  public:
    /// Orders the unknowns.
    MumpsFactors(const dealii::SparsityPattern& pattern, unsigned int kept);
    ~MumpsFactors();
    MumpsFactors(const MumpsFactors&) = delete;
    MumpsFactors& operator=(const MumpsFactors&) = delete;

    /// What is left, kept × kept. This and the following are false when MUMPS reports an error: a singular matrix, or
    /// not enough memory.
    [[nodiscard]] bool factorise(const dealii::SparseMatrix<double>& matrix, dealii::FullMatrix<double>& left);
    /// The right-hand side of the kept unknowns, r_k − A_ki A_ii⁻¹ r_i. Remembers r_i for the next expand().
    [[nodiscard]] bool reduce(const dealii::Vector<double>& right_hand_side, dealii::Vector<double>& reduced);
    /// All unknowns from the kept ones.
    [[nodiscard]] bool expand(const dealii::Vector<double>& kept, dealii::Vector<double>& solution);

  private:
    struct Handle;

    /// The sizes of rows and columns differ by many powers of ten, and pivoting compares them.
    void scale(const dealii::SparseMatrix<double>& matrix);

    std::unique_ptr<Handle> handle_;
    unsigned int size_, kept_;
    std::vector<double> row_scale_, column_scale_;
    std::vector<int> rows_, columns_, kept_unknowns_;  // from 1
    std::vector<float> values_;                        // of the scaled matrix
    std::vector<float> left_, reduced_, work_;
};

}  // namespace endoflow::phasefield
