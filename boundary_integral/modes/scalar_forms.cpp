#include "boundary_integral/modes/mode_forms.h"
#include "boundary_integral/transport/surface_transport.h"

namespace endoflow::boundary_integral {

namespace {

constexpr std::size_t functions = BasisRow::capacity;

// sum over Gauss points of  psi_j^(rows) weight(i) psi_k^(columns)
template <class Weight>
Eigen::MatrixXd scalar_form(const ModeSpace& space, std::size_t row_derivative, std::size_t column_derivative,
                            Weight weight) {
    const SplineSpace& splines = space.vertical();
    const MembraneSpace& membrane = space.membrane();
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(splines.dimension(), splines.dimension());
    for (std::size_t i = 0; i < membrane.xi.size(); ++i) {
        const BasisRow row = splines.basis(membrane.xi[i], static_cast<Index>(i) / membrane.points_per_element());
        const double w = membrane.weight[i] * weight(i);
        for (std::size_t j = 0; j < functions; ++j) {
            for (std::size_t k = 0; k < functions; ++k) {
                matrix(row.index[j], row.index[k]) +=
                    w * row.value[row_derivative][j] * row.value[column_derivative][k];
            }
        }
    }
    return matrix;
}

// Values and slopes of an axisymmetric scalar at the Gauss points.
struct Profile {
    std::vector<double> value, slope;
};

Profile profile_of(const MembraneSpace& membrane, const Eigen::VectorXd& coefficients) {
    Profile profile;
    for (const BasisRow& row : membrane.axial_rows) {
        profile.value.push_back(row.evaluate(coefficients, 0));
        profile.slope.push_back(row.evaluate(coefficients, 1));
    }
    return profile;
}

// mu = p(c) - k Laplacian of c of the base state.
Profile chemical_potential(const MembraneSpace& membrane, const BaseState& base, const MembraneSamples& samples,
                           const TransportLaw& law) {
    Eigen::VectorXd weak = law.edge_width * (surface_stiffness_matrix(membrane, samples.curve) * base.membrane.c);
    for (std::size_t i = 0; i < membrane.xi.size(); ++i) {
        const BasisRow& row = membrane.axial_rows[i];
        const CurvePoint& p = samples.curve[i];
        const double value = membrane.weight[i] * p.r * p.g * law.potential(samples.c[i]).value;
        for (std::size_t j = 0; j < functions; ++j) weak[row.index[j]] += value * row.value[0][j];
    }
    return profile_of(membrane, concentration_from_moments(membrane, samples.curve, weak));
}

class Diffusion {
  public:
    Diffusion(const ModeSpace& space, const BaseState& base, const BasePoints& points, const TransportLaw& law)
        : space_(space),
          base_(base),
          points_(points.points),
          law_(law),
          samples_(sample(space.membrane(), base.membrane)),
          expansion_(space.scalar().expansion()) {}

    // mu = p(c): diffusion of second order.
    [[nodiscard]] DiffusionForms second_order() const {
        Profile potential;
        for (std::size_t i = 0; i < points_.size(); ++i) {
            potential.value.push_back(local(i).value);
            potential.slope.push_back(local(i).first * samples_.c1[i]);
        }
        const Eigen::MatrixXd by_c = dirichlet_form([&](std::size_t i) { return local(i).first; }) +
                                     scalar_form(space_, 1, 0, [&](std::size_t i) {
                                         return local(i).second * samples_.c1[i] * curve(i).r / curve(i).g;
                                     });
        return {-law_.mobility * by_c, -law_.mobility * (metric_variation(potential) + rate_variation(potential))};
    }

    // M mu' = k K c' + p'(c) c' + what the displacement does to mu's equation.
    [[nodiscard]] DiffusionForms fourth_order() const {
        const Profile c = {samples_.c, samples_.c1};
        const Profile mu = chemical_potential(space_.membrane(), base_, samples_, law_);
        const Eigen::MatrixXd stiffness = dirichlet_form([](std::size_t) { return 1.0; });
        const Eigen::MatrixXd mu_by_c = law_.edge_width * stiffness + scalar_form(space_, 0, 0, [&](std::size_t i) {
                                            return local(i).first * area(i);
                                        });
        const Eigen::MatrixXd mu_by_w =
            law_.edge_width * metric_variation(c) + scalar_form(space_, 0, 0, [&](std::size_t i) {
                return (local(i).value - mu.value[i]) * curve(i).total_curvature() * area(i);
            });
        const Eigen::MatrixXd mass = scalar_form(space_, 0, 0, [&](std::size_t i) { return area(i); });
        const LuFactors factors(expansion_.transpose() * mass * expansion_, "concentration mass");
        const auto through_mu = [&](const Eigen::MatrixXd& weak) {
            return Eigen::MatrixXd(stiffness * expansion_ * factors.solve(expansion_.transpose() * weak));
        };
        return {-law_.mobility * through_mu(mu_by_c),
                -law_.mobility * (through_mu(mu_by_w) + metric_variation(mu) + rate_variation(mu))};
    }

  private:
    const ModeSpace& space_;
    const BaseState& base_;
    const std::vector<BasePoint>& points_;
    const TransportLaw& law_;
    MembraneSamples samples_;
    Eigen::MatrixXd expansion_;

    [[nodiscard]] const CurvePoint& curve(std::size_t i) const { return points_[i].curve; }
    [[nodiscard]] double area(std::size_t i) const { return curve(i).r * curve(i).g; }

    [[nodiscard]] ValueAndDerivatives local(std::size_t i) const { return law_.potential(samples_.c[i]); }

    // int factor grad psi . grad c dA
    template <class Factor>
    [[nodiscard]] Eigen::MatrixXd dirichlet_form(Factor factor) const {
        const double m = space_.mode();
        return scalar_form(space_, 1, 1, [&](std::size_t i) { return factor(i) * curve(i).r / curve(i).g; }) +
               m * m * scalar_form(space_, 0, 0, [&](std::size_t i) { return factor(i) * curve(i).g / curve(i).r; });
    }

    // Variation of int grad psi . grad a dA for an axisymmetric a: sqrt(G/E) grows by w (kappa_p - kappa_m).
    [[nodiscard]] Eigen::MatrixXd metric_variation(const Profile& a) const {
        return scalar_form(space_, 1, 0, [&](std::size_t i) {
            const CurvePoint& p = curve(i);
            return (p.azimuthal_curvature - p.meridional_curvature) * p.r / p.g * a.slope[i];
        });
    }

    // The rate itself is weighted with the area, which grows by w kappa: minus int psi w kappa (Laplacian of mu) dA,
    // with M (Laplacian of mu) = - K mu.
    [[nodiscard]] Eigen::MatrixXd rate_variation(const Profile& mu) const {
        const MembraneSpace& membrane = space_.membrane();
        Eigen::VectorXd weak = Eigen::VectorXd::Zero(membrane.axial_count());
        for (std::size_t i = 0; i < membrane.xi.size(); ++i) {
            const BasisRow& row = membrane.axial_rows[i];
            const double flux = -membrane.weight[i] * curve(i).r / curve(i).g * mu.slope[i];
            for (std::size_t j = 0; j < functions; ++j) weak[row.index[j]] += flux * row.value[1][j];
        }
        const Profile laplacian = profile_of(membrane, concentration_from_moments(membrane, samples_.curve, weak));
        return scalar_form(space_, 0, 0,
                           [&](std::size_t i) { return laplacian.value[i] * curve(i).total_curvature() * area(i); });
    }
};

}  // namespace

Eigen::MatrixXd scalar_mass(const ModeSpace& space, const BasePoints& base) {
    return scalar_form(space, 0, 0, [&](std::size_t i) { return base.points[i].curve.r * base.points[i].curve.g; });
}

Eigen::MatrixXd carrying_form(const ModeSpace& space, const BasePoints& base, const std::vector<double>& speed) {
    return scalar_form(space, 0, 1, [&](std::size_t i) { return speed[i] * base.points[i].curve.r; });
}

DiffusionForms diffusion_forms(const ModeSpace& space, const BaseState& base, const BasePoints& points,
                               const TransportLaw& law) {
    if (law.mobility == 0.0) {
        const Index count = space.vertical().dimension();
        return {Eigen::MatrixXd::Zero(count, count), Eigen::MatrixXd::Zero(count, count)};
    }
    const Diffusion diffusion(space, base, points, law);
    return law.edge_width == 0.0 ? diffusion.second_order() : diffusion.fourth_order();
}

}  // namespace endoflow::boundary_integral
