#include "phasefield/fem/local_system.h"

#include <algorithm>

#include "phasefield/fem/small_product.h"

namespace endoflow::phasefield {

namespace {

/// In the order of Op: the shape functions, and how often they are differentiated.
struct Differentiated {
    std::vector<double> ShapeArrays::*shapes;
    int in_r, in_z;
};
constexpr std::array<Differentiated, all_operations.size()> differentiated{{{&ShapeArrays::value, 0, 0},
                                                                            {&ShapeArrays::dx, 1, 0},
                                                                            {&ShapeArrays::dy, 0, 1},
                                                                            {&ShapeArrays::dxx, 2, 0},
                                                                            {&ShapeArrays::dxy, 1, 1},
                                                                            {&ShapeArrays::dyy, 0, 2}}};

}  // namespace

template <class Real>
BasicLocalSystem<Real>::BasicLocalSystem(const Space& space, const dealii::Quadrature<2>& quadrature,
                                         std::optional<unsigned int> twice)
    : space_(&space),
      twice_(twice),
      n_components_(static_cast<unsigned int>(space.degrees.size())),
      fields_(n_components_),
      residuals_(n_components_),
      blocks_(n_components_ * n_components_),
      used_(n_components_ * n_components_, 0) {
    for (unsigned int component = 0; component < n_components_; ++component) {
        std::shared_ptr<const ScalarBasis> basis;
        for (const auto& known : bases_)
            if (known->degree == space.degrees[component]) basis = known;
        if (!basis) basis = std::make_shared<const ScalarBasis>(space.degrees[component], quadrature);
        bases_.push_back(basis);
        auto& shapes = shapes_.emplace_back();
        for (std::size_t op = 0; op < shapes.size(); ++op) {
            const auto& of_basis = (*basis).*differentiated[op].shapes;
            shapes[op].assign(of_basis.begin(), of_basis.end());
        }
    }
    for (unsigned int i = 0; i < n_components_; ++i) {
        residuals_[i].resize(bases_[i]->n_dofs);
        for (unsigned int k = 0; k < n_components_; ++k)
            blocks_[i * n_components_ + k].resize(bases_[i]->n_dofs * bases_[k]->n_dofs);
    }
}

template <class Real>
void BasicLocalSystem<Real>::start(const CellBox& box, const dealii::Vector<double>& iterate) {
    box_ = box;
    for (unsigned int component = 0; component < n_components_; ++component) {
        component_values(*space_, component, iterate, coefficients_);
        evaluate(*bases_[component], box_, coefficients_,
                 twice_ == component ? Derivatives::second : Derivatives::first, fields_[component]);
        std::fill(residuals_[component].begin(), residuals_[component].end(), 0.0);
    }
    for (std::size_t block = 0; block < blocks_.size(); ++block)
        if (used_[block]) std::fill(blocks_[block].begin(), blocks_[block].end(), Real{0});
    std::fill(used_.begin(), used_.end(), char{0});
}

template <class Real>
const std::vector<Real>& BasicLocalSystem<Real>::shapes(unsigned int component, Op op) const {
    return shapes_[component][static_cast<unsigned int>(op)];
}

template <class Real>
double BasicLocalSystem<Real>::scale(Op op) const {
    const Differentiated& in = differentiated[static_cast<unsigned int>(op)];
    double extent = 1;
    for (int k = 0; k < in.in_r; ++k) extent *= box_.hr;
    for (int k = 0; k < in.in_z; ++k) extent *= box_.hz;
    return 1 / extent;
}

template <class Real>
const Coefficients& BasicLocalSystem<Real>::field(unsigned int component, Op op) const {
    const ScalarField& field = fields_[component];
    return op == Op::value ? field.value : op == Op::dr ? field.r : field.z;
}

template <class Real>
void BasicLocalSystem<Real>::residual(unsigned int test, Op test_op, const Coefficients& weight) {
    auto& out = residuals_[test];
    const double factor = scale(test_op);
    scaled_.resize(weight.size());
    for (std::size_t q = 0; q < weight.size(); ++q) scaled_[q] = factor * weight[q];
    const auto& shapes = (*bases_[test]).*differentiated[static_cast<unsigned int>(test_op)].shapes;
    add_transposed_product(scaled_.data(), shapes.data(), weight.size(), 1, out.size(), out.data());
}

template <class Real>
void BasicLocalSystem<Real>::jacobian(unsigned int test, Op test_op, unsigned int trial, Op trial_op,
                                      const std::vector<Real>& weight) {
    Weights weights{};
    weights[static_cast<unsigned int>(trial_op)] = &weight;
    jacobian(test, test_op, trial, weights);
}

template <class Real>
void BasicLocalSystem<Real>::jacobian(unsigned int test, Op test_op, unsigned int trial, const Weights& weights) {
    const std::size_t n_test = bases_[test]->n_dofs, n_trial = bases_[trial]->n_dofs, n_points = bases_[test]->n_points;
    used_[test * n_components_ + trial] = 1;
    columns_.assign(n_points * n_trial, 0);
    for (const Op trial_op : all_operations) {
        const std::vector<Real>* weight = weights[static_cast<unsigned int>(trial_op)];
        if (weight == nullptr) continue;
        add_scaled_rows(static_cast<Real>(scale(test_op) * scale(trial_op)), weight->data(),
                        shapes(trial, trial_op).data(), n_points, n_trial, columns_.data());
    }
    add_transposed_product(shapes(test, test_op).data(), columns_.data(), n_points, n_test, n_trial,
                           blocks_[test * n_components_ + trial].data());
}

template <class Real>
void BasicLocalSystem<Real>::linear(unsigned int test, Op test_op, unsigned int trial, Op trial_op,
                                    const std::vector<Real>& weight) {
    jacobian(test, test_op, trial, trial_op, weight);
    const Coefficients& value = field(trial, trial_op);
    product_.resize(weight.size());
    for (std::size_t q = 0; q < weight.size(); ++q) product_[q] = static_cast<double>(weight[q]) * value[q];
    residual(test, test_op, product_);
}

template <class Real>
void BasicLocalSystem<Real>::write_residual(dealii::Vector<double>& right_hand_side) const {
    for (unsigned int test = 0; test < n_components_; ++test) {
        const auto& rows = space_->local[test];
        for (std::size_t i = 0; i < rows.size(); ++i) right_hand_side(rows[i]) = -residuals_[test][i];
    }
}

template <class Real>
void BasicLocalSystem<Real>::write_jacobian(dealii::FullMatrix<double>& jacobian) const {
    jacobian = 0;
    for (unsigned int test = 0; test < n_components_; ++test) {
        const auto& rows = space_->local[test];
        for (unsigned int trial = 0; trial < n_components_; ++trial) {
            if (!used_[test * n_components_ + trial]) continue;
            const auto& columns = space_->local[trial];
            const Real* block = blocks_[test * n_components_ + trial].data();
            for (std::size_t i = 0; i < rows.size(); ++i)
                for (std::size_t k = 0; k < columns.size(); ++k)
                    jacobian(rows[i], columns[k]) = static_cast<double>(block[i * columns.size() + k]);
        }
    }
}

template class BasicLocalSystem<float>;
template class BasicLocalSystem<double>;

}  // namespace endoflow::phasefield
