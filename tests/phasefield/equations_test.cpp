// The equations of the production scheme at a point: forces from any energy, the exact Jacobian.

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "one_step.h"
#include "phasefield/schemes/production/point_equations.h"
#include "shared/numerics/gauss_legendre.h"
#include "some_point.h"

using namespace endoflow;
using namespace endoflow::phasefield;
using namespace endoflow::phasefield::production;

namespace {

constexpr double point_radius = 7;

/// Stiffer at high curvatures and where c changes: a term that the scheme has never heard of.
struct StiffeningTerm {
    double strength, edge;

    template <class Number>
    [[nodiscard]] Number density(const LocalShape<Number>& x) const {
        const Number squared = x.curvature * x.curvature;
        return strength * (1.0 + x.concentration) * squared * squared + edge * (x.squared_gradient * (1.0 + squared));
    }
};

/// ½ γ κ².
struct AddedStiffness {
    double gamma;

    template <class Number>
    [[nodiscard]] Number density(const LocalShape<Number>& x) const {
        return 0.5 * gamma * x.curvature * x.curvature;
    }
};

/// Molecules that bring others and are kept by a bent membrane: an exchange law that the scheme has never heard of.
struct CooperativeExchange {
    template <class Number>
    [[nodiscard]] Number rate(const ExchangePoint<Number>& x) const {
        const Number& c = x.concentration;
        return 30 * (c * c * (1.0 - 1e-4 * x.mass)) - 0.7 * (x.by_concentration * c);
    }
};

Parameters coupled() {
    Parameters p;
    p.molecules.coupling = Coupling::energetic;
    p.molecules.line_energy = 20;
    p.molecules.mobility = 10;
    return p;
}

Parameters growing(Exchange exchange) {
    Parameters p = coupled();
    p.molecules.exchange = exchange;
    p.molecules.on_rate = 30;
    p.molecules.off_rate = 20;
    p.molecules.edge_speed = 40;
    p.molecules.curvature_sensing = 0.5;
    p.molecules.molecule_area = 10;
    p.molecules.pool_area = 9000;
    return p;
}

Parameters loaded() {
    Parameters p;
    p.membrane.rim_tension = 0.05;
    p.fluid.pressure_difference = 0.3;
    p.membrane.pole_force = 20;
    p.fluid.inertia = true;
    p.fluid.density = 1;  // large enough to be seen
    return p;
}

Parameters of(Transport transport) {
    Parameters p;
    p.molecules.transport = transport;
    p.molecules.mobility = 10;
    return p;
}

StepNumbers numbers(Parameters p) {
    p.phase_field.production.profile_relaxation = p.phase_field.production.stretching_alignment = 10;
    StepNumbers step = step_numbers(p, 40, 10);
    step.molecules = 4000;
    return step;
}

PointPast some_past(const Parameters& p) {
    PointPast past;
    past.thickness = {p.phase_field.epsilon, 0.05, -0.08};
    past.normal = past.molecules_normal = {0.5, 0.6};
    past.slope_r = 0.1;
    past.slope_z = 0.05;
    past.metric = 1.3;
    past.pole_force = p.membrane.pole_force;
    return past;
}

void check_jacobian(const Parameters& p, const LayerEnergy& energy, const StepNumbers& step) {
    const PointPast past = some_past(p);
    const GradientChange change{0.3, -0.2};
    const auto rows_at = [&](const auto& x) { return point_equations(x, point_radius, past, change, step, energy); };
    const auto x = some_point();
    Fields<Dual<n_features>> seeded;
    for (std::size_t k = 0; k < n_features; ++k) {
        auto xk = x;
        part(seeded[k / 3], k % 3) = Dual<n_features>::variable(part(xk[k / 3], k % 3), k);
    }
    auto rows = rows_at(seeded);
    constexpr double h = 1e-5;
    for (std::size_t k = 0; k < n_features; ++k) {
        auto up = x, down = x;
        part(up[k / 3], k % 3) += h;
        part(down[k / 3], k % 3) -= h;
        auto above = rows_at(up), below = rows_at(down);
        for (std::size_t i = 0; i < n_features; ++i) {
            const double difference = (part(above[i / 3], i % 3) - part(below[i / 3], i % 3)) / (2 * h);
            CAPTURE(i, k);
            // Central differences: step² times third derivatives of order 1e3, and round-off over the step.
            CHECK(part(rows[i / 3], i % 3).partial[k] == Approx(difference).epsilon(1e-5).margin(1e-4));
        }
    }
}

/// M₂ k
double shift(const Fields<double>& x, double epsilon) {
    return energy_second_moment * epsilon * sheet_curvature(x[distance].r, point_radius, epsilon).scaled;
}

/// q = p − M₂ k e*(p)
double membrane_moment(const LayerEnergy& energy, const Fields<double>& x, double slope, double epsilon) {
    const double p = -x[Field::moment].value;
    return p - shift(x, epsilon) * energy.density.conjugate(p, x[molecule_density].value, slope * slope).value;
}

/// e*(q) + M₂ k² e*(p): what the layer has in place of e*.
double layer_conjugate(const LayerEnergy& energy, const Fields<double>& x, double slope, double epsilon) {
    const double c = x[molecule_density].value, part = shift(x, epsilon);
    const double plain = energy.density.conjugate(-x[Field::moment].value, c, slope * slope).value;
    return energy.density.conjugate(membrane_moment(energy, x, slope, epsilon), c, slope * slope).value +
           part * part / (energy_second_moment * epsilon * epsilon) * plain;
}

/// M₂ κ₂ (∂e/∂c) t·∇c t·∇χ, by which the row of G differs from the variation.
void take_off_turning(const LayerEnergy& energy, const Fields<double>& x, const PointPast& past, double epsilon,
                      AtPoint<double>& row) {
    const auto& c = x[molecule_density];
    const auto sheet = sheet_gradient(x[distance], past.thickness);
    const double length = std::hypot(sheet.r, sheet.z, gradient_floor), t_r = -sheet.z / length, t_z = sheet.r / length;
    const double moment = membrane_moment(energy, x, 0, epsilon);
    const double by_c = -energy.density.conjugate(moment, c.value, 0).partial[local::concentration];
    const double weight = energy_weight(layer_profile(x[distance].value, epsilon), x[distance].value, epsilon).value;
    const double turning = -shift(x, epsilon) * weight * by_c * (c.r * t_r + c.z * t_z);  // shift is −M₂ κ₂
    row.r -= turning * t_r;
    row.z -= turning * t_z;
}

/// Rows of b, G and of a coupled μ against differences of the two-field energy that add_bending() documents.
void check_variation(const LayerEnergy& energy) {
    const Parameters p;
    const double epsilon = p.phase_field.epsilon;
    PointPast past = some_past(p);
    const PointThickness thickness = past.thickness;
    const auto integrand = [&](const Fields<double>& x) {
        const auto &psi = x[distance], &b = x[Field::moment], &c = x[molecule_density];
        const auto layer = layer_profile(psi.value, epsilon);
        const auto weight = energy_weight(layer, psi.value, epsilon);
        const auto sheet = sheet_gradient(psi, thickness);
        const double along = (c.z * sheet.r - c.r * sheet.z) / std::hypot(sheet.r, sheet.z, gradient_floor);
        const double conjugate = layer_conjugate(energy, x, along, epsilon);
        const double squared = psi.r * psi.r + psi.z * psi.z;
        return weight.value * (-conjugate - psi.r * b.r - psi.z * b.z) - 0.5 * weight.first * (1 + squared) * b.value -
               weight.thickness * b.value * (thickness.r * psi.r + thickness.z * psi.z) -
               0.5 * energy.compliance(epsilon) * weight.value * std::pow(psi.r * b.r + psi.z * b.z, 2) -
               0.5 * energy.smoothing(epsilon) * (b.r * b.r + b.z * b.z);
    };
    auto x = some_point();
    x[normal_force] = x[molecule_potential] = {};  // their own terms are not the energy's
    auto rows = point_equations(x, point_radius, past, {}, numbers(p), energy);
    if (!energy.coupled) take_off_turning(energy, x, past, epsilon, rows[normal_force]);
    const auto check = [&](Field field, Field row_of) {
        for (std::size_t k = 0; k < 3; ++k) {
            constexpr double h = 1e-5;
            auto up = x, down = x;
            part(up[field], k) += h;
            part(down[field], k) -= h;
            const double derivative = (integrand(up) - integrand(down)) / (2 * h);
            CAPTURE(field, k);
            // Rows are written with the sign of the other side. h² times third derivatives of order 10, and round-off
            // over h.
            CHECK(-part(rows[row_of], k) == Approx(derivative).epsilon(1e-7).margin(1e-7));
        }
    };
    check(distance, normal_force);
    check(Field::moment, Field::moment);
    if (energy.coupled) check(molecule_density, molecule_potential);
}

}  // namespace

TEST_CASE("the Jacobian is the derivative of the residual", "[production]") {
    for (const Parameters& p : {of(Transport::cahn_hilliard), of(Transport::fickian), of(Transport::advection),
                                loaded(), coupled(), growing(Exchange::reservoir), growing(Exchange::edge)})
        check_jacobian(p, LayerEnergy(p), numbers(p));
    const Parameters p;
    check_jacobian(p, LayerEnergy(membrane_energy(p).add(StiffeningTerm{40, 3})), numbers(p));
}

TEST_CASE("any exchange law brings its molecules, and the Jacobian knows it", "[production]") {
    const Parameters p;
    const LayerEnergy energy(p);
    StepNumbers with = numbers(p);
    with.exchange = ExchangeLaw(CooperativeExchange{});
    check_jacobian(p, energy, with);
    const PointPast past = some_past(p);
    const auto x = some_point();
    const auto there = point_equations(x, point_radius, past, {}, with, energy),
               without = point_equations(x, point_radius, past, {}, numbers(p), energy);
    const auto point = point_geometry(x[distance], past.thickness, with.weight);
    const double c = x[molecule_density].value,
                 by_c = -energy.density.conjugate(membrane_moment(energy, x, 0, p.phase_field.epsilon), c, 0)
                             .partial[local::concentration],
                 rate = 30 * c * c * (1 - 1e-4 * with.molecules) - 0.7 * by_c * c;
    CHECK(without[molecule_density].value - there[molecule_density].value ==
          Approx(point.density * rate).epsilon(1e-12));
}

TEST_CASE("forces are the variation of the energy, whatever its terms", "[production]") {
    const Parameters p;
    check_variation(LayerEnergy(p));
    check_variation(LayerEnergy(coupled()));
    check_variation(LayerEnergy(membrane_energy(p).add(StiffeningTerm{40, 0})));
    check_variation(LayerEnergy(membrane_energy(p).add(StiffeningTerm{40, 3})));
}

namespace {

/// b and ∂b/∂ψ across the layer of a sphere, at the midpoints of n intervals of the distance from −reach to reach.
struct MomentAcross {
    std::vector<double> value, slope;
};

constexpr double sphere_radius = 20;

double across(int j, int n, double reach) {
    return reach * (2 * (j + 0.5) / n - 1);
}

/// Where E is stationary over b with |∇ψ| = 1: D w ∂b/∂ψ is what w (Δψ + κ(b)) leaves, in all zero. By Picard's
/// iteration.
MomentAcross moment_across(const LayerEnergy& energy, double c, double epsilon, int n, double reach) {
    const double width = 2 * reach / n, shift = -energy_second_moment * epsilon * epsilon / sphere_radius;
    const double q = energy.density.density(-2 / sphere_radius, c, 0).partial[local::curvature];
    const double stiffness = energy.density.density(0, c, 0).second[local::curvature][local::curvature];
    double middle = q;  // of p, from q = p − M₂ k e*(p)
    for (int i = 0; i < 30; ++i) middle = q + shift * energy.density.conjugate(middle, c, 0).value;
    const auto n_points = static_cast<std::size_t>(n);
    MomentAcross b{std::vector<double>(n_points, -middle), std::vector<double>(n_points)};
    for (int iteration = 0; iteration < 8; ++iteration) {
        double flux = 0;
        for (std::size_t j = 0; j < n_points; ++j) {
            const double psi = across(static_cast<int>(j), n, reach), rho = sphere_radius + psi;
            const double w = energy_weight(layer_profile(psi, epsilon), psi, epsilon).value;
            const double y = sheet_curvature(1.0, rho, epsilon).scaled;
            const double source =
                rho * rho * w * (2 / rho + sheet_state(energy, b.value[j], c, 0.0, y, epsilon).elastic.curvature);
            flux -= source * width;
            b.slope[j] = (flux + 0.5 * source * width) / (rho * rho * w * energy.compliance(epsilon));
        }
        const double drift = flux / (sphere_radius * sphere_radius);  // κ is off by that on the average
        double value = 0;
        for (std::size_t j = 0; j < n_points; ++j) {
            value += 0.5 * width * (b.slope[j] + (j == 0 ? 0 : b.slope[j - 1]));
            b.value[j] = value;
        }
        middle += drift * stiffness;
        const double offset = -middle - b.value[n_points / 2];
        for (double& each : b.value) each += offset;
    }
    return b;
}

/// The net force along the axis [pN] of a sphere with more molecules above than below, in the layer of this thickness:
/// ψ is the distance, c is constant along the normal.
double net_force_of_sphere(double epsilon) {
    constexpr double step = 1e-4;
    constexpr int n_polar = 8, n = 2000;
    const double reach = 6 * epsilon, width = 2 * reach / n;
    Parameters p;
    p.phase_field.epsilon = epsilon;
    const LayerEnergy energy(p);
    const StepNumbers at_step = numbers(p);
    PointPast past;
    past.thickness.value = epsilon;
    double force = 0;
    const QuadratureRule polar = gauss_legendre(n_polar);
    for (std::size_t i = 0; i < n_polar; ++i) {
        const double up = polar.nodes[i], c = 0.5 + 0.3 * up;
        const MomentAcross b = moment_across(energy, c, epsilon, n, reach),
                           more = moment_across(energy, c + step, epsilon, n, reach),
                           less = moment_across(energy, c - step, epsilon, n, reach);
        for (std::size_t j = 0; j < n; ++j) {
            const double psi = across(static_cast<int>(j), n, reach), rho = sphere_radius + psi;
            const double normal_r = std::sqrt(1 - up * up), r = rho * normal_r;
            const double up_r = -normal_r * up / rho, up_z = (1 - up * up) / rho;  // ∇(z/ρ) = ∇ψ_z
            const double slope = 0.3 * (more.value[j] - less.value[j]) / (2 * step);
            Fields<double> x{};
            past.normal = past.molecules_normal = {normal_r, up};
            x[distance] = {psi, normal_r, up};
            x[molecule_density] = {c, 0.3 * up_r, 0.3 * up_z};
            x[Field::moment] = {b.value[j], slope * up_r + b.slope[j] * normal_r, slope * up_z + b.slope[j] * up};
            const auto rows = point_equations(x, r, past, {}, at_step, energy);
            const auto& G = rows[normal_force];  // less δ_m G, which would make it zero
            const double density = -(G.value * up + G.r * up_r + G.z * up_z) - rows[velocity_z].value;
            force += 2 * std::numbers::pi * rho * rho * polar.weights[i] * width * density;
        }
    }
    return force;
}

}  // namespace

TEST_CASE("molecules and membrane exert no net force, but for ε⁴", "[production]") {
    // A sharp membrane exerts none, for its energy does not change where it is translated. Two forces of 815 pN cancel;
    // with the sheets' area alone, without the turning normals, 3.7 pN would be left at 1.2 nm, and fall with ε².
    const double thick = net_force_of_sphere(2.4), thin = net_force_of_sphere(1.2);
    CHECK(std::abs(thin) < 0.01);
    CHECK(std::log2(thick / thin) > 3.8);  // ε⁴, and (ε/radius)² of it
}

TEST_CASE("a sheet's curvatures tell how much longer it is than the membrane", "[production]") {
    const double along = 0.08, around = -0.03, psi = 1.5;
    const auto of_sheet = [&](double curvature) { return curvature / (1 + curvature * psi); };
    const double metric = sheet_metric(psi, of_sheet(around), of_sheet(along) + of_sheet(around));
    CHECK(metric == Approx((1 + along * psi) / (1 + around * psi)).epsilon(1e-5));  // (0.11/0.5)⁸/8 from the bound
    CHECK(sheet_metric(1.2, -0.9, 3) < 3.01);                                       // where normals cross
    CHECK(sheet_metric(1.2, -0.9, 3) > 0);
}

TEST_CASE("where the layer's thickness changes the fluid feels the energy's derivative by it", "[production]") {
    const Parameters p;
    const LayerEnergy energy(p);
    const StepNumbers step = numbers(p);
    const PointPast past = some_past(p);
    const auto x = some_point();
    const auto &psi = x[distance], &b = x[Field::moment];
    const GradientChange change{0, 0, 0.07};
    // Per volume, before the Laplacian of ψ is integrated by parts.
    const auto integrand = [&](double epsilon) {
        const auto weight = energy_weight(layer_profile(psi.value, epsilon), psi.value, epsilon);
        const double conjugate = layer_conjugate(energy, x, 0, epsilon);
        const double slope = psi.r * b.r + psi.z * b.z, defect = 1 - psi.r * psi.r - psi.z * psi.z;
        return weight.value * (b.value * change.laplacian - conjugate) - 0.5 * weight.first * b.value * defect -
               0.5 * energy.compliance(epsilon) * weight.value * slope * slope;
    };
    Fields<double> rows;
    const auto force =
        add_bending(x, point_geometry(psi, past.thickness, step.weight), energy, point_radius, past, change, rows)
            .by_thickness;
    constexpr double h = 1e-4;
    const double epsilon = p.phase_field.epsilon,
                 derivative = (integrand(epsilon + h) - integrand(epsilon - h)) / (2 * h);
    CHECK(std::abs(derivative) > 0.01);
    CHECK(force == Approx(derivative).epsilon(1e-6));  // h² times third derivatives, some 10 times as large

    // With E_ε nothing else depends on Δψ: it acts along ∇ε.
    const auto with = point_equations(x, point_radius, past, change, step, energy),
               without = point_equations(x, point_radius, past, {}, step, energy);
    const double by_curvature = with[velocity_r].value - without[velocity_r].value;
    CHECK(std::abs(by_curvature) > 1e-6);
    CHECK(with[velocity_z].value - without[velocity_z].value ==
          Approx(by_curvature * past.thickness.z / past.thickness.r).epsilon(1e-9));
}

TEST_CASE("a membrane that a term makes stiffer is a stiffer membrane", "[production]") {
    // ½ γ κ² added to ½ β κ² is ½ (β + γ) κ²: the same equations to round-off.
    Parameters soft, stiff;
    soft.membrane.spontaneous_curvature = stiff.membrane.spontaneous_curvature = 0;
    soft.membrane.bending_stiffness_coated = soft.membrane.bending_stiffness;
    stiff.membrane.bending_stiffness = stiff.membrane.bending_stiffness_coated = 3 * soft.membrane.bending_stiffness;
    const double beta = BendingModel(soft.membrane).stiffness(0).value;
    const LayerEnergy added(membrane_energy(soft).add(AddedStiffness{2 * beta})), stiffer(stiff);
    auto one = point_equations(some_point(), point_radius, some_past(soft), {}, numbers(soft), added),
         other = point_equations(some_point(), point_radius, some_past(soft), {}, numbers(soft), stiffer);
    for (std::size_t i = 0; i < n_features; ++i)
        CHECK(part(one[i / 3], i % 3) == Approx(part(other[i / 3], i % 3)).epsilon(1e-12).margin(1e-12));
}
