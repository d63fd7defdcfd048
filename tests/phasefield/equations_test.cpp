// The equations of the production scheme at a point: forces from any energy, the exact Jacobian.

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>
#include <utility>

#include "one_step.h"
#include "phasefield/schemes/production/equation_pattern.h"
#include "phasefield/schemes/production/point_equations.h"
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
    p.membrane.coat_force = 30;
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
    step.coat_force = p.membrane.coat_force / step.molecules;
    return step;
}

PointPast some_past(const Parameters& p) {
    PointPast past;
    past.thickness = {p.phase_field.epsilon, 0.05, -0.08};
    past.normal = past.molecules_normal = {0.5, 0.6};
    past.own = 0.9;
    past.closest = {0.8, -0.6};
    past.slope_r = 0.1;
    past.slope_z = 0.05;
    past.arc = 1.2;
    past.metric = 1.3;
    past.material_force = {-0.4 * p.membrane.pole_force, p.membrane.pole_force};
    return past;
}

void check_jacobian(const Parameters& p, const LayerEnergy& energy, const StepNumbers& step) {
    const PointPast past = some_past(p);
    // The change of ψ's gradient follows the fields.
    using Variables = Dual<n_variables>;
    const auto rows_at = [&](const auto& x, const auto& change) {
        return point_equations(x, point_radius, past, change, step, energy);
    };
    const auto x = some_point();
    const std::array<double, 3> second{0.3, -0.2, 0.07};
    Fields<Variables> seeded;
    for (std::size_t k = 0; k < n_features; ++k) {
        auto xk = x;
        part(seeded[k / 3], k % 3) = Variables::variable(part(xk[k / 3], k % 3), k);
    }
    const auto variable = [&second](std::size_t k) { return Variables::variable(second[k], n_features + k); };
    auto rows = rows_at(seeded, GradientChange<Variables>{variable(0), variable(1), variable(2)});
    constexpr double h = 1e-5;
    for (std::size_t k = 0; k < n_variables; ++k) {
        const auto moved = [&](double by) {
            auto there = x;
            auto change = second;
            (k < n_features ? part(there[k / 3], k % 3) : change[k - n_features]) += by;
            return rows_at(there, GradientChange<double>{change[0], change[1], change[2]});
        };
        auto above = moved(h), below = moved(-h);
        for (std::size_t i = 0; i < n_features; ++i) {
            const double difference = (part(above[i / 3], i % 3) - part(below[i / 3], i % 3)) / (2 * h);
            CAPTURE(i, k);
            // Central differences: step² times third derivatives of order 1e3, and round-off over the step.
            CHECK(part(rows[i / 3], i % 3).partial[k] == Approx(difference).epsilon(1e-5).margin(1e-4));
        }
    }
}

/// The membrane's elastic state at a point.
SheetState sheet_at(const LayerEnergy& energy, const Fields<double>& x, const PointPast& past, double epsilon) {
    const double along = along_sheet(x[molecule_density], sheet_normal(x[distance], past.thickness).N_epsilon);
    return sheet_state(energy,
                       sheet_point(energy, x[Field::moment].value, x[molecule_density].value, along, x[distance].r,
                                   point_radius, epsilon),
                       epsilon);
}

/// W and its parts with this thickness at the place of the argument.
EnergyDensity<double> density_at(const LayerEnergy& energy, const Fields<double>& x, const PointPast& past,
                                 double epsilon) {
    const auto &psi = x[distance], &m = x[Field::moment], &c = x[molecule_density];
    const double along = along_sheet(c, sheet_normal(psi, past.thickness).N_epsilon);
    const auto at = sheet_point(energy, m.value, c.value, along, psi.r, point_radius, epsilon);
    return energy_density(EnergyArguments<double>{psi, m, c, epsilon}, point_radius, past.thickness, energy,
                          SheetEnergy(energy, at, epsilon), ScaledEnergyWeight(layer_profile(psi.value, epsilon).phi));
}

/// E_ε by differences of the integrand of (D), whose Laplacian of ψ is not integrated by parts.
double energy_by_thickness(const LayerEnergy& energy, const Fields<double>& x, const PointPast& past,
                           double laplacian) {
    const auto per_volume = [&](double epsilon) {
        const auto density = density_at(energy, x, past, epsilon);
        return density.at_given_bend + density.delta_E * x[Field::moment].value * laplacian;
    };
    constexpr double h = 1e-5;
    const double epsilon = past.thickness.value;
    return (per_volume(epsilon + h) - per_volume(epsilon - h)) / (2 * h);
}

/// Rows of m, G and of a coupled μ against differences of W; what is taken off the row of G is put back.
void check_variation(const LayerEnergy& energy) {
    const Parameters p;
    const PointPast past = some_past(p);
    const double epsilon = past.thickness.value;
    auto x = some_point();
    x[normal_force] = x[molecule_potential] = {};  // their own terms are not the energy's
    const StepNumbers step = numbers(p);
    auto rows = point_equations(x, point_radius, past, {}, step, energy);
    const auto take_back = [&rows](const PlaneVector<double>& flux) {
        rows[normal_force].r -= flux.r;
        rows[normal_force].z -= flux.z;
    };
    take_back(turning_thickness(energy_by_thickness(energy, x, past, 0), x[distance], past));
    const auto geometry = point_geometry(x[distance], past, step.weight);
    const double along = along_sheet(x[molecule_density], geometry.N_epsilon);
    const double k = sheet_point(energy, 0.0, 0.0, 0.0, x[distance].r, point_radius, epsilon).k;
    if (!energy.coupled)
        take_back(turning_molecules(density_at(energy, x, past, epsilon).delta_E, k,
                                    sheet_at(energy, x, past, epsilon).by_concentration, along, geometry));
    const auto check = [&](Field field, Field row_of) {
        for (std::size_t i = 0; i < 3; ++i) {
            constexpr double h = 1e-5;
            auto up = x, down = x;
            part(up[field], i) += h;
            part(down[field], i) -= h;
            const double derivative =
                (density_at(energy, up, past, epsilon).W - density_at(energy, down, past, epsilon).W) / (2 * h);
            CAPTURE(field, i);
            // Rows are written with the sign of the other side. h² times third derivatives of order 10, and round-off
            // over h.
            CHECK(-part(rows[row_of], i) == Approx(derivative).epsilon(1e-7).margin(1e-7));
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
    check_jacobian(p, LayerEnergy(membrane_energy(p).add(StiffeningTerm{40, 3}), true), numbers(p));
}

TEST_CASE("the pattern of the Jacobian holds what the equations contain, and nothing else", "[production]") {
    // In one case or another, at points without special meaning.
    Parameters without_flow;
    without_flow.fluid.dynamics = Dynamics::geometric;
    Parameters sensing = coupled();
    const Parameters exchanging = growing(Exchange::reservoir);
    sensing.molecules.exchange = exchanging.molecules.exchange;
    sensing.molecules.curvature_sensing = exchanging.molecules.curvature_sensing;
    sensing.molecules.molecule_area = exchanging.molecules.molecule_area;
    sensing.molecules.off_rate = exchanging.molecules.off_rate;
    std::set<std::pair<unsigned int, unsigned int>> found, said;
    for (const Parameters& p : {of(Transport::cahn_hilliard), of(Transport::fickian), loaded(), coupled(), exchanging,
                                sensing, without_flow}) {
        using Variables = Dual<n_variables>;
        PointPast past = some_past(p);
        Fields<Variables> x;
        auto values = some_point();
        for (unsigned int k = 0; k < n_features; ++k)
            part(x[k / 3], k % 3) = Variables::variable(part(values[k / 3], k % 3), k);
        const auto second = [](double value, unsigned int k) { return Variables::variable(value, n_features + k); };
        const auto change = gradient_change(own_normal(x[distance], past), second(0.3, 0), second(-0.2, 1),
                                            second(0.07, 2), (1 / point_radius) * x[distance].r);
        auto rows = point_equations(x, point_radius, past, change, numbers(p), LayerEnergy(p));
        for (unsigned int row = 0; row < n_features; ++row)
            for (unsigned int column = 0; column < n_variables; ++column)
                if (part(rows[row / 3], row % 3).partial[column] != 0) found.emplace(row, column);
    }
    for (const auto& [row, column] : equation_pattern()) said.emplace(row, column);
    for (const auto& [row, column] : found) {
        CAPTURE(row, column);
        CHECK(said.contains({row, column}));
    }
    for (const auto& [row, column] : said) {
        CAPTURE(row, column);
        CHECK(found.contains({row, column}));
    }
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
    const auto point = point_geometry(x[distance], past, with.weight);
    const double c = x[molecule_density].value,
                 by_c = sheet_at(energy, x, past, p.phase_field.epsilon).by_concentration,
                 rate = 30 * c * c * (1 - 1e-4 * with.molecules) - 0.7 * by_c * c;
    CHECK(without[molecule_density].value - there[molecule_density].value ==
          Approx(point.delta_Gamma * rate).epsilon(1e-12));
}

TEST_CASE("forces are the variation of the energy, whatever its terms", "[production]") {
    const Parameters p;
    check_variation(LayerEnergy(p));
    check_variation(LayerEnergy(coupled()));
    check_variation(LayerEnergy(membrane_energy(p).add(StiffeningTerm{40, 0}), false));
    check_variation(LayerEnergy(membrane_energy(p).add(StiffeningTerm{40, 3}), true));
}

TEST_CASE("a sheet's curvatures tell how much longer it is than the membrane", "[production]") {
    const double along = 0.08, around = -0.03, psi = 1.5;
    const auto of_sheet = [&](double curvature) { return curvature / (1 + curvature * psi); };
    const double metric = sheet_metric(psi, of_sheet(around), of_sheet(along) + of_sheet(around));
    CHECK(metric == Approx((1 + along * psi) / (1 + around * psi)).epsilon(1e-5));  // (0.11/0.5)⁸/8 from the bound
    CHECK(sheet_metric(1.2, -0.9, 3) < 3.01);                                       // where normals cross
    CHECK(sheet_metric(1.2, -0.9, 3) > 0);
}

TEST_CASE("a thickness that is not constant along the normal acts across the membrane alone", "[production]") {
    const Parameters p;
    const LayerEnergy energy(p);
    const StepNumbers step = numbers(p);
    const PointPast past = some_past(p);
    const auto x = some_point();
    const GradientChange<double> change{0, 0, 0.07};
    Fields<double> rows;
    const auto geometry = point_geometry(x[distance], past, step.weight);
    const double force = add_bending(x, geometry, energy, point_radius, past, change, rows).thickness;
    const double by_thickness = energy_by_thickness(energy, x, past, change.laplacian);
    CHECK(std::abs(by_thickness) > 0.01);
    // h² times third derivatives, some 10 times as large
    CHECK(force == Approx(by_thickness * thickness_across(x[distance], past.thickness)).epsilon(1e-6));

    // With E_ε nothing else that the fluid feels depends on Δψ.
    const auto with = point_equations(x, point_radius, past, change, step, energy),
               without = point_equations(x, point_radius, past, {}, step, energy);
    const double by_curvature = with[velocity_r].value - without[velocity_r].value;
    CHECK(std::abs(by_curvature) > 1e-6);
    CHECK(with[velocity_z].value - without[velocity_z].value ==
          Approx(by_curvature * x[distance].z / x[distance].r).epsilon(1e-9));
}

TEST_CASE("a membrane that a term makes stiffer is a stiffer membrane", "[production]") {
    // ½ γ κ² added to ½ β κ² is ½ (β + γ) κ²: the same equations to round-off.
    Parameters soft, stiff;
    soft.membrane.spontaneous_curvature = stiff.membrane.spontaneous_curvature = 0;
    soft.membrane.bending_stiffness_coated = soft.membrane.bending_stiffness;
    stiff.membrane.bending_stiffness = stiff.membrane.bending_stiffness_coated = 3 * soft.membrane.bending_stiffness;
    const double beta = BendingModel(soft.membrane).stiffness(0).value;
    const LayerEnergy added(membrane_energy(soft).add(AddedStiffness{2 * beta}), false), stiffer(stiff);
    auto one = point_equations(some_point(), point_radius, some_past(soft), {}, numbers(soft), added),
         other = point_equations(some_point(), point_radius, some_past(soft), {}, numbers(soft), stiffer);
    for (std::size_t i = 0; i < n_features; ++i)
        CHECK(part(one[i / 3], i % 3) == Approx(part(other[i / 3], i % 3)).epsilon(1e-12).margin(1e-12));
}
