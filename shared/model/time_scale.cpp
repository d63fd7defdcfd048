#include "shared/model/time_scale.h"

#include <algorithm>
#include <cmath>

#include "shared/model/bending_model.h"

namespace endoflow {

namespace {

/// Parts of natural_time: 10⁻⁵ and 0.2 µs in the standard case.
constexpr double first_part = 1.0653e-6, longest_part = 0.021307;

}  // namespace

double size_of_membrane(const DomainParameters& d) {
    if (d.kind == DomainKind::box) return d.radius;
    return std::max(d.spheroid_polar_axis, d.spheroid_equatorial_axis);
}

double largest_stiffness(const MembraneParameters& membrane) {
    const BendingModel model(membrane);
    return std::max(model.stiffness(0).value, model.stiffness(1).value);
}

double natural_time(const Parameters& p) {
    const double stiffness = largest_stiffness(p.membrane), R = size_of_membrane(p.domain);
    if (p.fluid.dynamics == Dynamics::geometric)
        return std::pow(R * p.molecules.interface_width, 2) / (p.fluid.normal_mobility * stiffness);
    return (p.fluid.viscosity_extracellular + p.fluid.viscosity_intracellular) * std::pow(R, 3) / stiffness;
}

double exchange_time(const Parameters& p) {
    switch (p.molecules.exchange) {
        case Exchange::none:
            return 0;
        case Exchange::reservoir:
            return 1 / (p.molecules.on_rate + p.molecules.off_rate);
        case Exchange::edge:
            return p.domain.radius / p.molecules.edge_speed;
    }
    return 0;
}

double first_step(const Parameters& p) {
    return p.time.initial_step > 0 ? p.time.initial_step : first_part * natural_time(p);
}

double longest_step(const Parameters& p) {
    return p.time.max_step > 0 ? p.time.max_step : longest_part * std::max(natural_time(p), exchange_time(p));
}

double time_tolerance(const Parameters& p, double chosen) {
    return p.time.tolerance > 0 ? p.time.tolerance : chosen;
}

}  // namespace endoflow
