#include "phasefield/fem/flow_domain.h"

#include <algorithm>
#include <cmath>

#include "shared/model/time_scale.h"

namespace endoflow::phasefield {

namespace {

bool in_free_space(const Parameters& p) {
    return p.domain.kind == DomainKind::free_space;
}

}  // namespace

FlowDomain flow_domain(const Parameters& p) {
    if (!in_free_space(p)) return {p.domain.radius, 0, p.domain.height};
    const double reach = p.phase_field.free_space * size_of_membrane(p.domain), centre = p.domain.membrane_height;
    return {reach, centre - reach, centre + reach};
}

unsigned int layer_level(const Parameters& p) {
    constexpr double fewest_cells = 6;
    const auto asked_for = static_cast<unsigned int>(p.phase_field.far_refinements);
    const double halvings = std::log2(flow_domain(p).radius / (fewest_cells * p.phase_field.cell_size));
    return std::max(asked_for, static_cast<unsigned int>(std::max(0.0, halvings)));
}

}  // namespace endoflow::phasefield
