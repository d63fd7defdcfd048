#include "boundary_integral/membrane/external_loads.h"

#include <numbers>

#include "boundary_integral/membrane/energy.h"
#include "shared/numerics/gauss_legendre.h"
#include "shared/numerics/lagrange.h"

namespace endoflow::boundary_integral {

namespace {

using LabelJet = Jet<1>;

/// Integrals over the interpolation polynomials from -1 to the nodes: (i, j) = ∫_{-1}^{x_i} L_j.
Eigen::MatrixXd partial_integrals(const QuadratureRule& rule) {
    const auto count = static_cast<Index>(rule.nodes.size());
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(count, count);
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        const double half = 0.5 * (rule.nodes[i] + 1.0);
        for (std::size_t q = 0; q < rule.nodes.size(); ++q) {
            const std::vector<double> at = lagrange_weights(rule.nodes, -1.0 + half * (1.0 + rule.nodes[q]));
            result.row(static_cast<Index>(i)) += half * rule.weights[q] * Eigen::RowVectorXd::Map(at.data(), count);
        }
    }
    return result;
}

/// ∫_0^ξ of functions given by their values at the Gauss points, at these points; a column is a function.
Eigen::MatrixXd running_integral(const MembraneSpace& space, const Eigen::MatrixXd& values) {
    const Index q = space.points_per_element();
    const Eigen::MatrixXd within = 0.5 * space.element_width() * partial_integrals(gauss_legendre(static_cast<int>(q)));
    Eigen::MatrixXd result(values.rows(), values.cols());
    Eigen::RowVectorXd before = Eigen::RowVectorXd::Zero(values.cols());
    for (Index first = 0; first < values.rows(); first += q) {
        result.middleRows(first, q) = (within * values.middleRows(first, q)).rowwise() + before;
        for (Index i = first; i < first + q; ++i) before += space.weight[static_cast<std::size_t>(i)] * values.row(i);
    }
    return result;
}

/// Along r and along z.
struct MaterialForce {
    LabelJet radial, axial;
};

/// What rides on the material per area at the Gauss points [pN/nm²] and its derivative by the area from the pole.
std::vector<MaterialForce> material_forces(const MembraneSpace& space, const MembraneSamples& samples,
                                           const Loads& loads) {
    Eigen::VectorXd density(space.points());
    for (Index i = 0; i < space.points(); ++i) {
        const CurvePoint& p = samples.curve[static_cast<std::size_t>(i)];
        density[i] = 2.0 * std::numbers::pi * p.r * p.g;
    }
    const Eigen::MatrixXd area = running_integral(space, density);
    std::vector<MaterialForce> forces;
    for (Index i = 0; i < space.points(); ++i) {
        const auto a = LabelJet::variable(area(i, 0), 0);
        forces.push_back({loads.radial_force(a), loads.material_force(a)});
    }
    return forces;
}

/// F_a/∫ c dA, pN/nm²; 0 without a force on the coat.
double force_on_coat(const MembraneSpace& space, const MembraneSamples& samples, const Loads& loads) {
    if (loads.coat_force == 0.0) return 0.0;
    double coat = 0.0;
    for (std::size_t i = 0; i < space.xi.size(); ++i)
        coat += space.weight[i] * samples.c[i] * samples.curve[i].r * samples.curve[i].g;
    return loads.coat_force / (2.0 * std::numbers::pi * coat);
}

}  // namespace

Eigen::VectorXd external_load(const MembraneSpace& space, const MembraneSamples& samples, const Loads& loads) {
    Eigen::VectorXd load = Eigen::VectorXd::Zero(space.curve_count());
    if (loads.none()) return load;
    if (loads.pressure != 0.0) load += loads.pressure * volume_gradient(space, samples).transpose();
    if (loads.carried()) {
        const std::vector<MaterialForce> on_material = material_forces(space, samples, loads);
        const double on_coat = force_on_coat(space, samples, loads);
        for (std::size_t i = 0; i < space.xi.size(); ++i) {
            const CurvePoint& p = samples.curve[i];
            const BasisRow &radial = space.radial_rows[i], &axial = space.axial_rows[i];
            const double area = space.weight[i] * p.r * p.g;
            const double along_r = area * on_material[i].radial.value,
                         along_z = area * (on_material[i].axial.value + on_coat * samples.c[i]);
            for (std::size_t j = 0; j < 6; ++j) {
                load[radial.index[j]] += along_r * radial.value[0][j];
                load[space.radial_count() + axial.index[j]] += along_z * axial.value[0][j];
            }
        }
    }
    load[space.radial_count() - 1] += loads.rim_tension * samples.rim_radius;
    return load;
}

CarriedLoadDerivatives carried_load_derivatives(const MembraneSpace& space, const MembraneSamples& samples,
                                                const Loads& loads) {
    const Index offset = space.radial_count();
    Eigen::MatrixXd density = Eigen::MatrixXd::Zero(space.points(), space.curve_count());  // variation of r g
    for (std::size_t i = 0; i < space.xi.size(); ++i) {
        const CurvePoint& p = samples.curve[i];
        const BasisRow &radial = space.radial_rows[i], &axial = space.axial_rows[i];
        const auto row = static_cast<Index>(i);
        for (std::size_t j = 0; j < 6; ++j) {
            density(row, radial.index[j]) += p.g * radial.value[0][j] + p.r * p.r1 / p.g * radial.value[1][j];
            density(row, offset + axial.index[j]) += p.r * p.z1 / p.g * axial.value[1][j];
        }
    }
    const Eigen::MatrixXd area = 2.0 * std::numbers::pi * running_integral(space, density);
    const std::vector<MaterialForce> on_material = material_forces(space, samples, loads);
    const double on_coat = force_on_coat(space, samples, loads);
    // Variations of ∫ c r g dξ.
    Eigen::RowVectorXd coat_by_curve = Eigen::RowVectorXd::Zero(space.curve_count());
    Eigen::RowVectorXd coat_by_c = Eigen::RowVectorXd::Zero(space.axial_count());
    for (std::size_t i = 0; i < space.xi.size(); ++i) {
        const CurvePoint& p = samples.curve[i];
        const BasisRow& axial = space.axial_rows[i];
        coat_by_curve += space.weight[i] * samples.c[i] * density.row(static_cast<Index>(i));
        for (std::size_t j = 0; j < 6; ++j)
            coat_by_c[axial.index[j]] += space.weight[i] * p.r * p.g * axial.value[0][j];
    }
    // F_a/∫ c dA falls by this part of itself for each nm² that ∫ c r g dξ gains.
    const double per_coat = loads.coat_force == 0.0 ? 0.0 : 2.0 * std::numbers::pi * on_coat / loads.coat_force;
    CarriedLoadDerivatives result{Eigen::MatrixXd::Zero(space.curve_count(), space.curve_count()),
                                  Eigen::MatrixXd::Zero(space.curve_count(), space.axial_count())};
    for (std::size_t i = 0; i < space.xi.size(); ++i) {
        const CurvePoint& p = samples.curve[i];
        const BasisRow &radial = space.radial_rows[i], &axial = space.axial_rows[i];
        const auto row = static_cast<Index>(i);
        const double weight = space.weight[i], area_element = p.r * p.g, coat = on_coat * samples.c[i];
        const auto ridden = [&](const LabelJet& force) -> Eigen::RowVectorXd {
            return weight * (force.value * density.row(row) + area_element * force.partial[0] * area.row(row));
        };
        const Eigen::RowVectorXd radial_by_curve = ridden(on_material[i].radial);
        const Eigen::RowVectorXd by_curve =
            ridden(on_material[i].axial) + weight * coat * (density.row(row) - area_element * per_coat * coat_by_curve);
        Eigen::RowVectorXd by_c = -weight * area_element * per_coat * coat * coat_by_c;
        for (std::size_t j = 0; j < 6; ++j) by_c[axial.index[j]] += weight * area_element * on_coat * axial.value[0][j];
        for (std::size_t j = 0; j < 6; ++j) {
            result.by_curve.row(radial.index[j]) += radial.value[0][j] * radial_by_curve;
            result.by_curve.row(offset + axial.index[j]) += axial.value[0][j] * by_curve;
            result.by_c.row(offset + axial.index[j]) += axial.value[0][j] * by_c;
        }
    }
    return result;
}

}  // namespace endoflow::boundary_integral
