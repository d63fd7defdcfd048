#include "phasefield/fem/local_system.h"

#include <algorithm>

#include "phasefield/fem/small_product.h"

namespace endoflow::phasefield {

LocalSystem::LocalSystem(const Space& space, const dealii::Quadrature<2>& quadrature, std::optional<unsigned int> twice)
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
    }
    for (unsigned int i = 0; i < n_components_; ++i) {
        residuals_[i].resize(bases_[i]->n_dofs);
        for (unsigned int k = 0; k < n_components_; ++k)
            blocks_[i * n_components_ + k].resize(bases_[i]->n_dofs * bases_[k]->n_dofs);
    }
}

void LocalSystem::start(const CellBox& box, const dealii::Vector<double>& iterate) {
    box_ = box;
    for (unsigned int component = 0; component < n_components_; ++component) {
        component_values(*space_, component, iterate, coefficients_);
        evaluate(*bases_[component], box_, coefficients_,
                 twice_ == component ? Derivatives::second : Derivatives::first, fields_[component]);
        std::fill(residuals_[component].begin(), residuals_[component].end(), 0.0);
    }
    for (std::size_t block = 0; block < blocks_.size(); ++block)
        if (used_[block]) std::fill(blocks_[block].begin(), blocks_[block].end(), 0.0);
    std::fill(used_.begin(), used_.end(), char{0});
}

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

const std::vector<double>& LocalSystem::shapes(unsigned int component, Op op) const {
    return (*bases_[component]).*differentiated[static_cast<unsigned int>(op)].shapes;
}

double LocalSystem::scale(Op op) const {
    const Differentiated& in = differentiated[static_cast<unsigned int>(op)];
    double extent = 1;
    for (int k = 0; k < in.in_r; ++k) extent *= box_.hr;
    for (int k = 0; k < in.in_z; ++k) extent *= box_.hz;
    return 1 / extent;
}

const Coefficients& LocalSystem::field(unsigned int component, Op op) const {
    const ScalarField& field = fields_[component];
    return op == Op::value ? field.value : op == Op::dr ? field.r : field.z;
}

void LocalSystem::residual(unsigned int test, Op test_op, const Coefficients& weight) {
    auto& out = residuals_[test];
    const double factor = scale(test_op);
    scaled_.resize(weight.size());
    for (std::size_t q = 0; q < weight.size(); ++q) scaled_[q] = factor * weight[q];
    add_transposed_product(scaled_.data(), shapes(test, test_op).data(), weight.size(), 1, out.size(), out.data());
}

void LocalSystem::jacobian(unsigned int test, Op test_op, unsigned int trial, Op trial_op, const Coefficients& weight) {
    Weights weights{};
    weights[static_cast<unsigned int>(trial_op)] = &weight;
    jacobian(test, test_op, trial, weights);
}

void LocalSystem::jacobian(unsigned int test, Op test_op, unsigned int trial, const Weights& weights) {
    const std::size_t n_test = bases_[test]->n_dofs, n_trial = bases_[trial]->n_dofs, n_points = bases_[test]->n_points;
    used_[test * n_components_ + trial] = 1;
    columns_.assign(n_points * n_trial, 0);
    for (const Op trial_op : all_operations) {
        const Coefficients* weight = weights[static_cast<unsigned int>(trial_op)];
        if (weight == nullptr) continue;
        add_scaled_rows(scale(test_op) * scale(trial_op), weight->data(), shapes(trial, trial_op).data(), n_points,
                        n_trial, columns_.data());
    }
    add_transposed_product(shapes(test, test_op).data(), columns_.data(), n_points, n_test, n_trial,
                           blocks_[test * n_components_ + trial].data());
}

void LocalSystem::linear(unsigned int test, Op test_op, unsigned int trial, Op trial_op, const Coefficients& weight) {
    jacobian(test, test_op, trial, trial_op, weight);
    const Coefficients& value = field(trial, trial_op);
    product_.resize(weight.size());
    for (std::size_t q = 0; q < weight.size(); ++q) product_[q] = weight[q] * value[q];
    residual(test, test_op, product_);
}

void LocalSystem::write_residual(dealii::Vector<double>& right_hand_side) const {
    for (unsigned int test = 0; test < n_components_; ++test) {
        const auto& rows = space_->local[test];
        for (std::size_t i = 0; i < rows.size(); ++i) right_hand_side(rows[i]) = -residuals_[test][i];
    }
}

void LocalSystem::write_jacobian(dealii::FullMatrix<double>& jacobian) const {
    jacobian = 0;
    for (unsigned int test = 0; test < n_components_; ++test) {
        const auto& rows = space_->local[test];
        for (unsigned int trial = 0; trial < n_components_; ++trial) {
            if (!used_[test * n_components_ + trial]) continue;
            const auto& columns = space_->local[trial];
            const double* block = blocks_[test * n_components_ + trial].data();
            for (std::size_t i = 0; i < rows.size(); ++i)
                for (std::size_t k = 0; k < columns.size(); ++k)
                    jacobian(rows[i], columns[k]) = block[i * columns.size() + k];
        }
    }
}

}  // namespace endoflow::phasefield
