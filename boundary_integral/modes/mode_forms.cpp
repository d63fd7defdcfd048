#include "boundary_integral/modes/mode_forms.h"

#include <utility>

namespace endoflow::boundary_integral {

namespace {

constexpr std::size_t functions = BasisRow::capacity;  // of a quintic space at one point

Derivatives2 derivatives(const BasisRow& row, std::size_t j) {
    return {row.value[0][j], row.value[1][j], row.value[2][j]};
}

Derivatives2 product(const Derivatives2& a, const Derivatives2& b) {
    return {a.value * b.value, a.first * b.value + a.value * b.first,
            a.second * b.value + 2.0 * a.first * b.first + a.value * b.second};
}

// A velocity basis function at one point.
struct VelocityFunction {
    Index index;
    std::array<double, 3> value, slope;  // (r, phi, z), and by xi
    SurfaceAmplitudes amplitudes;
};

std::array<VelocityFunction, 3 * functions> velocity_functions(const ModeSpace& space, const BasisRow& lateral,
                                                               const BasisRow& vertical) {
    std::array<VelocityFunction, 3 * functions> result{};
    const Index count = space.lateral().dimension();
    for (std::size_t j = 0; j < functions; ++j) {
        for (std::size_t k = 0; k < 3; ++k) {
            const BasisRow& row = k == 2 ? vertical : lateral;
            VelocityFunction& f = result[functions * k + j];
            f.index = row.index[j] + static_cast<Index>(k) * count;
            f.value[k] = row.value[0][j];
            f.slope[k] = row.value[1][j];
            std::array<Derivatives2, 3> v{};
            v[k] = derivatives(row, j);
            f.amplitudes = surface_amplitudes(space.mode(), v[0], v[1], v[2]);
        }
    }
    return result;
}

// Variation of x_xi x x_phi by a displacement: its integral with v is that of the volume's gradient.
std::array<double, 3> normal_variation(const CurvePoint& p, const SurfaceAmplitudes& a) {
    return {-p.r * a[2] - p.z1 * a[4], p.z1 * a[3] - p.r1 * a[5], p.r * a[0] + p.r1 * a[4]};
}

// [sigma P] : grad_Gamma v
double stress_work(const BasePoint& p, int mode, const VelocityFunction& v) {
    const double along_t = (p.tangent_r() * v.slope[0] + p.tangent_z() * v.slope[2]) / p.curve.g;
    const double along_n = (p.curve.normal_r * v.slope[0] + p.curve.normal_z * v.slope[2]) / p.curve.g;
    return p.f_t * along_n + p.stress_s * along_t + p.stress_phi * (mode * v.value[1] + v.value[0]) / p.curve.r;
}

class Assembler {
  public:
    Assembler(const ModeSpace& space, const BasePoints& base) : space_(space), base_(base) {
        const Index velocities = space.velocity_count(), scalars = space.vertical().dimension();
        const Index tensions = space.tension().splines().dimension();
        forms_.stiffness = forms_.by_concentration = forms_.carried_stress = Eigen::MatrixXd::Zero(velocities, scalars);
        forms_.divergence = Eigen::MatrixXd::Zero(tensions, velocities);
        forms_.divergence_variation = Eigen::MatrixXd::Zero(tensions, scalars);
        forms_.force_mass = Eigen::MatrixXd::Zero(velocities, space.force_count());
        forms_.turning = Eigen::MatrixXd::Zero(scalars, scalars);
        forms_.normal = forms_.along = Eigen::MatrixXd::Zero(scalars, velocities);
    }

    ModeForms operator()() {
        const MembraneSpace& membrane = space_.membrane();
        for (std::size_t i = 0; i < membrane.xi.size(); ++i) {
            const double xi = membrane.xi[i];
            const Index element = static_cast<Index>(i) / membrane.points_per_element();
            vertical_ = space_.vertical().basis(xi, element);
            tension_ = space_.tension().splines().basis(xi, element);
            force_ = space_.vertical_force().basis(xi);
            const BasisRow lateral = space_.lateral().basis(xi, element);
            velocities_ = velocity_functions(space_, lateral, vertical_);
            add_variations(i);
            add_constraints(i);
            add_masses(i, lateral);
        }
        return std::move(forms_);
    }

  private:
    const ModeSpace& space_;
    const BasePoints& base_;
    ModeForms forms_;
    BasisRow vertical_, tension_, force_;
    std::array<VelocityFunction, 3 * functions> velocities_{};

    [[nodiscard]] double weight(std::size_t i) const { return space_.membrane().weight[i]; }
    [[nodiscard]] double area(std::size_t i) const {
        return weight(i) * base_.points[i].curve.r * base_.points[i].curve.g;
    }

    void add_variations(std::size_t i) {
        const BasePoint& p = base_.points[i];
        const double dxi = weight(i), da = area(i);
        const SurfaceJet& energy = base_.energy[i];
        for (std::size_t k = 0; k < functions; ++k) {
            const Index column = vertical_.index[k];
            const double value = vertical_.value[0][k];
            const SurfaceAmplitudes w = normal_displacement(space_.mode(), p, vertical_, k);
            const SurfaceAmplitudes image = hessian_times(energy, w);
            const SurfaceAmplitudes by_c =
                hessian_times(energy, concentration_amplitudes(space_.mode(), derivatives(vertical_, k)));
            const auto turned = normal_variation(p.curve, w);
            for (const VelocityFunction& v : velocities_) {
                const double volume = v.value[0] * turned[0] + v.value[1] * turned[1] + v.value[2] * turned[2];
                forms_.stiffness(v.index, column) += dxi * (dot(v.amplitudes, image) + base_.pressure * volume);
                forms_.by_concentration(v.index, column) += dxi * dot(v.amplitudes, by_c);
                forms_.carried_stress(v.index, column) += da * value * stress_work(p, space_.mode(), v);
            }
        }
    }

    void add_constraints(std::size_t i) {
        const BasePoint& p = base_.points[i];
        const SurfaceAmplitudes flow = surface_amplitudes(0, p.u_r, {}, p.u_z);
        const SurfaceAmplitudes image = hessian_times(base_.area[i], flow);
        for (std::size_t t = 0; t < static_cast<std::size_t>(tension_.count); ++t) {
            const double test = weight(i) * tension_.value[0][t];
            for (const VelocityFunction& v : velocities_) {
                forms_.divergence(tension_.index[t], v.index) += test * dot(base_.area[i].partial, v.amplitudes);
            }
            for (std::size_t k = 0; k < functions; ++k) {
                forms_.divergence_variation(tension_.index[t], vertical_.index[k]) +=
                    test * dot(image, normal_displacement(space_.mode(), p, vertical_, k));
            }
        }
    }

    void add_masses(std::size_t i, const BasisRow& lateral) {
        const BasePoint& p = base_.points[i];
        const double da = area(i);
        const Index count = space_.lateral().dimension();
        for (std::size_t j = 0; j < functions; ++j) {
            const Index row = vertical_.index[j];
            const double test = da * vertical_.value[0][j];
            for (std::size_t k = 0; k < functions; ++k) {
                forms_.turning(row, vertical_.index[k]) += test * vertical_.value[0][k] * p.turning * p.c_s;
                const double across = da * lateral.value[0][j] * lateral.value[0][k];
                forms_.force_mass(lateral.index[j], lateral.index[k]) += across;
                forms_.force_mass(count + lateral.index[j], count + lateral.index[k]) += across;
                forms_.force_mass(2 * count + row, 2 * count + force_.index[k]) += test * force_.value[0][k];
            }
            for (const VelocityFunction& v : velocities_) {
                forms_.normal(row, v.index) += test * (p.curve.normal_r * v.value[0] + p.curve.normal_z * v.value[2]);
                forms_.along(row, v.index) += test * p.c_s * (p.tangent_r() * v.value[0] + p.tangent_z() * v.value[2]);
            }
        }
    }
};

}  // namespace

SurfaceAmplitudes normal_displacement(int mode, const BasePoint& p, const BasisRow& row, std::size_t k) {
    const Derivatives2 w = derivatives(row, k);
    return surface_amplitudes(mode, product(w, p.normal_r), {}, product(w, p.normal_z));
}

BasePoints base_points(const MembraneSpace& space, const BaseState& base, const MembraneEnergy& energy,
                       const Viscosities& viscosities) {
    BasePoints result;
    result.pressure = base.multipliers.pressure;
    for (std::size_t i = 0; i < space.xi.size(); ++i) {
        const Index element = static_cast<Index>(i) / space.points_per_element();
        result.points.push_back(base_point(space, base, viscosities, space.xi[i], element));
        const BasePoint& p = result.points.back();
        SurfaceDensities densities = surface_densities(p.curve, p.c, p.c_s * p.curve.g, energy);
        result.energy.push_back(densities.energy + p.tension * densities.area);
        result.area.push_back(densities.area);
        result.curvature.push_back(densities.curvature);
    }
    return result;
}

ModeForms mode_forms(const ModeSpace& space, const BasePoints& base) {
    return Assembler(space, base)();
}

}  // namespace endoflow::boundary_integral
