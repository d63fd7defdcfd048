#include "boundary_integral/operators/membrane_layers.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "boundary_integral/operators/closest_point.h"
#include "boundary_integral/operators/curve_offset.h"
#include "boundary_integral/quadrature/singular_rules.h"
#include "boundary_integral/support/parallel.h"

namespace endoflow::boundary_integral {

namespace {

/// What all targets share.
struct Sources {
    const MembraneSpace& space;
    const MembraneState& state;
    const MembraneSamples& samples;
    ElementBasis basis;           // at the Gauss points
    std::vector<double> measure;  // weight r g at the Gauss points
    std::vector<double> lengths;  // of the elements, nm
    QuadratureRule singular_rule, near_rule;
    double near_distance;

    Sources(const MembraneSpace& membrane_space, const MembraneState& membrane_state,
            const MembraneSamples& membrane_samples, const LayerQuadrature& quadrature)
        : space(membrane_space),
          state(membrane_state),
          samples(membrane_samples),
          lengths(at(membrane_space.elements()), 0.0),
          singular_rule(gauss_legendre(quadrature.singular_points)),
          near_rule(gauss_legendre(quadrature.near_points)),
          near_distance(quadrature.near_distance) {
        const std::size_t points = at(space.points_per_element());
        for (std::size_t i = 0; i < samples.curve.size(); ++i) {
            const CurvePoint& p = samples.curve[i];
            basis.add(space.radial_rows[i], space.axial_rows[i], space.force_rows[i], i % points == 0);
            measure.push_back(space.weight[i] * p.r * p.g);
            lengths[i / points] += space.weight[i] * p.g;
        }
    }
};

class MembraneLayerBuilder {
  public:
    MembraneLayerBuilder(const Sources& sources, MembraneLayers& layers)
        : sources_(sources), layers_(layers), measure_(sources.measure) {
        const auto& curve = sources.samples.curve;
        table_.resize(curve.size());
        for (std::size_t i = 0; i < curve.size(); ++i) {
            table_.radius[i] = curve[i].r;
            table_.normal_r[i] = curve[i].normal_r;
        }
    }

    void add(const MembraneTarget& target) {
        set_differences(target.at);
        measure_ = sources_.measure;
        if (target.xi >= 0.0) {
            if (target.own != nullptr) {
                add_own_elements(target, *target.own);
            } else {
                add_own_elements(target, own_elements(sources_.space, target.xi, sources_.singular_rule));
            }
        }
        for (Index e = 0; e < sources_.space.elements(); ++e) treat_element(target, e);
        evaluate_ring_kernels(target.at.r, table_, kernels_);
        deposit(target.rows, at(sources_.space.elements()), measure_, sources_.basis);
    }

  private:
    const Sources& sources_;
    MembraneLayers& layers_;
    RingSources table_;            // the Gauss points
    std::vector<double> measure_;  // theirs; 0 in elements that another rule integrates
    RingSources extra_;            // points of another rule
    std::vector<double> extra_measure_;
    ElementBasis extra_basis_;
    RingKernels kernels_;
    std::array<std::vector<double>, 4> sums_;

    void set_differences(const Target& target) {
        for (std::size_t i = 0; i < sources_.samples.curve.size(); ++i) {
            const CurvePoint& p = sources_.samples.curve[i];
            table_.delta_r[i] = p.r - target.r;
            table_.delta_z[i] = p.z - target.z;
            table_.normal_offset[i] = p.normal_r * table_.delta_r[i] + p.normal_z * table_.delta_z[i];
        }
    }

    std::size_t first_point(Index element) const { return at(element * sources_.space.points_per_element()); }

    void leave_out(Index element) {
        for (std::size_t i = first_point(element); i < first_point(element + 1); ++i) {
            measure_[i] = 0.0;
            table_.delta_r[i] = 1.0;  // the target may be this very point, and 0 times its kernels is not 0
        }
    }

    void treat_element(const MembraneTarget& target, Index element) {
        const std::size_t first = first_point(element), last = first_point(element + 1);
        if (measure_[first] == 0.0) return;  // the target's own
        double closest = 1e300;
        std::size_t closest_point = first;
        for (std::size_t i = first; i < last; ++i) {
            const double distance = squared_distance(sources_.samples.curve[i], target.at);
            if (distance < closest) {
                closest = distance;
                closest_point = i;
            }
        }
        const double near = sources_.near_distance * sources_.lengths[at(element)];
        if (closest >= near * near) return;
        add_near_element(target, element, sources_.space.xi[closest_point]);
        leave_out(element);
    }

    void start_extra() {
        extra_.resize(0);
        extra_measure_.clear();
    }

    void push(const CurvePoint& p, double delta_r, double delta_z, double cross, double weight) {
        extra_.radius.push_back(p.r);
        extra_.delta_r.push_back(delta_r);
        extra_.delta_z.push_back(delta_z);
        extra_.normal_r.push_back(p.normal_r);
        extra_.normal_offset.push_back(cross / p.g);
        extra_measure_.push_back(weight * p.r * p.g);
    }

    void finish_extra(const MembraneTarget& target, const ElementBasis& basis) {
        evaluate_ring_kernels(target.at.r, extra_, kernels_);
        deposit(target.rows, 1, extra_measure_, basis);
    }

    /// The target lies in these elements: differences from the Taylor polynomial about it.
    void add_own_elements(const MembraneTarget& target, const OwnElements& elements) {
        for (const OwnElement& own : elements) {
            start_extra();
            const auto r = sources_.space.radial().taylor(sources_.state.r, own.rule.origin, own.element);
            const auto z = sources_.space.axial().taylor(sources_.state.z, own.rule.origin, own.element);
            for (std::size_t i = 0; i < own.rule.offsets.size(); ++i) {
                const CurveOffset offset = curve_offset(r, z, own.rule.offsets[i]);
                push(curve_point(own.radial_rows[i], own.axial_rows[i], sources_.state), offset.r, offset.z,
                     offset.normal, own.rule.weights[i]);
            }
            finish_extra(target, own.basis);
            leave_out(own.element);
        }
    }

    void add_near_element(const MembraneTarget& target, Index element, double guess) {
        const MembraneSpace& space = sources_.space;
        const OffsetRule rule = near_element_rule(space, sources_.state, element, target.at, guess, sources_.near_rule);
        start_extra();
        extra_basis_.clear();
        for (std::size_t i = 0; i < rule.offsets.size(); ++i) {
            const double xi = rule.origin + rule.offsets[i];
            const BasisRow radial = space.radial().basis(xi, element);
            const BasisRow axial = space.axial().basis(xi, element);
            extra_basis_.add(radial, axial, space.force().basis(xi), i == 0);
            const CurvePoint x = curve_point(radial, axial, sources_.state);
            const double dr = x.r - target.at.r;
            const double dz = x.z - target.at.z;
            push(x, dr, dz, x.r1 * dz - x.z1 * dr, rule.weights[i]);
        }
        finish_extra(target, extra_basis_);
    }

    /// Adds the kernels at all points of `elements` elements to the target's rows.
    void deposit(const TargetRows& rows, std::size_t elements, const std::vector<double>& measure,
                 const ElementBasis& basis) {
        const std::size_t points = measure.size() / elements;
        for (auto& sums : sums_) sums.resize(basis_stride * elements);
        const Index offset = sources_.space.radial_count();
        struct Part {
            const BasisTable& table;
            const std::vector<double>& values;
            RowMatrix& matrix;
            Index row, first_column;
        };
        const auto add = [&](const std::array<Part, 4>& parts) {
            point_sums(elements, points, parts[0].table.values(), parts[2].table.values(), measure.data(),
                       {parts[0].values.data(), parts[1].values.data(), parts[2].values.data(), parts[3].values.data()},
                       {sums_[0].data(), sums_[1].data(), sums_[2].data(), sums_[3].data()});
            for (std::size_t k = 0; k < parts.size(); ++k) {
                if (parts[k].row < 0) continue;
                double* row = parts[k].matrix.row(parts[k].row).data() + parts[k].first_column;
                for (std::size_t e = 0; e < elements; ++e) parts[k].table.scatter(e, &sums_[k][basis_stride * e], row);
            }
        };
        RowMatrix& single = layers_.single;
        RowMatrix& doubled = layers_.doubled;
        add({Part{basis.radial, kernels_.g_rr, single, rows.radial, 0},
             Part{basis.radial, kernels_.g_zr, single, rows.axial, 0},
             Part{basis.radial, kernels_.t_rr, doubled, rows.radial, 0},
             Part{basis.radial, kernels_.t_zr, doubled, rows.axial, 0}});
        add({Part{basis.force, kernels_.g_rz, single, rows.radial, offset},
             Part{basis.force, kernels_.g_zz, single, rows.axial, offset},
             Part{basis.axial, kernels_.t_rz, doubled, rows.radial, offset},
             Part{basis.axial, kernels_.t_zz, doubled, rows.axial, offset}});
    }
};

}  // namespace

MembraneLayers membrane_layers(const MembraneSpace& space, const MembraneState& state, const MembraneSamples& samples,
                               const std::vector<MembraneTarget>& targets, Index rows,
                               const LayerQuadrature& quadrature) {
    MembraneLayers layers{RowMatrix::Zero(rows, space.force_count()), RowMatrix::Zero(rows, space.curve_count())};
    const Sources sources(space, state, samples, quadrature);
    // Every target owns its rows.
    parallel_parts(static_cast<Index>(targets.size()), quadrature.threads, [&](Index begin, Index end) {
        MembraneLayerBuilder builder(sources, layers);
        for (Index i = begin; i < end; ++i) builder.add(targets[at(i)]);
    });
    return layers;
}

}  // namespace endoflow::boundary_integral
