#include "boundary_integral/membrane/energy.h"

#include <algorithm>

#include "boundary_integral/membrane/curve_variables.h"
#include "shared/numerics/vector_clones.h"

namespace endoflow::boundary_integral {

namespace {

CurveJet volume_jet(const CurvePoint& p) {
    const CurveJet r = CurveJet::variable(p.r, var_r);
    return -0.5 * (r * r * CurveJet::variable(p.z1, var_z1));
}

/// Area per dξ, r g.
CurveJet area_jet(const CurvePoint& p) {
    const CurveJet r1 = CurveJet::variable(p.r1, var_r1), z1 = CurveJet::variable(p.z1, var_z1);
    return CurveJet::variable(p.r, var_r) * sqrt(r1 * r1 + z1 * z1);
}

/// e(κ, c, c'² w) A as a function of κ, w, A, c, c'.
Jet<5> density_of_geometry(const MembraneEnergy& energy, double kappa, double w, double area, double c, double c1) {
    using Outer = Jet<5>;
    const Outer slope = Outer::variable(c1, 4);
    const std::array<Outer, local::count> at{Outer::variable(kappa, 0), Outer::variable(c, 3),
                                             slope * slope * Outer::variable(w, 1)};
    return compose(energy.density(kappa, c, c1 * c1 * w), at) * Outer::variable(area, 2);
}

/// A function of the three numbers of the geometry and of c, c', as one of all variables: to first order,
EnergyDual in_all_variables(const Jet<5>& f, const std::array<CurveDual, 3>& geometry) {
    EnergyDual y(f.value);
    for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t i = 0; i < curve_variables; ++i) y.partial[i] += f.partial[a] * geometry[a].partial[i];
    for (std::size_t k = 0; k < 2; ++k) y.partial[var_c + k] = f.partial[3 + k];
    return y;
}

/// and to second.
EnergyJet in_all_variables(const Jet<5>& f, const std::array<CurveJet, 3>& geometry) {
    EnergyJet y(f.value);
    for (std::size_t a = 0; a < 3; ++a) {
        const CurveJet& x = geometry[a];
        std::array<double, curve_variables> image{};
        for (std::size_t b = 0; b < 3; ++b)
            for (std::size_t i = 0; i < curve_variables; ++i) image[i] += f.second[a][b] * geometry[b].partial[i];
        for (std::size_t i = 0; i < curve_variables; ++i) {
            y.partial[i] += f.partial[a] * x.partial[i];
            for (std::size_t j = 0; j < curve_variables; ++j)
                y.second[i][j] += f.partial[a] * x.second[i][j] + x.partial[i] * image[j];
            for (std::size_t k = 0; k < 2; ++k) y.second[i][var_c + k] += x.partial[i] * f.second[a][3 + k];
        }
    }
    for (std::size_t k = 0; k < 2; ++k) {
        y.partial[var_c + k] = f.partial[3 + k];
        for (std::size_t i = 0; i < curve_variables; ++i) y.second[var_c + k][i] = y.second[i][var_c + k];
        for (std::size_t l = 0; l < 2; ++l) y.second[var_c + k][var_c + l] = f.second[3 + k][3 + l];
    }
    return y;
}

/// Energy per dξ over 2π. `Number` is CurveJet or CurveDual.
template <class Number>
auto energy_per_length(const MembraneEnergy& energy, const std::array<Number, 3>& g, double c, double c1) {
    return in_all_variables(density_of_geometry(energy, g[0].value, g[1].value, g[2].value, c, c1), g);
}

/// Adds factor times a function of the curve alone.
void add_of_curve(EnergyJet& sum, double factor, const CurveJet& x) {
    for (std::size_t i = 0; i < curve_variables; ++i)
        for (std::size_t j = 0; j < curve_variables; ++j) sum.second[i][j] += factor * x.second[i][j];
}

/// At one point, in one piece for the vector unit: the density to first order,
ENDOFLOW_VECTOR_CLONES [[gnu::flatten]] void density_at(const MembraneEnergy& energy, const CurvePoint& p, double c,
                                                        double c1, EnergyDual& density) {
    density = energy_per_length(energy, geometry<CurveDual>(p), c, c1);
}

/// and to second, with what the multipliers add to its Hessian.
ENDOFLOW_VECTOR_CLONES [[gnu::flatten]] void density_at(const MembraneEnergy& energy, const CurvePoint& p, double c,
                                                        double c1, double tension, double pressure,
                                                        EnergyJet& density) {
    const auto at = geometry<CurveJet>(p);
    density = energy_per_length(energy, at, c, c1);
    if (tension != 0) add_of_curve(density, tension, at[2]);
    if (pressure != 0) add_of_curve(density, pressure, volume_jet(p));
}

Direction hessian_times(const EnergyJet& jet, const Slot& slot) {
    Direction result;
    for (std::size_t i = 0; i < variable_count; ++i) result[i] = dot(jet.second[i], slot);
    return result;
}

/// The Hessian of a function of the curve alone.
Direction hessian_times(const CurveJet& jet, const std::array<double, curve_variables>& direction) {
    Direction result{};
    for (std::size_t i = 0; i < curve_variables; ++i)
        for (std::size_t j = 0; j < curve_variables; ++j) result[i] += jet.second[i][j] * direction[j];
    return result;
}

void add_second_derivatives(const EnergyJet& jet, double weight, const LocalSlots& slots, EnergyDerivatives& result) {
    for (const Slot& column : slots.curve) {
        const auto image = hessian_times(jet, column);
        for (const Slot& row : slots.curve) result.hessian(row.row, column.row) += weight * dot(image, row);
    }
    for (const Slot& column : slots.concentration) {
        const auto image = hessian_times(jet, column);
        for (const Slot& row : slots.curve) result.mixed(row.row, column.row) += weight * dot(image, row);
        for (const Slot& row : slots.concentration) result.second_c(row.row, column.row) += weight * dot(image, row);
    }
}

/// One Gauss point's part of energy and gradients.
template <class Number>
void add_first_derivatives(const Number& density, double weight, const LocalSlots& slots, EnergyDerivatives& result) {
    result.energy += weight * density.value;
    for (const Slot& row : slots.curve) result.gradient[row.row] += weight * dot(density.partial, row);
    for (const Slot& row : slots.concentration) {
        result.gradient_c[row.row] += weight * dot(density.partial, row);
    }
}

}  // namespace

EnergyDerivatives energy_derivatives(const MembraneSpace& space, const MembraneState& state,
                                     const MembraneEnergy& energy, Derivatives wanted, const Multipliers& multipliers) {
    EnergyDerivatives result;
    result.gradient = Eigen::VectorXd::Zero(space.curve_count());
    result.gradient_c = Eigen::VectorXd::Zero(space.axial_count());
    if (wanted == Derivatives::second) {
        result.hessian = Eigen::MatrixXd::Zero(space.curve_count(), space.curve_count());
        result.mixed = Eigen::MatrixXd::Zero(space.curve_count(), space.axial_count());
        result.second_c = Eigen::MatrixXd::Zero(space.axial_count(), space.axial_count());
    }
    const bool tense = multipliers.tension.size() > 0;
    for (std::size_t i = 0; i < space.xi.size(); ++i) {
        const CurvePoint p = curve_point(space.radial_rows[i], space.axial_rows[i], state);
        const double c = space.axial_rows[i].evaluate(state.c, 0), c1 = space.axial_rows[i].evaluate(state.c, 1);
        const LocalSlots slots = local_slots(space.radial_rows[i], space.axial_rows[i], space.radial_count());
        const double weight = space.weight[i];
        if (wanted == Derivatives::first) {
            EnergyDual density;
            density_at(energy, p, c, c1, density);
            add_first_derivatives(density, weight, slots, result);
            continue;
        }
        const double tension = tense ? space.tension_rows[i].evaluate(multipliers.tension) : 0.0;
        EnergyJet density;
        density_at(energy, p, c, c1, tension, multipliers.pressure, density);
        add_first_derivatives(density, weight, slots, result);
        add_second_derivatives(density, weight, slots, result);
    }
    return result;
}

double energy_density_at_rim(const MembraneSpace& space, const MembraneState& state, const MembraneEnergy& energy) {
    const BasisRow axial = space.axial().basis(1.0);
    const CurvePoint rim = curve_point(space.radial().basis(1.0), axial, state);
    const double slope = axial.evaluate(state.c, 1) / rim.g;
    return energy.density(rim.total_curvature(), axial.evaluate(state.c, 0), slope * slope).value;
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
        const LocalSlots slots = local_slots(space.radial_rows[i], space.axial_rows[i], space.radial_count());
        const std::array<double, curve_variables> direction = {space.radial_rows[i].evaluate(u_r, 0),
                                                               space.radial_rows[i].evaluate(u_r, 1), 0.0,
                                                               space.axial_rows[i].evaluate(u_z, 1)};
        const auto image = hessian_times(area_jet(samples.curve[i]), direction);
        const BasisRow& mu = space.tension_rows[i];
        for (const Slot& column : slots.curve) {
            const double variation = space.weight[i] * dot(image, column);
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
        const CurveJet density = volume_jet(samples.curve[i]);
        const LocalSlots slots = local_slots(space.radial_rows[i], space.axial_rows[i], space.radial_count());
        for (const Slot& column : slots.curve) {
            result[column.row] +=
                space.weight[i] * (column.first == var_r ? density.partial[var_r] * column.partial[0]
                                                         : density.partial[var_z1] * column.partial[0]);
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
        const std::array<double, curve_variables> direction = {space.radial_rows[i].evaluate(u_r, 0), 0.0, 0.0,
                                                               space.axial_rows[i].evaluate(u_z, 1)};
        const auto image = hessian_times(volume_jet(samples.curve[i]), direction);
        for (const Slot& column : slots.curve) result[column.row] += space.weight[i] * dot(image, column);
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
