// Flows along the layer whose sharp counterparts are known: in a pipe of membrane, and sheared between two plates.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "phasefield/layer/weights.h"

using namespace endoflow;
using namespace endoflow::phasefield;

namespace {

FluidParameters fluids(double ratio) {
    FluidParameters fluid;
    fluid.viscosity_extracellular = 1;
    fluid.viscosity_intracellular = ratio;
    return fluid;
}

/// The midpoints of equal intervals of [from, to], and integrals over them up to each, half of its own included.
struct Line {
    Line(double from, double to, std::size_t count) : width((to - from) / static_cast<double>(count)), x(count) {
        for (std::size_t i = 0; i < count; ++i) x[i] = from + (static_cast<double>(i) + 0.5) * width;
    }
    template <class Function>
    [[nodiscard]] std::vector<double> integral(const Function& f) const {
        std::vector<double> out(x.size());
        double sum = 0;
        for (std::size_t i = 0; i < x.size(); ++i) {
            const double part = width * f(i);
            out[i] = sum + 0.5 * part;
            sum += part;
        }
        return out;
    }
    template <class Function>
    [[nodiscard]] double whole(const Function& f) const {
        double sum = 0;
        for (std::size_t i = 0; i < x.size(); ++i) sum += width * f(i);
        return sum;
    }
    double width;
    std::vector<double> x;
};

/// How much more than through a sharp pipe, relative, flows through a pipe of membrane with extracellular fluid inside
/// where the fluid outside rests, as in a bud's neck. Lengths in units of ε.
///
/// A pressure of slope one inside is held by a normal force of slope g per area and a tension of slope l,
/// p' = ∫_r^∞ (δ_N g + δ_Γ l/r) dr, and (ν r u')'/r = p' − δ_Γ l, which sums up to zero over the cross-section.
double excess_flow(double radius, double ratio, const MembraneWeight& weight,
                   const MembraneWeight& of_normals = normal_weight) {
    const FluidParameters fluid = fluids(ratio);
    const Line line(0, radius + 14, 40000);
    const auto& r = line.x;
    std::vector<double> density, normal_density, viscosity;
    for (const double at : r) {
        const auto layer = layer_profile(radius - at, 1);
        density.push_back(delta_Gamma(layer, weight));
        normal_density.push_back(delta_Gamma(layer, of_normals));
        viscosity.push_back(layer_viscosity(layer.phi, fluid, weight, ViscosityMean::arithmetic));
    }
    const auto beyond = [&](const std::vector<double>& up_to, std::size_t i) { return up_to.back() - up_to[i]; };
    const auto by_force = line.integral([&](std::size_t i) { return normal_density[i]; });
    const auto by_tension = line.integral([&](std::size_t i) { return density[i] / r[i]; });
    // p' = 1 on the axis and no net force: two equations for g and l.
    const double g_axis = beyond(by_force, 0), l_axis = beyond(by_tension, 0);
    const double g_sum = line.whole([&](std::size_t i) { return beyond(by_force, i) * r[i]; });
    const double l_sum = line.whole([&](std::size_t i) { return (beyond(by_tension, i) - density[i]) * r[i]; });
    const double l = g_sum / (g_sum * l_axis - l_sum * g_axis), g = (1 - l * l_axis) / g_axis;
    const auto stress = line.integral(
        [&](std::size_t i) { return (g * beyond(by_force, i) + l * beyond(by_tension, i) - l * density[i]) * r[i]; });
    const auto velocity = line.integral([&](std::size_t i) { return stress[i] / (r[i] * viscosity[i]); });
    const double flow =
        line.whole([&](std::size_t i) { return r[i] < radius ? (velocity[i] - velocity.back()) * r[i] : 0; });
    return flow / (-std::pow(radius, 4) / 16) - 1;
}

}  // namespace

TEST_CASE("a pipe of membrane carries what a sharp one does to third order", "[layer]") {
    // Without first moment what is left is of third order in ε over the radius; for equal viscosities, where the fluid
    // sees nothing of the layer but how it pulls, a tenth of that. What is cut off of the weights adds some 1e-4.
    const auto weight = membrane_weight(fluids(10), ViscosityMean::arithmetic);
    const double wide = excess_flow(20, 10, weight), narrow = excess_flow(10, 10, weight);
    CAPTURE(wide, narrow);
    CHECK(std::abs(narrow) < 5 * std::pow(0.1, 3));
    CHECK(std::log2(narrow / wide) > 2.8);
    const auto equal = membrane_weight(fluids(1), ViscosityMean::arithmetic);
    CHECK(std::abs(excess_flow(10, 1, equal)) < 0.5 * std::pow(0.1, 3));
    CHECK(std::abs(excess_flow(10, 1, equal, equal)) < 3e-4);  // δ_Γ alone has no third order either
    // With φ² alone, free of excess shear but not of its moment, it would be −6.3 (ε/n)² in wide pipes.
    MembraneWeight quadratic{1, 0, 0};
    double low = -5.2, high = 0;
    for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (low + high);
        quadratic = {1 - middle / 5, middle, 0, 1};
        (excess_shear(quadratic, fluids(10), ViscosityMean::arithmetic).sum > 0 ? low : high) = middle;
    }
    CAPTURE(quadratic.square);
    CHECK(excess_flow(80, 10, quadratic) == Approx(-6.3 / (80 * 80)).epsilon(0.1));
}

TEST_CASE("sheared fluids slip by nothing across the layer", "[layer]") {
    // Plates at ±20 ε, a membrane that takes up half of the shear stress: velocity of plate and membrane.
    constexpr double plate = 20, inside = 1, outside = 0.5;
    for (const double ratio : {0.1, 1.0, 10.0, 40.0}) {
        const auto weight = membrane_weight(fluids(ratio), ViscosityMean::arithmetic);
        const FluidParameters fluid = fluids(ratio);
        const Line line(-plate, plate, 40000);
        std::vector<LayerProfile<double>> layer;
        for (const double psi : line.x) layer.push_back(layer_profile(psi, 1));
        const auto shear = [&](std::size_t i) {
            const double stress = outside + (inside - outside) * (0.5 + membrane_indicator(layer[i].phi, weight));
            return stress / layer_viscosity(layer[i].phi, fluid, weight, ViscosityMean::arithmetic);
        };
        const auto velocity = line.integral(shear);
        const auto density = [&](std::size_t i) {
            const double phi2 = layer[i].phi * layer[i].phi;
            return layer[i].delta * (weight.constant + phi2 * (weight.square + phi2 * weight.fourth));
        };
        const double membrane = line.whole([&](std::size_t i) { return density(i) * velocity[i]; });
        CAPTURE(ratio);
        CHECK(line.whole(shear) == Approx(plate * (inside + outside / ratio)).epsilon(1e-6));
        CHECK(membrane == Approx(plate * outside / ratio).epsilon(1e-6));
    }
}
