#include "phasefield/fem/flow_domain.h"

#include <algorithm>
#include <cmath>

namespace endoflow::phasefield {

namespace {

bool in_free_space(const Parameters& p) {
    return p.domain.kind == DomainKind::free_space;
}

}  // namespace

FlowDomain flow_domain(const Parameters& p) {
    if (!in_free_space(p)) return {p.domain.radius, 0, p.domain.height};
    const double longer_axis = std::max(p.domain.spheroid_polar_axis, p.domain.spheroid_equatorial_axis);
    const double reach = p.phase_field.free_space * longer_axis, centre = p.domain.membrane_height;
    return {reach, centre - reach, centre + reach};
}

unsigned int layer_level(const Parameters& p) {
    constexpr double most_cells = 48;
    const double doublings = std::log2(flow_domain(p).radius / (most_cells * p.phase_field.cell_size));
    return static_cast<unsigned int>(p.phase_field.far_refinements) +
           static_cast<unsigned int>(std::max(0.0, doublings));
}

}  // namespace endoflow::phasefield
