#include "boundary_integral/modes/linearised_membrane.h"

#include <numbers>
#include <utility>

#include "boundary_integral/membrane/energy.h"
#include "shared/model/loads.h"

namespace endoflow::boundary_integral {

namespace {

using std::numbers::pi;

// Physical values at Greville points to coefficients of a full space.
Eigen::MatrixXd interpolated(const SplineSpace& splines, const Eigen::MatrixXd& values) {
    return LuFactors(collocation_matrix(splines, splines.greville_points()), "interpolation").solve(values);
}

}  // namespace

// What the clamped rim adds; zero on a closed membrane. Membrane slides through the rim with the velocity a, so that
//   its energy there is no force:         load(v) += R v_r(rim) e'(rim)
//   the slope of the moving curve stays:  V_z,xi = (z''/g) V_r + (w''/g) a, and the same for the test functions
//   no molecules come with it:            d/dt int psi c dA += R psi(rim) c u_r(rim), which advection alone would carry
struct LinearisedMembrane::RimTerms {
    Eigen::MatrixXd constrain;  // physical velocities with the slope's coefficient from V_r(rim)
    Eigen::RowVectorXd slope;   // coefficient of the slope per displacement, at velocity 1 through the rim
    double residual = 0.0;      // of the base state's weak force balance for the slope's function
    Eigen::RowVectorXd by_displacement, by_concentration;  // load on V_r(rim)
};

LinearisedMembrane::LinearisedMembrane(const Parameters& parameters, const Surroundings& surroundings, BaseState base)
    : surroundings_(surroundings),
      energy_(membrane_energy(parameters)),
      bending_(bending_energy(parameters)),
      transport_(transport_law(parameters.molecules)),
      exchange_(exchange_law(parameters.molecules)),
      base_(std::move(base)) {
    base_.multipliers.pressure -= loads_of(parameters).pressure;  // pressure difference: minus its potential is p V
    Surroundings::Layers layers = surroundings_.layers(base_);
    base_.traction_sum = std::move(layers.traction_sum);
    layers_ = std::move(layers.of_mode);
    points_ = base_points(surroundings_.membrane(), base_, energy_, surroundings_.viscosities());
}

LinearisedMembrane::RimTerms LinearisedMembrane::rim_terms(const ModeSpace& space) const {
    const Index velocities = space.velocity_count(), scalars = space.vertical().dimension();
    RimTerms rim{Eigen::MatrixXd::Identity(velocities, velocities), Eigen::RowVectorXd::Zero(scalars), 0.0,
                 Eigen::RowVectorXd::Zero(scalars), Eigen::RowVectorXd::Zero(scalars)};
    if (!space.clamped()) return rim;
    const MembraneSpace& membrane = surroundings_.membrane();
    const BasePoint p = base_point(membrane, base_, surroundings_.viscosities(), 1.0);
    const BasisRow row = space.vertical().basis(1.0);
    const double g = p.curve.g;
    // The last function but one is the only one with a slope and no height.
    double slope_of_function = 0.0;
    for (std::size_t j = 0; j < BasisRow::capacity; ++j) {
        if (row.index[j] == scalars - 2) slope_of_function += row.value[1][j];
    }
    const SurfaceJet per_area = surface_densities(p.curve, p.c, p.c_s * g, energy_).per_area;
    const double radius = p.curve.r;
    for (std::size_t j = 0; j < BasisRow::capacity; ++j) {
        rim.slope[row.index[j]] += row.value[2][j] / (g * slope_of_function);
        const Derivatives2 f = {row.value[0][j], row.value[1][j], row.value[2][j]};
        // n = e_z there; w and its slope vanish, so that the change of n has no part.
        const SurfaceAmplitudes amplitudes = surface_amplitudes(space.mode(), {}, {}, f);
        rim.by_displacement[row.index[j]] += radius * dot(per_area.partial, amplitudes);
        rim.by_concentration[row.index[j]] += radius * dot(per_area.partial, concentration_amplitudes(space.mode(), f));
    }
    rim.constrain(space.slope_at_rim(), space.radial_at_rim()) = p.curve.z2 / (g * slope_of_function);

    const MembraneSamples samples = sample(membrane, base_.membrane);
    const Eigen::VectorXd residual =
        -energy_derivatives(membrane, base_.membrane, energy_, Derivatives::first).gradient -
        divergence_matrix(membrane, samples).transpose() * base_.multipliers.tension -
        base_.multipliers.pressure * volume_gradient(membrane, samples).transpose() -
        force_mass_matrix(membrane, samples) * base_.force;
    rim.residual = residual[membrane.curve_count() - 2];
    return rim;
}

// Right-hand side of the velocity equation per displacement: with u_k = V - w d_n u_k on side k,
//     4 pi (nu_1 u_1 + nu_2 u_2) + D (nu_1 u_1 - nu_2 u_2) = S q
// gives 4 pi w (nu_1 d_n u_1 + nu_2 d_n u_2) + D [w (nu_1 d_n u_1 - nu_2 d_n u_2)].
Eigen::MatrixXd LinearisedMembrane::transpiration(const ModeSpace& space, const Eigen::MatrixXd& doubled) const {
    const MembraneSpace& membrane = surroundings_.membrane();
    const Index scalars = space.vertical().dimension(), lateral = space.lateral().dimension();
    // Radial and axial component of (factor) w at xi, as rows over the displacement's coefficients.
    const auto row_at = [&](double xi, TangentNormal BasePoint::*which, bool axial) {
        const BasePoint p = base_point(membrane, base_, surroundings_.viscosities(), xi);
        const TangentNormal& slope = p.*which;
        const double value = axial ? slope.tangential * p.tangent_z() + slope.normal * p.curve.normal_z
                                   : slope.tangential * p.tangent_r() + slope.normal * p.curve.normal_r;
        const BasisRow basis = space.vertical().basis(xi);
        Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(scalars);
        for (std::size_t j = 0; j < BasisRow::capacity; ++j) row[basis.index[j]] += value * basis.value[0][j];
        return row;
    };
    const auto field = [&](const SplineSpace& splines, bool axial) {
        const std::vector<double> points = splines.greville_points();
        Eigen::MatrixXd values(splines.dimension(), scalars);
        for (std::size_t i = 0; i < points.size(); ++i) {
            values.row(static_cast<Index>(i)) = row_at(points[i], &BasePoint::slope_jump, axial);
        }
        return interpolated(splines, values);
    };
    Eigen::MatrixXd jump = Eigen::MatrixXd::Zero(space.velocity_count(), scalars);
    jump.topRows(lateral) = field(space.lateral(), false);
    jump.bottomRows(scalars) = field(space.vertical(), true);
    Eigen::MatrixXd result = doubled * jump;
    Index row = 0;
    for (std::size_t k = 0; k < space.targets().size(); ++k) {
        const VelocityComponent& component = space.components()[k];
        for (const double xi : space.targets()[k]) {
            result.row(row++) += 4.0 * pi *
                                 (component.radial * row_at(xi, &BasePoint::slope_sum, false) +
                                  component.axial * row_at(xi, &BasePoint::slope_sum, true));
        }
    }
    return result;
}

ModeRates LinearisedMembrane::rates(int mode) const {
    const ModeSpace& space = surroundings_.space(mode);
    const Viscosities& viscosities = surroundings_.viscosities();
    const CollocatedLayers& layers = layers_[static_cast<std::size_t>(mode)];
    const ModeForms forms = mode_forms(space, points_);
    const RimTerms rim = rim_terms(space);
    const Eigen::MatrixXd displaced = space.displacement_expansion(), scalar = space.scalar().expansion();
    const Eigen::MatrixXd tension = space.tension().expansion();
    const Eigen::MatrixXd velocities = rim.constrain * space.velocities();  // free to physical
    const Index count = velocities.cols(), displacements = displaced.cols();

    // Loads <q, v> = -(second variation) - div v lambda' - int w [sigma P] : grad v + the rim's, on free velocities.
    Eigen::MatrixXd load(space.velocity_count(), displacements + scalar.cols());
    load << -(forms.stiffness + forms.carried_stress) * displaced, -forms.by_concentration * scalar;
    if (space.clamped()) {
        load.row(space.radial_at_rim()).head(displacements) +=
            (rim.by_displacement + rim.residual * rim.slope) * displaced;
        load.row(space.radial_at_rim()).tail(scalar.cols()) += rim.by_concentration * scalar;
    }
    const Eigen::MatrixXd free_load = velocities.transpose() * load;

    // Velocities from loads and, through the displaced conditions, from w.
    const Eigen::MatrixXd from_velocity =
        4.0 * pi * viscosities.sum() * surroundings_.evaluation(mode) + viscosities.contrast() * layers.doubled;
    const LuFactors equation(from_velocity * velocities, "velocity");
    const Eigen::MatrixXd force_from_load =
        inverse(velocities.transpose() * forms.force_mass * space.forces(), "force mass");
    const Eigen::MatrixXd mobility = equation.solve(layers.single * space.forces() * force_from_load);
    Eigen::MatrixXd imposed = Eigen::MatrixXd::Zero(space.velocity_count(), displacements);  // of the slope at the rim
    if (space.clamped()) imposed.row(space.slope_at_rim()) = base_.inflow * rim.slope * displaced;
    const Eigen::MatrixXd moved =
        equation.solve(transpiration(space, layers.doubled) * displaced - from_velocity * imposed);

    Eigen::MatrixXd velocity = mobility * free_load;
    velocity.leftCols(displacements) += moved;
    const Eigen::MatrixXd divergence = tension.transpose() * forms.divergence * velocities;
    const Eigen::MatrixXd response = mobility * divergence.transpose();
    Eigen::MatrixXd violation = divergence * velocity;
    violation.leftCols(displacements) +=
        tension.transpose() * (forms.divergence * imposed + forms.divergence_variation * displaced);
    const LuFactors tensions(divergence * response, "tension");
    velocity -= response * tensions.solve(violation);

    ModeRates rates;
    rates.displacements = displacements;
    rates.velocity = velocities * velocity;
    rates.velocity.leftCols(displacements) += imposed;
    rates.mobility = mobility;
    MoleculeForms molecules = diffusion_forms(space, base_, points_, transport_);
    const MoleculeForms exchange = exchange_forms(space, points_, exchange_, bending_);
    molecules.by_concentration += exchange.by_concentration;
    molecules.by_displacement += exchange.by_displacement;
    const Eigen::MatrixXd scalars = scalar_mass(space, points_);
    const LuFactors w_mass(displaced.transpose() * scalars * displaced, "displacement mass");
    const LuFactors c_mass(scalar.transpose() * scalars * scalar, "concentration mass");
    Eigen::MatrixXd carried = -(scalar.transpose() * forms.along);  // weak rate of c' by the physical velocity
    Eigen::MatrixXd c_rate = Eigen::MatrixXd::Zero(scalar.cols(), displacements + scalar.cols());
    c_rate.leftCols(displacements) += scalar.transpose() * (molecules.by_displacement - forms.turning) * displaced;
    c_rate.rightCols(scalar.cols()) += scalar.transpose() * molecules.by_concentration * scalar;
    if (space.clamped()) {
        const Index last = scalar.cols() - 1;  // the only function that does not vanish at the rim
        const MembraneState& state = base_.membrane;
        const double radius = state.r[state.r.size() - 1], concentration = state.c[state.c.size() - 1];
        carried(last, space.radial_at_rim()) += radius * concentration;
        c_rate(last, displacements + last) += radius * base_.inflow;
    }
    c_rate += carried * rates.velocity;
    rates.material.resize(displacements + scalar.cols(), displacements + scalar.cols());
    rates.material << w_mass.solve(displaced.transpose() * forms.normal * rates.velocity), c_mass.solve(c_rate);

    Eigen::MatrixXd moved_by(displacements + scalar.cols(), count);  // dy/dt by the free velocities
    moved_by << w_mass.solve(displaced.transpose() * forms.normal * velocities), c_mass.solve(carried * velocities);
    const Eigen::MatrixXd driven = mobility * moved_by.transpose();
    rates.thermal_mobility = moved_by * (driven - response * tensions.solve(divergence * driven));
    return rates;
}

Eigen::MatrixXd LinearisedMembrane::carrying(int mode, const std::vector<double>& speed) const {
    const ModeSpace& space = surroundings_.space(mode);
    const Eigen::MatrixXd form = carrying_form(space, points_, speed);
    const std::vector<double> ones(speed.size(), 1.0);
    const Eigen::MatrixXd mass = scalar_mass(space, points_);
    const Eigen::MatrixXd displaced = space.displacement_expansion(), scalar = space.scalar().expansion();
    const Index w = displaced.cols(), c = scalar.cols();
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(w + c, w + c);
    const auto projected = [&](const Eigen::MatrixXd& expansion) {
        return LuFactors(expansion.transpose() * mass * expansion, "scalar mass")
            .solve(expansion.transpose() * form * expansion);
    };
    result.topLeftCorner(w, w) = projected(displaced);
    result.bottomRightCorner(c, c) = projected(scalar);
    return result;
}

std::vector<double> LinearisedMembrane::speed_of_normal_coordinates() const {
    std::vector<double> speed;
    for (const BasePoint& p : points_.points) speed.push_back(-p.u_t);
    return speed;
}

Eigen::MatrixXd normal_rates(const LinearisedMembrane& membrane, int mode, const ModeRates& rates) {
    return rates.material + membrane.carrying(mode, membrane.speed_of_normal_coordinates());
}

}  // namespace endoflow::boundary_integral
