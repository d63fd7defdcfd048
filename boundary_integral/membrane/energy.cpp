#include "boundary_integral/membrane/energy.h"

#include <algorithm>

#include "boundary_integral/membrane/jet.h"

namespace endoflow::boundary_integral {

namespace {

// What the energy density depends on at one point.
enum Variable : std::size_t { var_r, var_r1, var_r2, var_z1, var_z2, var_c, variable_count };
using EnergyJet = Jet<variable_count>;
using EnergyGradient = Gradient<variable_count>;

EnergyJet volume_jet(const CurvePoint& p) {
    const EnergyJet r = EnergyJet::variable(p.r, var_r);
    const EnergyJet twice = r * r * EnergyJet::variable(p.z1, var_z1);
    return combine(-0.5, twice, 0.0, twice);
}

// `Type` is EnergyJet or EnergyGradient.
template <class Type>
struct AreaJets {
    Type r, r1, r2, z1, z2, g, area;  // area = r g
};

template <class Type>
AreaJets<Type> area_jets(const CurvePoint& p) {
    AreaJets<Type> jets;
    jets.r = Type::variable(p.r, var_r);
    jets.r1 = Type::variable(p.r1, var_r1);
    jets.r2 = Type::variable(p.r2, var_r2);
    jets.z1 = Type::variable(p.z1, var_z1);
    jets.z2 = Type::variable(p.z2, var_z2);
    jets.g = sqrt(jets.r1 * jets.r1 + jets.z1 * jets.z1);
    jets.area = jets.r * jets.g;
    return jets;
}

// 1/2 beta(c) (kappa - C(c))^2 r g, with (kappa - C) r g = -r (r' z'' - z' r'')/g^2 - z' - C r g
template <class Type>
Type energy_density(const AreaJets<Type>& jets, double c, const BendingModel& model) {
    const Type concentration = Type::variable(c, var_c);
    const ValueAndDerivatives beta = model.stiffness(c);
    const ValueAndDerivatives spontaneous = model.spontaneous_curvature(c);
    const Type stiffness = chain(concentration, beta.value, beta.first, beta.second);
    const Type curvature = chain(concentration, spontaneous.value, spontaneous.first, spontaneous.second);
    const Type cross = jets.r1 * jets.z2 - jets.z1 * jets.r2;
    const Type excess =
        Type::constant(0.0) - jets.r * cross * reciprocal(jets.g * jets.g) - jets.z1 - curvature * jets.area;
    const Type twice = stiffness * excess * excess * reciprocal(jets.area);
    return combine(0.5, twice, 0.0, twice);
}

// One basis function seen by one variable.
struct Slot {
    Index row;                                   // coefficient index in (r, z) or in c
    std::array<double, variable_count> partial;  // d(variable)/d(coefficient)
};

struct LocalSlots {
    std::array<Slot, 12> curve;
    std::array<Slot, 6> concentration;
};

LocalSlots local_slots(const BasisRow& radial, const BasisRow& axial, Index radial_count) {
    LocalSlots slots{};
    for (std::size_t j = 0; j < 6; ++j) {
        slots.curve[j].row = radial.index[j];
        slots.curve[j].partial = {radial.value[0][j], radial.value[1][j], radial.value[2][j], 0.0, 0.0, 0.0};
        slots.curve[6 + j].row = radial_count + axial.index[j];
        slots.curve[6 + j].partial = {0.0, 0.0, 0.0, axial.value[1][j], axial.value[2][j], 0.0};
        slots.concentration[j].row = axial.index[j];
        slots.concentration[j].partial = {0.0, 0.0, 0.0, 0.0, 0.0, axial.value[0][j]};
    }
    return slots;
}

double dot(const std::array<double, variable_count>& a, const std::array<double, variable_count>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < variable_count; ++i) sum += a[i] * b[i];
    return sum;
}

std::array<double, variable_count> hessian_times(const EnergyJet& jet,
                                                 const std::array<double, variable_count>& partial) {
    std::array<double, variable_count> result{};
    for (std::size_t i = 0; i < variable_count; ++i) result[i] = dot(jet.hessian[i], partial);
    return result;
}

void add_second_derivatives(const EnergyJet& jet, double weight, const LocalSlots& slots, EnergyDerivatives& result) {
    for (const Slot& column : slots.curve) {
        const auto image = hessian_times(jet, column.partial);
        for (const Slot& row : slots.curve) result.hessian(row.row, column.row) += weight * dot(row.partial, image);
    }
    for (const Slot& column : slots.concentration) {
        const auto image = hessian_times(jet, column.partial);
        for (const Slot& row : slots.curve) result.mixed(row.row, column.row) += weight * dot(row.partial, image);
    }
}

// One Gauss point's part of energy and gradients.
template <class Type>
void add_first_derivatives(const Type& density, double weight, const LocalSlots& slots, EnergyDerivatives& result) {
    result.energy += weight * density.value;
    for (const Slot& row : slots.curve) result.gradient[row.row] += weight * dot(density.gradient, row.partial);
    for (const Slot& row : slots.concentration) {
        result.gradient_c[row.row] += weight * dot(density.gradient, row.partial);
    }
}

}  // namespace

EnergyDerivatives bending_energy(const MembraneSpace& space, const MembraneState& state, const BendingModel& model,
                                 Derivatives wanted, const Multipliers& multipliers) {
    EnergyDerivatives result;
    result.gradient = Eigen::VectorXd::Zero(space.curve_count());
    result.gradient_c = Eigen::VectorXd::Zero(space.axial_count());
    if (wanted == Derivatives::second) {
        result.hessian = Eigen::MatrixXd::Zero(space.curve_count(), space.curve_count());
        result.mixed = Eigen::MatrixXd::Zero(space.curve_count(), space.axial_count());
    }
    for (std::size_t i = 0; i < space.xi.size(); ++i) {
        const CurvePoint p = curve_point(space.radial_rows[i], space.axial_rows[i], state);
        const double c = space.axial_rows[i].evaluate(state.c, 0);
        const LocalSlots slots = local_slots(space.radial_rows[i], space.axial_rows[i], space.radial_count());
        const double weight = space.weight[i];
        if (wanted == Derivatives::first) {
            add_first_derivatives(energy_density(area_jets<EnergyGradient>(p), c, model), weight, slots, result);
            continue;
        }
        const AreaJets jets = area_jets<EnergyJet>(p);
        EnergyJet density = energy_density(jets, c, model);
        add_first_derivatives(density, weight, slots, result);
        if (multipliers.tension.size() > 0) {
            density = combine(1.0, density, space.tension_rows[i].evaluate(multipliers.tension), jets.area);
            density = combine(1.0, density, multipliers.pressure, volume_jet(p));
        }
        add_second_derivatives(density, weight, slots, result);
    }
    return result;
}

double energy_density_at_rim(const MembraneSpace& space, const MembraneState& state, const BendingModel& model) {
    const CurvePoint rim = curve_point(space.radial().basis(1.0), space.axial().basis(1.0), state);
    return bending_energy_density(model, rim.total_curvature(), space.axial().basis(1.0).evaluate(state.c, 0)).value;
}

Eigen::MatrixXd divergence_matrix(const MembraneSpace& space, const MembraneSamples& samples) {
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(space.tension().dimension(), space.curve_count());
    for (std::size_t i = 0; i < space.xi.size(); ++i) {
        const CurvePoint& p = samples.curve[i];
        const BasisRow& mu = space.tension_rows[i];
        const BasisRow& radial = space.radial_rows[i];
        const BasisRow& axial = space.axial_rows[i];
        for (std::size_t j = 0; j < 6; ++j) {
            const double from_r = radial.value[0][j] * p.g + p.r * p.r1 / p.g * radial.value[1][j];
            const double from_z = p.r * p.z1 / p.g * axial.value[1][j];
            for (std::size_t k = 0; k < static_cast<std::size_t>(mu.count); ++k) {
                const double test = space.weight[i] * mu.value[0][k];
                matrix(mu.index[k], radial.index[j]) += test * from_r;
                matrix(mu.index[k], space.radial_count() + axial.index[j]) += test * from_z;
            }
        }
    }
    return matrix;
}

Eigen::MatrixXd divergence_variation(const MembraneSpace& space, const MembraneSamples& samples,
                                     const Eigen::VectorXd& velocity) {
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(space.tension().dimension(), space.curve_count());
    const Eigen::VectorXd u_r = velocity.head(space.radial_count());
    const Eigen::VectorXd u_z = velocity.tail(space.axial_count());
    for (std::size_t i = 0; i < space.xi.size(); ++i) {
        const AreaJets jets = area_jets<EnergyJet>(samples.curve[i]);
        const LocalSlots slots = local_slots(space.radial_rows[i], space.axial_rows[i], space.radial_count());
        const std::array<double, variable_count> direction = {space.radial_rows[i].evaluate(u_r, 0),
                                                              space.radial_rows[i].evaluate(u_r, 1),
                                                              0.0,
                                                              space.axial_rows[i].evaluate(u_z, 1),
                                                              0.0,
                                                              0.0};
        const auto image = hessian_times(jets.area, direction);
        const BasisRow& mu = space.tension_rows[i];
        for (const Slot& column : slots.curve) {
            const double variation = space.weight[i] * dot(image, column.partial);
            for (std::size_t k = 0; k < static_cast<std::size_t>(mu.count); ++k) {
                matrix(mu.index[k], column.row) += mu.value[0][k] * variation;
            }
        }
    }
    return matrix;
}

Eigen::RowVectorXd volume_gradient(const MembraneSpace& space, const MembraneSamples& samples) {
    Eigen::RowVectorXd result = Eigen::RowVectorXd::Zero(space.curve_count());
    for (std::size_t i = 0; i < space.xi.size(); ++i) {
        const EnergyJet density = volume_jet(samples.curve[i]);
        const LocalSlots slots = local_slots(space.radial_rows[i], space.axial_rows[i], space.radial_count());
        for (const Slot& column : slots.curve) {
            result[column.row] += space.weight[i] * dot(density.gradient, column.partial);
        }
    }
    return result;
}

Eigen::RowVectorXd volume_variation(const MembraneSpace& space, const MembraneSamples& samples,
                                    const Eigen::VectorXd& velocity) {
    Eigen::RowVectorXd result = Eigen::RowVectorXd::Zero(space.curve_count());
    const Eigen::VectorXd u_r = velocity.head(space.radial_count());
    const Eigen::VectorXd u_z = velocity.tail(space.axial_count());
    for (std::size_t i = 0; i < space.xi.size(); ++i) {
        const LocalSlots slots = local_slots(space.radial_rows[i], space.axial_rows[i], space.radial_count());
        const std::array<double, variable_count> direction = {space.radial_rows[i].evaluate(u_r, 0), 0.0, 0.0,
                                                              space.axial_rows[i].evaluate(u_z, 1),  0.0, 0.0};
        const auto image = hessian_times(volume_jet(samples.curve[i]), direction);
        for (const Slot& column : slots.curve) result[column.row] += space.weight[i] * dot(image, column.partial);
    }
    return result;
}

Eigen::MatrixXd force_mass_matrix(const MembraneSpace& space, const MembraneSamples& samples) {
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(space.curve_count(), space.force_count());
    const Index offset = space.radial_count();
    for (std::size_t i = 0; i < space.xi.size(); ++i) {
        const double measure = space.weight[i] * samples.curve[i].r * samples.curve[i].g;
        const BasisRow& radial = space.radial_rows[i];
        const BasisRow& axial = space.axial_rows[i];
        const BasisRow& force = space.force_rows[i];
        for (std::size_t j = 0; j < 6; ++j) {
            for (std::size_t k = 0; k < 6; ++k) {
                matrix(radial.index[j], radial.index[k]) += measure * radial.value[0][j] * radial.value[0][k];
                matrix(offset + axial.index[j], offset + force.index[k]) +=
                    measure * axial.value[0][j] * force.value[0][k];
            }
        }
    }
    return matrix;
}

std::vector<double> values_at_points(const std::vector<BasisRow>& rows, const Eigen::VectorXd& coefficients) {
    std::vector<double> values(rows.size());
    std::transform(rows.begin(), rows.end(), values.begin(),
                   [&](const BasisRow& row) { return row.evaluate(coefficients, 0); });
    return values;
}

}  // namespace endoflow::boundary_integral
