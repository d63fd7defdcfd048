#include "boundary_integral/operators/membrane_layers.h"

#include <algorithm>
#include <cmath>

#include "boundary_integral/operators/closest_point.h"
#include "boundary_integral/quadrature/singular_rules.h"
#include "boundary_integral/support/parallel.h"

namespace endoflow::boundary_integral {

namespace {

std::size_t at(Index i) {
    return static_cast<std::size_t>(i);
}

// Quadrature points of one target outside the tabulated ones.
struct ExtraPoints {
    RingSources sources;
    std::vector<double> measure;  // weight r g dxi
    std::vector<BasisRow> radial, axial, force;

    void clear() {
        sources.resize(0);
        measure.clear();
        radial.clear();
        axial.clear();
        force.clear();
    }
};

class Builder {
  public:
    Builder(const MembraneSpace& space, const MembraneState& state, const MembraneSamples& samples,
            const LayerQuadrature& quadrature, MembraneLayers& layers)
        : space_(space),
          state_(state),
          samples_(samples),
          near_distance_(quadrature.near_distance),
          singular_rule_(gauss_legendre(quadrature.singular_points)),
          near_rule_(gauss_legendre(quadrature.near_points)),
          layers_(layers) {
        table_.resize(samples.curve.size());
        for (std::size_t i = 0; i < samples.curve.size(); ++i) {
            table_.radius[i] = samples.curve[i].r;
            table_.normal_r[i] = samples.curve[i].normal_r;
        }
    }

    void add(const MembraneTarget& target) {
        extra_.clear();
        set_differences(target.at);
        measure_.resize(samples_.curve.size());
        for (Index e = 0; e < space_.elements(); ++e) treat_element(target, e);
        evaluate_ring_kernels(target.at.r, table_, kernels_);
        for (std::size_t i = 0; i < measure_.size(); ++i) {
            if (measure_[i] == 0.0) continue;
            deposit(target.rows, i, measure_[i], space_.radial_rows[i], space_.axial_rows[i], space_.force_rows[i]);
        }
        evaluate_ring_kernels(target.at.r, extra_.sources, kernels_);
        for (std::size_t i = 0; i < extra_.measure.size(); ++i) {
            deposit(target.rows, i, extra_.measure[i], extra_.radial[i], extra_.axial[i], extra_.force[i]);
        }
    }

  private:
    const MembraneSpace& space_;
    const MembraneState& state_;
    const MembraneSamples& samples_;
    double near_distance_;
    QuadratureRule singular_rule_, near_rule_;
    MembraneLayers& layers_;
    RingSources table_;
    RingKernels kernels_;
    ExtraPoints extra_;
    std::vector<double> measure_;

    void set_differences(const Target& target) {
        for (std::size_t i = 0; i < samples_.curve.size(); ++i) {
            const CurvePoint& p = samples_.curve[i];
            table_.delta_r[i] = p.r - target.r;
            table_.delta_z[i] = p.z - target.z;
            table_.normal_offset[i] = p.normal_r * table_.delta_r[i] + p.normal_z * table_.delta_z[i];
        }
    }

    void treat_element(const MembraneTarget& target, Index element) {
        const std::size_t first = at(element * space_.points_per_element());
        const std::size_t last = first + at(space_.points_per_element());
        const double width = space_.element_width();
        const double begin = static_cast<double>(element) * width;
        const double end = begin + width;
        constexpr double slack = 1e-12;
        if (target.xi >= begin - slack && target.xi <= end + slack) {
            add_own_element(target, element, begin, end);
            std::fill(measure_.begin() + static_cast<std::ptrdiff_t>(first),
                      measure_.begin() + static_cast<std::ptrdiff_t>(last), 0.0);
            return;
        }
        double closest = 1e300;
        double length = 0.0;
        std::size_t closest_point = first;
        for (std::size_t i = first; i < last; ++i) {
            const double distance = std::hypot(table_.delta_r[i], table_.delta_z[i]);
            if (distance < closest) {
                closest = distance;
                closest_point = i;
            }
            length += space_.weight[i] * samples_.curve[i].g;
        }
        if (closest < near_distance_ * length) {
            add_near_element(target, element, begin, end, space_.xi[closest_point]);
            std::fill(measure_.begin() + static_cast<std::ptrdiff_t>(first),
                      measure_.begin() + static_cast<std::ptrdiff_t>(last), 0.0);
        } else {
            for (std::size_t i = first; i < last; ++i) {
                measure_[i] = space_.weight[i] * samples_.curve[i].r * samples_.curve[i].g;
            }
        }
    }

    void push(double xi, Index element, double delta_r, double delta_z, double cross, double weight) {
        const BasisRow radial = space_.radial().basis(xi, element);
        const BasisRow axial = space_.axial().basis(xi, element);
        const CurvePoint p = curve_point(radial, axial, state_);
        RingSources& s = extra_.sources;
        s.radius.push_back(p.r);
        s.delta_r.push_back(delta_r);
        s.delta_z.push_back(delta_z);
        s.normal_r.push_back(p.normal_r);
        s.normal_offset.push_back(cross / p.g);
        extra_.measure.push_back(weight * p.r * p.g);
        extra_.radial.push_back(radial);
        extra_.axial.push_back(axial);
        extra_.force.push_back(space_.force().basis(xi));
    }

    // The target lies in this element: differences from the Taylor polynomial about it, so that x - x0 and n.(x - x0)
    // keep their relative accuracy however close the two points are.
    void add_own_element(const MembraneTarget& target, Index element, double begin, double end) {
        const OffsetRule rule = logarithmic_rule(begin, end, target.xi, singular_rule_);
        const auto r = space_.radial().taylor(state_.r, rule.origin, element);
        const auto z = space_.axial().taylor(state_.z, rule.origin, element);
        for (std::size_t i = 0; i < rule.offsets.size(); ++i) {
            const double t = rule.offsets[i];
            // x - x0 = t (x' + t p),  x'(t) = x' + t q
            const auto p = [t](const std::array<double, 6>& d) {
                return d[2] / 2 + t * (d[3] / 6 + t * (d[4] / 24 + t * d[5] / 120));
            };
            const auto q = [t](const std::array<double, 6>& d) {
                return d[2] + t * (d[3] / 2 + t * (d[4] / 6 + t * d[5] / 24));
            };
            const double p_r = p(r), p_z = p(z), q_r = q(r), q_z = q(z);
            // g n.(x - x0) = r'(z - z0) - z'(r - r0) = t^2 [ x' x p + q x x' + t q x p ]
            const double cross =
                t * t * ((r[1] * p_z - z[1] * p_r) + (q_r * z[1] - q_z * r[1]) + t * (q_r * p_z - q_z * p_r));
            push(rule.origin + t, element, t * (r[1] + t * p_r), t * (z[1] + t * p_z), cross, rule.weights[i]);
        }
    }

    void add_near_element(const MembraneTarget& target, Index element, double begin, double end, double guess) {
        const auto [closest, p] = closest_on_element(space_, state_, element, target.at, guess);
        const double distance = std::hypot(p.r - target.at.r, p.z - target.at.z);
        const OffsetRule rule = near_singular_rule(begin, end, closest, std::max(distance, 1e-14) / p.g, near_rule_);
        for (std::size_t i = 0; i < rule.offsets.size(); ++i) {
            const double xi = rule.origin + rule.offsets[i];
            const BasisRow radial = space_.radial().basis(xi, element);
            const BasisRow axial = space_.axial().basis(xi, element);
            const CurvePoint x = curve_point(radial, axial, state_);
            const double dr = x.r - target.at.r;
            const double dz = x.z - target.at.z;
            push(xi, element, dr, dz, x.r1 * dz - x.z1 * dr, rule.weights[i]);
        }
    }

    void deposit(const TargetRows& rows, std::size_t i, double measure, const BasisRow& radial, const BasisRow& axial,
                 const BasisRow& force) {
        const Index offset = space_.radial_count();
        const auto into = [&](Index row, double g_r, double g_z, double t_r, double t_z) {
            if (row < 0) return;
            double* single = layers_.single.row(row).data();
            double* doubled = layers_.doubled.row(row).data();
            for (std::size_t j = 0; j < 6; ++j) {
                single[radial.index[j]] += measure * g_r * radial.value[0][j];
                single[offset + force.index[j]] += measure * g_z * force.value[0][j];
                doubled[radial.index[j]] += measure * t_r * radial.value[0][j];
                doubled[offset + axial.index[j]] += measure * t_z * axial.value[0][j];
            }
        };
        into(rows.radial, kernels_.g_rr[i], kernels_.g_rz[i], kernels_.t_rr[i], kernels_.t_rz[i]);
        into(rows.axial, kernels_.g_zr[i], kernels_.g_zz[i], kernels_.t_zr[i], kernels_.t_zz[i]);
    }
};

}  // namespace

MembraneLayers membrane_layers(const MembraneSpace& space, const MembraneState& state, const MembraneSamples& samples,
                               const std::vector<MembraneTarget>& targets, Index rows,
                               const LayerQuadrature& quadrature) {
    MembraneLayers layers{RowMatrix::Zero(rows, space.force_count()), RowMatrix::Zero(rows, space.curve_count())};
    // Every target owns its rows.
    parallel_parts(static_cast<Index>(targets.size()), quadrature.threads, [&](Index begin, Index end) {
        Builder builder(space, state, samples, quadrature, layers);
        for (Index i = begin; i < end; ++i) builder.add(targets[at(i)]);
    });
    return layers;
}

}  // namespace endoflow::boundary_integral
