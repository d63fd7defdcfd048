#include "boundary_integral/evolution/material_strain.h"

#include <algorithm>
#include <cmath>

namespace endoflow::boundary_integral {

namespace {

constexpr Index rates_per_element = 8;
constexpr Index markers_per_element = 4;

// Cubic interpolation of values at equal steps of [0, 1].
double interpolated(const std::vector<double>& values, double xi) {
    const auto last = static_cast<Index>(values.size()) - 1;
    const double place = std::clamp(xi, 0.0, 1.0) * static_cast<double>(last);
    const Index first = std::clamp<Index>(static_cast<Index>(place) - 1, 0, last - 3);
    const double t = place - static_cast<double>(first);  // the four points are t = 0, 1, 2, 3
    const double* v = &values[static_cast<std::size_t>(first)];
    return -v[0] * (t - 1) * (t - 2) * (t - 3) / 6 + v[1] * t * (t - 2) * (t - 3) / 2 -
           v[2] * t * (t - 1) * (t - 3) / 2 + v[3] * t * (t - 1) * (t - 2) / 6;
}

double largest_modulus(const std::vector<double>& values) {
    double largest = 0.0;
    for (const double value : values) largest = std::max(largest, std::abs(value));
    return largest;
}

}  // namespace

MaterialStrain::MaterialStrain(const MembraneSpace& space)
    : radial_count_(space.radial_count()), element_width_(space.element_width()) {
    const Index intervals = rates_per_element * space.elements();
    for (Index i = 0; i <= intervals; ++i) {
        const double xi = static_cast<double>(i) / static_cast<double>(intervals);
        radial_rows_.push_back(space.radial().basis(xi));
        axial_rows_.push_back(space.axial().basis(xi));
    }
    const Index count = markers_per_element * space.elements();
    for (Index i = 0; i <= count; ++i) {
        markers_.xi.push_back(static_cast<double>(i) / static_cast<double>(count));
        markers_.log_growth.push_back(0.0);
    }
}

double MaterialStrain::spacing() const {
    return element_width_ / static_cast<double>(markers_per_element);
}

MaterialRates MaterialStrain::rates(const Evaluation& e) const {
    const Eigen::VectorXd relative = e.flow.velocity - e.mesh_velocity;  // of the material against the mesh
    const Eigen::VectorXd v_r = relative.head(radial_count_), v_z = relative.tail(relative.size() - radial_count_);
    const Eigen::VectorXd u_r = e.flow.velocity.head(radial_count_),
                          u_z = e.flow.velocity.tail(relative.size() - radial_count_);
    MaterialRates rates;
    for (std::size_t i = 0; i < radial_rows_.size(); ++i) {
        const BasisRow& radial = radial_rows_[i];
        const BasisRow& axial = axial_rows_[i];
        const CurvePoint p = curve_point(radial, axial, e.state);
        const double square = p.g * p.g;
        rates.drift.push_back((radial.evaluate(v_r) * p.r1 + axial.evaluate(v_z) * p.z1) / square);
        const double meridional = (p.r1 * radial.evaluate(u_r, 1) + p.z1 * axial.evaluate(u_z, 1)) / square;
        const double azimuthal = p.on_axis() ? radial.evaluate(u_r, 1) / p.r1 : radial.evaluate(u_r) / p.r;
        rates.growth.push_back(meridional + azimuthal);
    }
    return rates;
}

void MaterialStrain::advance(const MaterialRates& before, const MaterialRates& after, double step) {
    // Half an element at a time, by the midpoint rule.
    const double way = step * std::max(largest_modulus(before.drift), largest_modulus(after.drift));
    const int parts = static_cast<int>(std::clamp(std::ceil(2.0 * way / element_width_), 1.0, 64.0));
    const double part = step / parts;
    const auto rate = [&](const std::vector<double>& old_values, const std::vector<double>& new_values, double xi,
                          double fraction) {
        return (1.0 - fraction) * interpolated(old_values, xi) + fraction * interpolated(new_values, xi);
    };
    for (std::size_t i = 0; i < markers_.xi.size(); ++i) {
        double& xi = markers_.xi[i];
        for (int k = 0; k < parts; ++k) {
            const double begin = static_cast<double>(k) / parts, middle = (k + 0.5) / parts;
            const double half_way = xi + 0.5 * part * rate(before.drift, after.drift, xi, begin);
            xi += part * rate(before.drift, after.drift, half_way, middle);
            markers_.log_growth[i] += part * rate(before.growth, after.growth, half_way, middle);
        }
    }
    renew();
}

// Markers beyond the rim have left; where material has come in through it, new ones start unstretched.
void MaterialStrain::renew() {
    while (!markers_.xi.empty() && markers_.xi.back() > 1.0) {
        markers_.xi.pop_back();
        markers_.log_growth.pop_back();
    }
    if (markers_.xi.empty() || markers_.xi.back() < 1.0 - spacing()) {
        markers_.xi.push_back(1.0);
        markers_.log_growth.push_back(0.0);
    }
}

double MaterialStrain::largest() const {
    double largest = 0.0;
    for (const double value : markers_.log_growth) largest = std::max(largest, std::abs(std::expm1(value)));
    return largest;
}

}  // namespace endoflow::boundary_integral
