#include "boundary_integral/modes/mode_layers.h"

#include <algorithm>
#include <cmath>

#include "boundary_integral/modes/azimuthal_kernels.h"
#include "boundary_integral/operators/closest_point.h"
#include "boundary_integral/operators/curve_offset.h"
#include "boundary_integral/operators/membrane_layers.h"
#include "boundary_integral/quadrature/singular_rules.h"
#include "boundary_integral/support/parallel.h"

namespace endoflow::boundary_integral {

namespace {

// Bases of both parities at one point of the membrane.
struct PointBasis {
    std::array<BasisRow, 2> quintic, force;
};

PointBasis point_basis(const ParitySpaces& spaces, double xi, Index element) {
    return {{spaces.quintic[0].basis(xi, element), spaces.quintic[1].basis(xi, element)},
            {spaces.force[0].basis(xi), spaces.force[1].basis(xi)}};
}

struct Sources {
    const MembraneSpace& space;
    const ParitySpaces& spaces;
    const MembraneState& state;
    LayerQuadrature quadrature;
    QuadratureRule singular_rule = gauss_legendre(LayerQuadrature{}.singular_points);
    QuadratureRule near_rule = gauss_legendre(LayerQuadrature{}.near_points);
    std::vector<CurvePoint> curve = {};
    std::vector<PointBasis> basis = {};
    std::vector<double> lengths = {};  // of the elements, nm

    Sources(const MembraneSpace& membrane, const ParitySpaces& parity_spaces, const MembraneState& membrane_state)
        : space(membrane),
          spaces(parity_spaces),
          state(membrane_state),
          curve(sample(membrane, membrane_state).curve),
          lengths(at(membrane.elements()), 0.0) {
        const std::size_t points = at(space.points_per_element());
        for (std::size_t i = 0; i < curve.size(); ++i) {
            basis.push_back(point_basis(spaces, space.xi[i], static_cast<Index>(i / points)));
            lengths[i / points] += space.weight[i] * curve[i].g;
        }
    }
};

class ModeLayerBuilder {
  public:
    ModeLayerBuilder(const Sources& sources, std::vector<ModeLayers>& layers)
        : sources_(sources), layers_(layers), kernels_(static_cast<int>(layers.size()) - 1) {}

    void add(const ModeTarget& target, Index first_row) {
        first_row_ = first_row;
        for (Index element = 0; element < sources_.space.elements(); ++element) {
            if (lies_in(target, element)) {
                add_own(target, element);
            } else {
                add_other(target, element);
            }
        }
    }

  private:
    const Sources& sources_;
    std::vector<ModeLayers>& layers_;
    AzimuthalKernels kernels_;
    Index first_row_ = 0;

    [[nodiscard]] bool lies_in(const ModeTarget& target, Index element) const {
        constexpr double slack = 1e-12;
        const double begin = static_cast<double>(element) * sources_.space.element_width();
        return target.xi >= begin - slack && target.xi <= begin + sources_.space.element_width() + slack;
    }

    // Differences from the Taylor polynomial about the target.
    void add_own(const ModeTarget& target, Index element) {
        const MembraneSpace& space = sources_.space;
        const double begin = static_cast<double>(element) * space.element_width();
        const OffsetRule rule =
            logarithmic_rule(begin, begin + space.element_width(), target.xi, sources_.singular_rule);
        const auto r = space.radial().taylor(sources_.state.r, rule.origin, element);
        const auto z = space.axial().taylor(sources_.state.z, rule.origin, element);
        for (std::size_t i = 0; i < rule.offsets.size(); ++i) {
            const double t = rule.offsets[i];
            const CurveOffset offset = curve_offset(r, z, t);
            const PointBasis basis = point_basis(sources_.spaces, rule.origin + t, element);
            const CurvePoint x = curve_point(basis.quintic[1], basis.quintic[0], sources_.state);
            deposit({target.at.r, x.r, offset.r, offset.z, x.normal_r, offset.normal / x.g},
                    rule.weights[i] * x.r * x.g, basis);
        }
    }

    void add_other(const ModeTarget& target, Index element) {
        const std::size_t points = at(sources_.space.points_per_element());
        const std::size_t first = at(element) * points;
        std::size_t closest = first;
        for (std::size_t i = first; i < first + points; ++i) {
            if (squared_distance(sources_.curve[i], target.at) < squared_distance(sources_.curve[closest], target.at)) {
                closest = i;
            }
        }
        const double near = sources_.quadrature.near_distance * sources_.lengths[at(element)];
        if (squared_distance(sources_.curve[closest], target.at) < near * near) {
            add_near(target, element, sources_.space.xi[closest]);
            return;
        }
        for (std::size_t i = first; i < first + points; ++i) {
            const CurvePoint& x = sources_.curve[i];
            deposit(pair_of(target, x), sources_.space.weight[i] * x.r * x.g, sources_.basis[i]);
        }
    }

    void add_near(const ModeTarget& target, Index element, double guess) {
        const MembraneSpace& space = sources_.space;
        const OffsetRule rule = near_element_rule(space, sources_.state, element, target.at, guess, sources_.near_rule);
        for (std::size_t i = 0; i < rule.offsets.size(); ++i) {
            const PointBasis basis = point_basis(sources_.spaces, rule.origin + rule.offsets[i], element);
            const CurvePoint x = curve_point(basis.quintic[1], basis.quintic[0], sources_.state);
            deposit(pair_of(target, x), rule.weights[i] * x.r * x.g, basis);
        }
    }

    static RingPair pair_of(const ModeTarget& target, const CurvePoint& x) {
        const double dr = x.r - target.at.r, dz = x.z - target.at.z;
        return {target.at.r, x.r, dr, dz, x.normal_r, x.normal_r * dr + x.normal_z * dz};
    }

    static void scatter(double value, const BasisRow& basis, double* row) {
        for (std::size_t k = 0; k < BasisRow::capacity; ++k) row[basis.index[k]] += value * basis.value[0][k];
    }

    void deposit(const RingPair& pair, double measure, const PointBasis& basis) {
        const std::vector<ModeKernels>& kernels = kernels_(pair);
        for (std::size_t mode = 0; mode < layers_.size(); ++mode) {
            const std::size_t parity = mode % 2;
            const BasisRow& lateral = basis.quintic[1 - parity];
            const Index count = sources_.spaces.quintic[1 - parity].dimension();
            for (std::size_t i = 0; i < 3; ++i) {
                double* single = layers_[mode].single.row(first_row_ + static_cast<Index>(i)).data();
                double* doubled = layers_[mode].doubled.row(first_row_ + static_cast<Index>(i)).data();
                const auto& g = kernels[mode].single[i];
                const auto& t = kernels[mode].doubled[i];
                for (std::size_t j = 0; j < 2; ++j) {
                    scatter(measure * g[j], lateral, single + static_cast<Index>(j) * count);
                    scatter(measure * t[j], lateral, doubled + static_cast<Index>(j) * count);
                }
                scatter(measure * g[2], basis.force[parity], single + 2 * count);
                scatter(measure * t[2], basis.quintic[parity], doubled + 2 * count);
            }
        }
    }
};

}  // namespace

std::vector<ModeLayers> mode_layers(const MembraneSpace& space, const ParitySpaces& spaces, const MembraneState& state,
                                    const std::vector<ModeTarget>& targets, int highest_mode, int threads) {
    const Index rows = 3 * static_cast<Index>(targets.size());
    std::vector<ModeLayers> layers;
    for (int mode = 0; mode <= highest_mode; ++mode) {
        const std::size_t parity = static_cast<std::size_t>(mode % 2);
        const Index lateral = 2 * spaces.quintic[1 - parity].dimension();
        layers.push_back({RowMatrix::Zero(rows, lateral + spaces.force[parity].dimension()),
                          RowMatrix::Zero(rows, lateral + spaces.quintic[parity].dimension())});
    }
    const Sources sources(space, spaces, state);
    // Every target owns its rows.
    parallel_parts(static_cast<Index>(targets.size()), threads, [&](Index begin, Index end) {
        ModeLayerBuilder builder(sources, layers);
        for (Index i = begin; i < end; ++i) builder.add(targets[at(i)], 3 * i);
    });
    return layers;
}

}  // namespace endoflow::boundary_integral
