#include <numbers>
#include <utility>

#include "boundary_integral/modes/mode_forms.h"
#include "boundary_integral/transport/surface_transport.h"

namespace endoflow::boundary_integral {

namespace {

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
        for (std::size_t j = 0; j < BasisRow::capacity; ++j) {
            for (std::size_t k = 0; k < BasisRow::capacity; ++k) {
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

SurfaceAmplitudes concentration_of(int mode, const BasisRow& row, std::size_t j) {
    return concentration_amplitudes(mode, {row.value[0][j], row.value[1][j], row.value[2][j]});
}

Profile profile_of(const MembraneSpace& membrane, const Eigen::VectorXd& coefficients) {
    Profile profile;
    for (const BasisRow& row : membrane.axial_rows) {
        profile.value.push_back(row.evaluate(coefficients, 0));
        profile.slope.push_back(row.evaluate(coefficients, 1));
    }
    return profile;
}

// sum over Gauss points of  weight  row_j . (second derivatives of the energy) . column_k,  rows being concentrations
template <class Columns>
Eigen::MatrixXd energy_form(const ModeSpace& space, const BasePoints& base, Columns columns) {
    const SplineSpace& splines = space.vertical();
    const MembraneSpace& membrane = space.membrane();
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(splines.dimension(), splines.dimension());
    for (std::size_t i = 0; i < membrane.xi.size(); ++i) {
        const BasisRow row = splines.basis(membrane.xi[i], static_cast<Index>(i) / membrane.points_per_element());
        for (std::size_t k = 0; k < BasisRow::capacity; ++k) {
            const SurfaceAmplitudes image = hessian_times(base.energy[i], columns(i, row, k));
            for (std::size_t j = 0; j < BasisRow::capacity; ++j) {
                matrix(row.index[j], row.index[k]) +=
                    membrane.weight[i] * dot(concentration_of(space.mode(), row, j), image);
            }
        }
    }
    return matrix;
}

// mu of a law with an edge width and its variation: M mu' = by_concentration c' + by_displacement w - int psi mu w
// kappa dA, the last for the area that mu is weighted with.
struct Potential {
    Profile value;
    Eigen::MatrixXd by_concentration, by_displacement;
};

class Diffusion {
  public:
    Diffusion(const ModeSpace& space, const BaseState& base, const BasePoints& points, const TransportLaw& law)
        : space_(space),
          base_points_(points),
          points_(points.points),
          law_(law),
          samples_(sample(space.membrane(), base.membrane)),
          expansion_(space.scalar().expansion()) {}

    // mu = p(c): diffusion of second order.
    [[nodiscard]] MoleculeForms second_order() const {
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

    // Of fourth order: d c'/dt = - M (stiffness) mu'.
    [[nodiscard]] MoleculeForms fourth_order() const {
        const Potential mu = law_.energetic ? of_energy() : of_law();
        const Eigen::MatrixXd stiffness = dirichlet_form([](std::size_t) { return 1.0; });
        const Eigen::MatrixXd mass = scalar_form(space_, 0, 0, [&](std::size_t i) { return area(i); });
        const Eigen::MatrixXd of_area = scalar_form(
            space_, 0, 0, [&](std::size_t i) { return mu.value.value[i] * curve(i).total_curvature() * area(i); });
        const LuFactors factors(expansion_.transpose() * mass * expansion_, "concentration mass");
        const auto through_mu = [&](const Eigen::MatrixXd& weak) {
            return Eigen::MatrixXd(stiffness * expansion_ * factors.solve(expansion_.transpose() * weak));
        };
        return {-law_.mobility * through_mu(mu.by_concentration),
                -law_.mobility *
                    (through_mu(mu.by_displacement - of_area) + metric_variation(mu.value) + rate_variation(mu.value))};
    }

  private:
    const ModeSpace& space_;
    const BasePoints& base_points_;
    const std::vector<BasePoint>& points_;
    const TransportLaw& law_;
    MembraneSamples samples_;
    Eigen::MatrixXd expansion_;

    [[nodiscard]] const CurvePoint& curve(std::size_t i) const { return points_[i].curve; }
    [[nodiscard]] double area(std::size_t i) const { return curve(i).r * curve(i).g; }

    [[nodiscard]] ValueAndDerivatives local(std::size_t i) const { return law_.potential(samples_.c[i]); }

    // Values and slopes of the axisymmetric function with int psi f dA = sum weight (value psi + slope psi').
    template <class Weak>
    [[nodiscard]] Profile from_weak(Weak weak_at) const {
        const MembraneSpace& membrane = space_.membrane();
        Eigen::VectorXd weak = Eigen::VectorXd::Zero(membrane.axial_count());
        for (std::size_t i = 0; i < membrane.xi.size(); ++i) {
            const BasisRow& row = membrane.axial_rows[i];
            const auto [value, slope] = weak_at(i);
            for (std::size_t j = 0; j < BasisRow::capacity; ++j)
                weak[row.index[j]] += membrane.weight[i] * (value * row.value[0][j] + slope * row.value[1][j]);
        }
        return profile_of(membrane, concentration_from_moments(membrane, samples_.curve, weak));
    }

    // mu = p(c) - k Laplacian of c
    [[nodiscard]] Potential of_law() const {
        const double k = law_.edge_width;
        const Profile c = {samples_.c, samples_.c1};
        return {from_weak([&](std::size_t i) {
                    return std::pair(local(i).value * area(i), k * samples_.c1[i] * curve(i).r / curve(i).g);
                }),
                k * dirichlet_form([](std::size_t) { return 1.0; }) +
                    scalar_form(space_, 0, 0, [&](std::size_t i) { return local(i).first * area(i); }),
                k * metric_variation(c) + scalar_form(space_, 0, 0, [&](std::size_t i) {
                    return local(i).value * curve(i).total_curvature() * area(i);
                })};
    }

    // mu = d(E + E_c)/dc
    [[nodiscard]] Potential of_energy() const {
        const int mode = space_.mode();
        return {from_weak([&](std::size_t i) {
                    const SurfaceJet& energy = base_points_.energy[i];
                    return std::pair(energy.partial[surface_concentration], energy.partial[surface_concentration + 1]);
                }),
                energy_form(
                    space_, base_points_,
                    [mode](std::size_t, const BasisRow& row, std::size_t k) { return concentration_of(mode, row, k); }),
                energy_form(space_, base_points_, [&](std::size_t i, const BasisRow& row, std::size_t k) {
                    return normal_displacement(mode, points_[i], row, k);
                })};
    }

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
        const Profile laplacian =
            from_weak([&](std::size_t i) { return std::pair(0.0, -curve(i).r / curve(i).g * mu.slope[i]); });
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

MoleculeForms diffusion_forms(const ModeSpace& space, const BaseState& base, const BasePoints& points,
                              const TransportLaw& law) {
    if (law.mobility == 0.0) {
        const Index count = space.vertical().dimension();
        return {Eigen::MatrixXd::Zero(count, count), Eigen::MatrixXd::Zero(count, count)};
    }
    const Diffusion diffusion(space, base, points, law);
    return law.edge_width == 0.0 ? diffusion.second_order() : diffusion.fourth_order();
}

// j' = (dj/dc) c' + (dj/d(de/dc)) (de/dc)', de/dc being a function of c and kappa.
MoleculeForms exchange_forms(const ModeSpace& space, const BasePoints& points, const ExchangeLaw& law,
                             const MembraneEnergy& bending) {
    const SplineSpace& splines = space.vertical();
    const MembraneSpace& membrane = space.membrane();
    MoleculeForms forms{Eigen::MatrixXd::Zero(splines.dimension(), splines.dimension()), {}};
    forms.by_displacement = forms.by_concentration;
    if (law.none()) return forms;
    const auto area = [&](std::size_t i) {
        return membrane.weight[i] * points.points[i].curve.r * points.points[i].curve.g;
    };
    double molecules = 0.0;
    for (std::size_t i = 0; i < membrane.xi.size(); ++i)
        molecules += 2.0 * std::numbers::pi * area(i) * points.points[i].c;
    for (std::size_t i = 0; i < membrane.xi.size(); ++i) {
        const BasePoint& p = points.points[i];
        const LocalJet e = bending.density(p.curve.total_curvature(), p.c, 0.0);
        const auto& by_c = e.second[local::concentration];
        const Dual<2> rate = law.rate(Dual<2>::variable(p.c, 0), Dual<2>::variable(e.partial[local::concentration], 1),
                                      Dual<2>(molecules));
        const double from_c = rate.partial[0] + rate.partial[1] * by_c[local::concentration];
        const double from_curvature = rate.partial[1] * by_c[local::curvature];
        const BasisRow row = splines.basis(membrane.xi[i], static_cast<Index>(i) / membrane.points_per_element());
        for (std::size_t k = 0; k < BasisRow::capacity; ++k) {
            const double curvature = dot(points.curvature[i], normal_displacement(space.mode(), p, row, k));
            for (std::size_t j = 0; j < BasisRow::capacity; ++j) {
                const double test = area(i) * row.value[0][j];
                forms.by_concentration(row.index[j], row.index[k]) += test * from_c * row.value[0][k];
                forms.by_displacement(row.index[j], row.index[k]) += test * from_curvature * curvature;
            }
        }
    }
    return forms;
}

}  // namespace endoflow::boundary_integral
