#include "phasefield/solver/mumps_factors.h"

#include <dmumps_c.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace endoflow::phasefield {

namespace {

enum Job : MUMPS_INT { job_start = -1, job_end = -2, job_order = 1, job_factorise = 2, job_solve = 3 };
constexpr int spare_workspace = 60;         // per cent more than estimated
constexpr int most_spare_workspace = 1000;  // tried before giving up

}  // namespace

struct MumpsFactors::Handle {
    Handle() {
        id.comm_fortran = static_cast<MUMPS_INT>(MPI_Comm_c2f(MPI_COMM_SELF));
        id.par = 1;
        id.sym = 0;
        run(job_start);
        for (int stream = 1; stream <= 4; ++stream) control(stream) = stream < 4 ? -1 : 0;  // no output
    }
    ~Handle() { run(job_end); }
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;

    /// 0, or what went wrong, negative.
    int run(Job job) {
        id.job = job;
        dmumps_c(&id);
        return id.infog[0];
    }
    /// ICNTL(number) of the user's guide.
    MUMPS_INT& control(int number) { return id.icntl[number - 1]; }

    DMUMPS_STRUC_C id{};
};

MumpsFactors::MumpsFactors(const dealii::SparsityPattern& pattern, unsigned int kept)
    : handle_(std::make_unique<Handle>()),
      size_(static_cast<unsigned int>(pattern.n_rows())),
      kept_(kept),
      row_scale_(size_, 1.0),
      column_scale_(size_, 1.0),
      kept_unknowns_(kept),
      left_(static_cast<std::size_t>(kept) * kept),
      reduced_(kept),
      work_(size_) {
    for (const auto& entry : pattern) {
        rows_.push_back(static_cast<int>(entry.row()) + 1);
        columns_.push_back(static_cast<int>(entry.column()) + 1);
    }
    values_.resize(rows_.size());
    std::iota(kept_unknowns_.begin(), kept_unknowns_.end(), static_cast<int>(size_ - kept) + 1);
    auto& id = handle_->id;
    id.n = static_cast<MUMPS_INT>(size_);
    id.nnz = static_cast<MUMPS_INT8>(rows_.size());
    id.irn = rows_.data();
    id.jcn = columns_.data();
    id.rhs = work_.data();
    handle_->control(6) = 0;  // no permutation of columns: pivoting finds what is not on the diagonal
    handle_->control(7) = 2;  // approximate minimum fill: a quarter less work here than METIS
    handle_->control(8) = 0;  // scale() does it
    handle_->control(14) = spare_workspace;
    if (kept_ > 0) {
        handle_->control(19) = 1;
        id.size_schur = static_cast<MUMPS_INT>(kept_);
        id.listvar_schur = kept_unknowns_.data();
        id.schur = left_.data();
        id.redrhs = reduced_.data();
        id.lredrhs = static_cast<MUMPS_INT>(kept_);
    }
    if (size_ > 0) handle_->run(job_order);  // after an error factorise() fails
}

MumpsFactors::~MumpsFactors() = default;

void MumpsFactors::scale() {
    const std::size_t eliminated = size_ - kept_;
    const auto position = [](int number) { return static_cast<std::size_t>(number - 1); };
    const auto invert_largest = [&](const std::vector<int>& indices, std::vector<double>& scale) {
        std::fill(scale.begin(), scale.end(), 0);
        for (std::size_t k = 0; k < values_.size(); ++k) {
            double& largest = scale[position(indices[k])];
            largest = std::max(largest, std::abs(values_[k]));
        }
        for (std::size_t i = 0; i < size_; ++i) scale[i] = i < eliminated && scale[i] > 0 ? 1 / scale[i] : 1;
        for (std::size_t k = 0; k < values_.size(); ++k) values_[k] *= scale[position(indices[k])];
    };
    invert_largest(rows_, row_scale_);
    invert_largest(columns_, column_scale_);
}

bool MumpsFactors::factorise(const dealii::SparseMatrix<double>& matrix, dealii::FullMatrix<double>& left) {
    if (size_ == 0) return true;
    std::size_t next = 0;
    for (const auto& entry : matrix) values_[next++] = entry.value();
    scale();
    handle_->id.a = values_.data();

    int status = handle_->run(job_factorise);
    while ((status == -8 || status == -9) && handle_->control(14) < most_spare_workspace) {
        handle_->control(14) *= 2;
        status = handle_->run(job_factorise);
    }
    if (status < 0) return false;
    left.reinit(kept_, kept_);
    for (unsigned int i = 0; i < kept_; ++i)
        for (unsigned int k = 0; k < kept_; ++k) left(i, k) = left_[static_cast<std::size_t>(i) * kept_ + k];
    return true;
}

bool MumpsFactors::reduce(const dealii::Vector<double>& right_hand_side, dealii::Vector<double>& reduced) {
    for (unsigned int i = 0; i < size_; ++i) work_[i] = row_scale_[i] * right_hand_side(i);
    if (kept_ == 0) return true;
    handle_->control(26) = 1;
    const int status = handle_->run(job_solve);
    std::copy(reduced_.begin(), reduced_.end(), reduced.begin());
    return status >= 0;
}

bool MumpsFactors::expand(const dealii::Vector<double>& kept, dealii::Vector<double>& solution) {
    if (size_ == 0) return true;
    std::copy(kept.begin(), kept.end(), reduced_.begin());
    handle_->control(26) = kept_ > 0 ? 2 : 0;
    const int status = handle_->run(job_solve);
    for (unsigned int i = 0; i < size_; ++i) solution(i) = column_scale_[i] * work_[i];
    return status >= 0;
}

}  // namespace endoflow::phasefield
