#include "boundary_integral/transport/surface_transport.h"

namespace endoflow::boundary_integral {

namespace {

/// Sum over points of weight(i) * φ_a^(da) φ_b^(db)
template <class Weight>
Eigen::MatrixXd assemble(const MembraneSpace& space, std::size_t da, std::size_t db, Weight weight) {
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(space.axial_count(), space.axial_count());
    for (std::size_t i = 0; i < space.xi.size(); ++i) {
        const BasisRow& phi = space.axial_rows[i];
        const double w = space.weight[i] * weight(i);
        for (std::size_t a = 0; a < 6; ++a) {
            for (std::size_t b = 0; b < 6; ++b) {
                matrix(phi.index[a], phi.index[b]) += w * phi.value[da][a] * phi.value[db][b];
            }
        }
    }
    return matrix;
}

template <class Weight>
Eigen::VectorXd assemble_vector(const MembraneSpace& space, std::size_t derivative, Weight weight) {
    Eigen::VectorXd vector = Eigen::VectorXd::Zero(space.axial_count());
    for (std::size_t i = 0; i < space.xi.size(); ++i) {
        const BasisRow& phi = space.axial_rows[i];
        const double w = space.weight[i] * weight(i);
        for (std::size_t a = 0; a < 6; ++a) vector[phi.index[a]] += w * phi.value[derivative][a];
    }
    return vector;
}

/// Sum over points of  φ^(d) [ from_r δr + from_r1 δr' + from_z1 δz' ]
struct PointVariation {
    double r, r1, z1;
};
template <class Variation>
Eigen::MatrixXd assemble_variation(const MembraneSpace& space, std::size_t derivative, Variation variation) {
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(space.axial_count(), space.curve_count());
    const Index offset = space.radial_count();
    for (std::size_t i = 0; i < space.xi.size(); ++i) {
        const BasisRow& phi = space.axial_rows[i];
        const BasisRow& radial = space.radial_rows[i];
        const PointVariation v = variation(i);
        for (std::size_t a = 0; a < 6; ++a) {
            const double test = space.weight[i] * phi.value[derivative][a];
            for (std::size_t b = 0; b < 6; ++b) {
                matrix(phi.index[a], radial.index[b]) += test * (v.r * radial.value[0][b] + v.r1 * radial.value[1][b]);
                matrix(phi.index[a], offset + phi.index[b]) += test * v.z1 * phi.value[1][b];
            }
        }
    }
    return matrix;
}

/// δ(r g) and δ(r/g), times a factor
PointVariation area_variation(const CurvePoint& p, double factor) {
    return {factor * p.g, factor * p.r * p.r1 / p.g, factor * p.r * p.z1 / p.g};
}
PointVariation conductance_variation(const CurvePoint& p, double factor) {
    const double cubed = p.g * p.g * p.g;
    return {factor / p.g, -factor * p.r * p.r1 / cubed, -factor * p.r * p.z1 / cubed};
}

/// M μ of a law with an edge width: k K c + ∫ p(c) φ dA, or d(E + E_c)/dc.
Eigen::VectorXd weak_potential(const MembraneSpace& space, const MembraneSamples& samples, const Eigen::VectorXd& c,
                               const TransportLaw& law, const EnergyDerivatives& energy,
                               const Eigen::MatrixXd& stiffness) {
    if (law.energetic) return energy.gradient_c;
    return law.edge_width * (stiffness * c) + assemble_vector(space, 0, [&](std::size_t i) {
               return law.potential(samples.c[i]).value * samples.curve[i].r * samples.curve[i].g;
           });
}

/// Of k K c + ∫ p(c) φ dA.
struct WeakVariation {
    Eigen::MatrixXd from_c, from_curve;
};
WeakVariation law_potential_variation(const MembraneSpace& space, const MembraneSamples& samples,
                                      const TransportLaw& law, const Eigen::MatrixXd& stiffness) {
    const auto& curve = samples.curve;
    WeakVariation result{
        law.edge_width * stiffness +
            assemble(space, 0, 0,
                     [&](std::size_t i) { return law.potential(samples.c[i]).first * curve[i].r * curve[i].g; }),
        assemble_variation(
            space, 1, [&](std::size_t i) { return conductance_variation(curve[i], law.edge_width * samples.c1[i]); })};
    result.from_curve += assemble_variation(
        space, 0, [&](std::size_t i) { return area_variation(curve[i], law.potential(samples.c[i]).value); });
    return result;
}

/// ∫ (r/g) p'(c) φ_i' φ_j' dξ: diffusion of second order
Eigen::MatrixXd diffusion_matrix(const MembraneSpace& space, const MembraneSamples& samples, const TransportLaw& law) {
    return assemble(space, 1, 1, [&](std::size_t i) {
        return samples.curve[i].r / samples.curve[i].g * law.potential(samples.c[i]).first;
    });
}

}  // namespace

Eigen::MatrixXd surface_mass_matrix(const MembraneSpace& space, const std::vector<CurvePoint>& curve) {
    return assemble(space, 0, 0, [&](std::size_t i) { return curve[i].r * curve[i].g; });
}

Eigen::MatrixXd surface_stiffness_matrix(const MembraneSpace& space, const std::vector<CurvePoint>& curve) {
    return assemble(space, 1, 1, [&](std::size_t i) { return curve[i].r / curve[i].g; });
}

Eigen::VectorXd concentration_from_moments(const MembraneSpace& space, const std::vector<CurvePoint>& curve,
                                           const Eigen::VectorXd& moments) {
    return LuFactors(surface_mass_matrix(space, curve), "concentration mass").solve(moments);
}

Eigen::VectorXd diffusion_rate(const MembraneSpace& space, const MembraneSamples& samples, const Eigen::VectorXd& c,
                               const TransportLaw& law, const EnergyDerivatives& energy) {
    if (law.mobility == 0) return Eigen::VectorXd::Zero(space.axial_count());
    if (law.edge_width == 0) return -law.mobility * (diffusion_matrix(space, samples, law) * c);
    const Eigen::MatrixXd stiffness = surface_stiffness_matrix(space, samples.curve);
    const LuFactors mass(surface_mass_matrix(space, samples.curve), "concentration mass");
    return -law.mobility * (stiffness * mass.solve(weak_potential(space, samples, c, law, energy, stiffness)));
}

Eigen::VectorXd advection_rate(const MembraneSpace& space, const MembraneSamples& samples,
                               const std::vector<double>& relative_velocity) {
    return assemble_vector(space, 1,
                           [&](std::size_t i) { return samples.c[i] * samples.curve[i].r * relative_velocity[i]; });
}

Eigen::MatrixXd advection_from_mesh_velocity(const MembraneSpace& space, const MembraneSamples& samples) {
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(space.axial_count(), space.curve_count());
    for (std::size_t i = 0; i < space.xi.size(); ++i) {
        const CurvePoint& p = samples.curve[i];
        const BasisRow& radial = space.radial_rows[i];
        const BasisRow& phi = space.axial_rows[i];
        const double flux = -space.weight[i] * samples.c[i] * p.r / p.g;
        for (std::size_t a = 0; a < 6; ++a) {
            for (std::size_t b = 0; b < 6; ++b) {
                matrix(phi.index[a], radial.index[b]) += flux * phi.value[1][a] * p.r1 * radial.value[0][b];
                matrix(phi.index[a], space.radial_count() + phi.index[b]) +=
                    flux * phi.value[1][a] * p.z1 * phi.value[0][b];
            }
        }
    }
    return matrix;
}

TransportDerivatives transport_derivatives(const MembraneSpace& space, const MembraneSamples& samples,
                                           const Eigen::VectorXd& c, const TransportLaw& law,
                                           const EnergyDerivatives& energy,
                                           const std::vector<double>& relative_velocity) {
    TransportDerivatives result;
    const auto& curve = samples.curve;
    result.c_from_moments = inverse(surface_mass_matrix(space, curve), "concentration mass");
    const Eigen::MatrixXd& inverse_mass = result.c_from_moments;
    result.c_from_curve = -inverse_mass * assemble_variation(space, 0, [&](std::size_t i) {
        return area_variation(curve[i], samples.c[i]);
    });
    result.rate_from_c = assemble(space, 1, 0, [&](std::size_t i) { return curve[i].r * relative_velocity[i]; });
    result.rate_from_curve = assemble_variation(space, 1, [&](std::size_t i) {
        return PointVariation{samples.c[i] * relative_velocity[i], 0.0, 0.0};
    });
    if (law.mobility == 0) return result;

    if (law.edge_width == 0) {
        result.rate_from_c -=
            law.mobility * (diffusion_matrix(space, samples, law) + assemble(space, 1, 0, [&](std::size_t i) {
                                return curve[i].r / curve[i].g * law.potential(samples.c[i]).second * samples.c1[i];
                            }));
        result.rate_from_curve -=
            law.mobility * assemble_variation(space, 1, [&](std::size_t i) {
                return conductance_variation(curve[i], law.potential(samples.c[i]).first * samples.c1[i]);
            });
        return result;
    }
    const Eigen::MatrixXd stiffness = surface_stiffness_matrix(space, curve);
    const Eigen::VectorXd mu = inverse_mass * weak_potential(space, samples, c, law, energy, stiffness);
    const WeakVariation potential = law.energetic ? WeakVariation{energy.second_c, energy.mixed.transpose()}
                                                  : law_potential_variation(space, samples, law, stiffness);
    result.rate_from_c -= law.mobility * stiffness * (inverse_mass * potential.from_c);
    const Eigen::MatrixXd weak_from_curve = potential.from_curve - assemble_variation(space, 0, [&](std::size_t i) {
                                                return area_variation(curve[i], space.axial_rows[i].evaluate(mu, 0));
                                            });
    result.rate_from_curve -= law.mobility * (stiffness * (inverse_mass * weak_from_curve));
    result.rate_from_curve -= law.mobility * assemble_variation(space, 1, [&](std::size_t i) {
                                  return conductance_variation(curve[i], space.axial_rows[i].evaluate(mu, 1));
                              });
    return result;
}

}  // namespace endoflow::boundary_integral
