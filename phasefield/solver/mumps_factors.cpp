#include "phasefield/solver/mumps_factors.h"

#include <dmumps_c.h>
#include <smumps_c.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <type_traits>
#include <vector>

#include "phasefield/solver/mumps_ordering.h"

namespace endoflow::phasefield {

namespace {

enum Job : MUMPS_INT { job_start = -1, job_end = -2, job_order = 1, job_factorise = 2, job_solve = 3 };
constexpr int spare_workspace = 60;         // per cent more than estimated
constexpr int most_spare_workspace = 1000;  // tried before giving up

void call(SMUMPS_STRUC_C& data) {
    smumps_c(&data);
}

void call(DMUMPS_STRUC_C& data) {
    dmumps_c(&data);
}

/// Of one precision.
template <class Real>
using MumpsData = std::conditional_t<std::is_same_v<Real, float>, SMUMPS_STRUC_C, DMUMPS_STRUC_C>;

template <class Data>
struct Handle {
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
        call(id);
        return id.infog[0];
    }
    /// ICNTL(number) of the user's guide.
    MUMPS_INT& control(int number) { return id.icntl[number - 1]; }

    Data id{};
};

template <class Real>
class FactorsOf final : public MumpsFactors<Real> {
  public:
    FactorsOf(const CellMatrices& cells, unsigned int kept);

    bool factorise(std::vector<Real>& entries, dealii::FullMatrix<double>& left) override;
    bool reduce(const dealii::Vector<double>& right_hand_side, dealii::Vector<double>& reduced) override;
    bool expand(const dealii::Vector<double>& kept, dealii::Vector<double>& solution) override;
    double operations() const override { return static_cast<double>(handle_.id.rinfo[0]); }

  private:
    /// The sizes of rows and columns differ by many powers of ten, and pivoting compares them.
    void scale(std::vector<Real>& entries);

    Handle<MumpsData<Real>> handle_;
    const CellMatrices* cells_;
    unsigned int size_, kept_;
    std::vector<double> row_scale_, column_scale_;
    std::vector<int> kept_unknowns_;  // from 1
    std::vector<Real> left_, reduced_, work_;
};

template <class Real>
FactorsOf<Real>::FactorsOf(const CellMatrices& cells, unsigned int kept)
    : cells_(&cells),
      size_(cells.size),
      kept_(kept),
      row_scale_(size_, 1.0),
      column_scale_(size_, 1.0),
      kept_unknowns_(kept),
      left_(static_cast<std::size_t>(kept) * kept),
      reduced_(kept),
      work_(size_) {
    std::iota(kept_unknowns_.begin(), kept_unknowns_.end(), static_cast<int>(size_ - kept) + 1);
    auto& id = handle_.id;
    id.n = static_cast<MUMPS_INT>(size_);
    id.nelt = static_cast<MUMPS_INT>(cells.cells());
    id.eltptr = const_cast<MUMPS_INT*>(cells.begin.data());
    id.eltvar = const_cast<MUMPS_INT*>(cells.unknowns.data());
    id.rhs = work_.data();
    handle_.control(5) = 1;  // a sum of cells' matrices
    handle_.control(7) = static_cast<int>(MumpsOrdering::approximate_minimum_fill);
    handle_.control(8) = 0;  // scale() does it
    handle_.control(14) = spare_workspace;
    if (kept_ > 0) {
        handle_.control(19) = 1;
        id.size_schur = static_cast<MUMPS_INT>(kept_);
        id.listvar_schur = kept_unknowns_.data();
        id.schur = left_.data();
        id.redrhs = reduced_.data();
        id.lredrhs = static_cast<MUMPS_INT>(kept_);
    }
    if (size_ > kept_) handle_.run(job_order);  // after an error factorise() fails
}

template <class Real>
void FactorsOf<Real>::scale(std::vector<Real>& entries) {
    const auto invert = [](double largest) { return largest > 0 ? 1 / largest : 1; };
    std::vector<Real> largest_of_row;
    std::fill(row_scale_.begin(), row_scale_.end(), 0);
    cells_->for_each([&](const int* unknowns, std::size_t n, std::size_t begin) {
        largest_of_row.assign(n, 0);
        for (std::size_t k = 0; k < n; ++k)
            for (std::size_t i = 0; i < n; ++i)
                largest_of_row[i] = std::max(largest_of_row[i], std::abs(entries[begin + k * n + i]));
        for (std::size_t i = 0; i < n; ++i) {
            auto& largest = row_scale_[static_cast<std::size_t>(unknowns[i] - 1)];
            largest = std::max(largest, static_cast<double>(largest_of_row[i]));
        }
    });
    std::transform(row_scale_.begin(), row_scale_.end(), row_scale_.begin(), invert);
    std::vector<double> scale_of_row;
    const auto take_rows = [&](const int* unknowns, std::size_t n) {
        scale_of_row.resize(n);
        for (std::size_t i = 0; i < n; ++i) scale_of_row[i] = row_scale_[static_cast<std::size_t>(unknowns[i] - 1)];
    };
    std::fill(column_scale_.begin(), column_scale_.end(), 0);
    cells_->for_each([&](const int* unknowns, std::size_t n, std::size_t begin) {
        take_rows(unknowns, n);
        for (std::size_t k = 0; k < n; ++k) {
            auto& largest = column_scale_[static_cast<std::size_t>(unknowns[k] - 1)];
            for (std::size_t i = 0; i < n; ++i)
                largest =
                    std::max(largest, static_cast<double>(std::abs(entries[begin + k * n + i])) * scale_of_row[i]);
        }
    });
    std::transform(column_scale_.begin(), column_scale_.end(), column_scale_.begin(), invert);
    cells_->for_each([&](const int* unknowns, std::size_t n, std::size_t begin) {
        take_rows(unknowns, n);
        for (std::size_t k = 0; k < n; ++k) {
            const double of_column = column_scale_[static_cast<std::size_t>(unknowns[k] - 1)];
            for (std::size_t i = 0; i < n; ++i) {
                Real& entry = entries[begin + k * n + i];
                entry = static_cast<Real>(static_cast<double>(entry) * scale_of_row[i] * of_column);
            }
        }
    });
}

template <class Real>
bool FactorsOf<Real>::factorise(std::vector<Real>& entries, dealii::FullMatrix<double>& left) {
    left.reinit(kept_, kept_);
    if (size_ == kept_) {  // MUMPS wants something to eliminate
        cells_->for_each([&](const int* unknowns, std::size_t n, std::size_t begin) {
            for (std::size_t k = 0; k < n; ++k)
                for (std::size_t i = 0; i < n; ++i)
                    left(static_cast<unsigned int>(unknowns[i] - 1), static_cast<unsigned int>(unknowns[k] - 1)) +=
                        static_cast<double>(entries[begin + k * n + i]);
        });
        return true;
    }
    scale(entries);
    handle_.id.a_elt = entries.data();

    int status = handle_.run(job_factorise);
    while ((status == -8 || status == -9) && handle_.control(14) < most_spare_workspace) {
        handle_.control(14) *= 2;
        status = handle_.run(job_factorise);
    }
    if (status < 0) return false;
    const std::size_t eliminated = size_ - kept_;
    std::size_t entry = 0;
    for (unsigned int i = 0; i < kept_; ++i)
        for (unsigned int k = 0; k < kept_; ++k)
            left(i, k) =
                static_cast<double>(left_[entry++]) / row_scale_[eliminated + i] / column_scale_[eliminated + k];
    return true;
}

template <class Real>
bool FactorsOf<Real>::reduce(const dealii::Vector<double>& right_hand_side, dealii::Vector<double>& reduced) {
    if (size_ == kept_) {
        reduced = right_hand_side;
        return true;
    }
    // The kept unknowns' residual is only a process's part of it: it does not vanish with the whole, and single
    // precision would leave a rest of it.
    const std::size_t eliminated = size_ - kept_;
    for (unsigned int i = 0; i < size_; ++i)
        work_[i] = i < eliminated ? static_cast<Real>(row_scale_[i] * right_hand_side(i)) : 0;
    if (kept_ == 0) return true;
    handle_.control(26) = 1;
    const int status = handle_.run(job_solve);
    for (unsigned int k = 0; k < kept_; ++k) {
        const auto i = static_cast<unsigned int>(eliminated + k);
        reduced(k) = right_hand_side(i) + static_cast<double>(reduced_[k]) / row_scale_[i];
    }
    return status >= 0;
}

template <class Real>
bool FactorsOf<Real>::expand(const dealii::Vector<double>& kept, dealii::Vector<double>& solution) {
    if (size_ == kept_) {
        solution = kept;
        return true;
    }
    const std::size_t eliminated = size_ - kept_;
    for (unsigned int i = 0; i < kept_; ++i) reduced_[i] = static_cast<Real>(kept(i) / column_scale_[eliminated + i]);
    handle_.control(26) = kept_ > 0 ? 2 : 0;
    const int status = handle_.run(job_solve);
    for (unsigned int i = 0; i < size_; ++i) solution(i) = column_scale_[i] * static_cast<double>(work_[i]);
    // Not rounded: what hangs on a kept unknown is the same on all processes.
    for (unsigned int k = 0; k < kept_; ++k) solution(static_cast<unsigned int>(eliminated) + k) = kept(k);
    return status >= 0;
}

}  // namespace

template <class Real>
std::unique_ptr<MumpsFactors<Real>> mumps_factors(const CellMatrices& cells, unsigned int kept) {
    return std::make_unique<FactorsOf<Real>>(cells, kept);
}

template std::unique_ptr<MumpsFactors<float>> mumps_factors(const CellMatrices&, unsigned int);
template std::unique_ptr<MumpsFactors<double>> mumps_factors(const CellMatrices&, unsigned int);

}  // namespace endoflow::phasefield
