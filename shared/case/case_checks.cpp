#include "shared/case/case_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "shared/model/bending_model.h"
#include "shared/model/exchange.h"
#include "shared/model/initial_condition.h"
#include "shared/model/loads.h"
#include "shared/model/membrane_energy.h"
#include "shared/model/time_scale.h"
#include "shared/support/error.h"

namespace endoflow {

namespace {

/// More shapes or field files than this in a run, or points in one, fill disks and memories and are looked at by
/// nobody.
constexpr double most_outputs = 1e6;
constexpr double most_field_points = 1e7;

/// More cells of the phase field than this along the domain do not fit into any memory.
constexpr double most_cells_across = 2e5;

using Require = std::function<void(bool holds, const std::string& message)>;

/// The initial profile is a patch only if c is about 1 in its middle and about 0 at the rim.
constexpr double least_contrast = 0.9;

/// Half width of a band of small cells in units of ε: (1 − φ²)² is 0.04 there.
constexpr double least_band = 2;

/// A ring as narrow as the coat's edge, nm.
constexpr double narrowest_ring = 2;

void check_box(const Parameters& p, const Require& require) {
    const double below = p.domain.membrane_height, above = p.domain.height - p.domain.membrane_height;
    require(p.molecules.patch_radius < p.domain.radius,
            fmt::format("molecules.patch_radius = {} nm must be smaller than domain.radius = {} nm",
                        p.molecules.patch_radius, p.domain.radius));
    const double centre = initial_concentration(p.molecules, 0),
                 rim = initial_concentration(p.molecules, p.domain.radius);
    require(
        centre >= least_contrast && rim <= 1 - least_contrast,
        fmt::format("molecules.interface_width = {} nm is too wide for a patch of molecules.patch_radius = {} nm in "
                    "domain.radius = {} nm: c is {:.2g} in the middle, which must be >= {}, and {:.2g} at the rim, "
                    "which must be <= {:.2g}; lower interface_width or change patch_radius",
                    p.molecules.interface_width, p.molecules.patch_radius, p.domain.radius, centre, least_contrast, rim,
                    1 - least_contrast));
    const double room = p.domain.pin_half_width + p.domain.wall_clearance;
    require(below > room && above > room,
            fmt::format("domain.membrane_height = {} nm must lie farther than pin_half_width + wall_clearance = {} "
                        "nm from the bottom (0) and the top (domain.height = {} nm)",
                        below, room, p.domain.height));
    const double h = p.phase_field.cell_size > 0 ? p.phase_field.cell_size : p.phase_field.epsilon;
    require(std::max(p.domain.radius, p.domain.height) <= most_cells_across * h,
            fmt::format("phase_field.cell_size = {} nm (0: phase_field.epsilon = {} nm decides) is too small for "
                        "domain.radius = {} nm and domain.height = {} nm: more than {} cells",
                        p.phase_field.cell_size, p.phase_field.epsilon, p.domain.radius, p.domain.height,
                        most_cells_across));
    const double band = p.phase_field.band_width;
    require(band == 0 || band >= least_band,
            fmt::format("phase_field.band_width = {:g} leaves parts of the layer on large cells; it must be 0 or at "
                        "least {:g}",
                        band, least_band));
    const double spacing = p.boundary_integral.field_spacing;
    require(
        p.output.field_interval == 0 || (p.domain.radius / spacing) * (p.domain.height / spacing) <= most_field_points,
        fmt::format("boundary_integral.field_spacing = {} nm gives more than {} points in a domain.radius = {} nm by "
                    "domain.height = {} nm; enlarge it, or set output.field_interval = 0",
                    spacing, most_field_points, p.domain.radius, p.domain.height));
}

/// Loads need a rim or walls; and no membrane is flat, to begin with, under a tension below that at which it buckles:
/// −β (j/R)², j = 3.8317 the first zero of J₁, for a disc whose edge is held horizontally.
void check_loads(const Parameters& p, const Require& require) {
    const Loads loads = loads_of(p);
    const auto& ring = p.membrane.coat_force_ring;
    const bool ringed = ring[0] != 0 || ring[1] != 0;
    require(!ringed || loads.coat_force != 0,
            fmt::format("membrane.coat_force_ring = [{:g}, {:g}] needs membrane.coat_force", ring[0], ring[1]));
    require(loads.collar_place == 0 || loads.collar_force != 0,
            fmt::format("membrane.collar_position = {:g} needs membrane.collar_force", p.membrane.collar_position));
    if (loads.none()) return;
    const double reach = 3 * loads.collar_spread(), all = std::numbers::pi * p.domain.radius * p.domain.radius;
    require(loads.collar_place == 0 || (loads.collar_place >= reach && loads.collar_place + reach <= all),
            fmt::format("membrane.collar_position = {:g} nm must be between {:.4g} and {:.4g} nm: a collar of "
                        "membrane.collar_width = {:g} nm lies on the membrane with three standard deviations, "
                        "2π · 10 nm times the width in area",
                        p.membrane.collar_position, std::sqrt(reach / std::numbers::pi),
                        std::sqrt(std::max(0.0, all - reach) / std::numbers::pi), p.membrane.collar_width));
    require(!ringed || (ring[1] - ring[0] >= narrowest_ring && ring[1] <= p.domain.radius),
            fmt::format("membrane.coat_force_ring = [{:g}, {:g}] nm must be [a1, a2] with a2 at least {:g} nm larger "
                        "than a1 and at most domain.radius = {:g} nm",
                        ring[0], ring[1], narrowest_ring, p.domain.radius));
    require(p.domain.kind == DomainKind::box,
            "membrane.rim_tension, membrane.pole_force, membrane.coat_force, membrane.collar_force and "
            "fluid.pressure_difference need "
            "domain.kind = \"box\"");
    require(p.membrane.inextensible,
            "membrane.rim_tension, membrane.pole_force, membrane.coat_force, membrane.collar_force and "
            "fluid.pressure_difference need "
            "membrane.inextensible = true");
    require(p.fluid.dynamics == Dynamics::flow,
            "membrane.rim_tension, membrane.pole_force, membrane.coat_force, membrane.collar_force and "
            "fluid.pressure_difference need "
            "fluid.dynamics = \"flow\"");
    require(
        loads.pole_force == 0 || 3 * loads.force_width <= p.domain.radius,
        fmt::format("membrane.pole_force_width = {:g} nm spreads the force beyond domain.radius = {:g} nm; it must be "
                    "at most a third of it",
                    loads.force_width, p.domain.radius));
    constexpr double first_zero = 3.8317059702075125;
    const double stiffness = BendingModel(p.membrane).stiffness(0).value;
    const double buckling = -stiffness * std::pow(first_zero / p.domain.radius, 2);
    require(loads.rim_tension > buckling,
            fmt::format("membrane.rim_tension = {:g} pN/nm is not above {:.4g} pN/nm, where the flat membrane buckles",
                        loads.rim_tension, buckling));
}

/// Molecules that bending and line energy drive. A key that nothing reads is a mistake.
void check_molecules(const Parameters& p, const Require& require) {
    const MoleculeParameters& m = p.molecules;
    const bool coupled = m.coupling == Coupling::energetic;
    require(coupled || m.line_energy == 0,
            fmt::format("molecules.line_energy = {:g} pN needs molecules.coupling = \"energetic\"", m.line_energy));
    if (coupled) {
        const std::string energetic = "molecules.coupling = \"energetic\" needs ";
        require(m.line_energy > 0, energetic + "molecules.line_energy > 0: without it no edge of the coat is stable");
        require(m.transport != Transport::fickian,
                energetic + "molecules.transport = \"cahn-hilliard\" or \"advection\": Fick's law has no line energy");
        require(p.membrane.inextensible && p.fluid.dynamics == Dynamics::flow,
                energetic + "membrane.inextensible = true and fluid.dynamics = \"flow\"");
    }
}

/// ∫ c dA of the initial coat on a flat membrane, nm².
double initial_coat(const MoleculeParameters& m) {
    const double edge = std::numbers::sqrt2 * m.interface_width;
    return std::numbers::pi * (m.patch_radius * m.patch_radius + std::pow(std::numbers::pi * edge, 2) / 12);
}

/// Detachment this many times e faster than without sensing is out of any rate's range.
constexpr double largest_exponent = 100;

/// Keys of a law that is not the case's, rates that are missing, pools that do not hold the coat there is.
void check_exchange(const Parameters& p, const Require& require) {
    const MoleculeParameters& m = p.molecules;
    const bool reservoir = m.exchange == Exchange::reservoir, edge = m.exchange == Exchange::edge;
    const auto belongs = [&](bool holds, const char* key, double value, const char* to) {
        require(holds || value == 0, fmt::format("molecules.{} = {:g} needs molecules.exchange = {}", key, value, to));
    };
    belongs(reservoir, "on_rate", m.on_rate, "\"reservoir\"");
    belongs(reservoir, "off_rate", m.off_rate, "\"reservoir\"");
    belongs(reservoir, "curvature_sensing", m.curvature_sensing, "\"reservoir\"");
    belongs(reservoir || m.bulk != Bulk::none, "molecule_area", m.molecule_area, "\"reservoir\", or molecules.bulk");
    belongs(edge, "edge_speed", m.edge_speed, "\"edge\"");
    belongs(reservoir || edge, "pool_area", m.pool_area, "\"reservoir\" or \"edge\"");
    if (m.exchange == Exchange::none) return;
    require(p.domain.kind == DomainKind::box, "molecules.exchange needs domain.kind = \"box\"");
    require(!edge || m.edge_speed > 0, "molecules.exchange = \"edge\" needs molecules.edge_speed > 0");
    require(!edge || m.transport != Transport::fickian,
            "molecules.exchange = \"edge\" needs molecules.transport = \"cahn-hilliard\" or \"advection\": Fick's law "
            "keeps no edge that could grow");
    require(!reservoir || m.on_rate + m.off_rate > 0,
            "molecules.exchange = \"reservoir\" needs molecules.on_rate or molecules.off_rate > 0");
    require(!reservoir || m.pool_area == 0 || m.on_rate > 0,
            fmt::format("molecules.pool_area = {:g} nm^2 limits what attaches: it needs molecules.on_rate > 0",
                        m.pool_area));
    const bool sensing = m.curvature_sensing > 0;
    require(sensing ? m.molecule_area > 0 && m.off_rate > 0 : m.molecule_area == 0 || m.bulk != Bulk::none,
            "molecules.curvature_sensing and molecules.molecule_area need each other, and molecules.off_rate > 0");
    require(m.pool_area == 0 || m.pool_area > initial_coat(m),
            fmt::format("molecules.pool_area = {:g} nm^2 must exceed the {:.5g} nm^2 of the initial coat", m.pool_area,
                        initial_coat(m)));
    const double exponent = detachment_exponent(
        m, bending_energy(p, std::numeric_limits<double>::infinity()).density(0, 1, 0).partial[local::concentration]);
    require(std::abs(exponent) <= largest_exponent,
            fmt::format("molecules.molecule_area = {:g} nm^2: a molecule of the flat coat would free {:.4g} k_B T by "
                        "leaving, more than {:g}; lower it, or curvature_sensing",
                        m.molecule_area, exponent, largest_exponent));
}

/// A law of maturation and its numbers need each other.
void check_maturation(const Parameters& p, const Require& require) {
    const MoleculeParameters& m = p.molecules;
    if (m.maturation != Maturation::none) {
        require(m.maturation_rate > 0 || m.maturation_start > 0,
                "molecules.maturation needs molecules.maturation_rate > 0: a coat that begins flat would stay so");
        return;
    }
    require(m.maturation_rate == 0, fmt::format("molecules.maturation_rate = {:g} needs molecules.maturation = "
                                                "\"exponential\" or \"cooperative\"",
                                                m.maturation_rate));
    require(m.maturation_start == 0, fmt::format("molecules.maturation_start = {:g} needs molecules.maturation = "
                                                 "\"exponential\" or \"cooperative\"",
                                                 m.maturation_start));
}

/// A bulk is the other side of an exchange, and its molecules are counted: their area on the membrane is needed.
void check_bulk(const Parameters& p, const Require& require) {
    const MoleculeParameters& m = p.molecules;
    if (m.bulk == Bulk::none) {
        const auto belongs = [&](const char* key, double value) {
            require(value == 0, fmt::format("molecules.{} = {:g} needs molecules.bulk = \"extracellular\" or "
                                            "\"intracellular\"",
                                            key, value));
        };
        belongs("bulk_diffusivity", m.bulk_diffusivity);
        belongs("bulk_concentration", m.bulk_concentration);
        belongs("bulk_reach", m.bulk_reach);
        return;
    }
    const std::string bulk = "molecules.bulk needs ";
    require(m.exchange != Exchange::none, bulk + "molecules.exchange = \"reservoir\" or \"edge\"");
    require(m.bulk_diffusivity > 0 && m.bulk_concentration > 0 && m.molecule_area > 0,
            bulk + "molecules.bulk_diffusivity, molecules.bulk_concentration and molecules.molecule_area > 0");
    require(m.pool_area == 0, "molecules.bulk is what the molecules are taken from: it needs molecules.pool_area = 0");
    require(p.fluid.dynamics == Dynamics::flow, bulk + "fluid.dynamics = \"flow\", which carries its molecules along");
}

/// Numbers whose 0 means "chosen" have a gap above it.
void check_resolution(const Parameters& p, const Require& require) {
    constexpr int fewest_elements = 8;
    constexpr double strictest_tolerance = 1e-12;
    const int elements = p.boundary_integral.elements;
    require(elements == 0 || elements >= fewest_elements,
            fmt::format("boundary_integral.elements = {} must be 0 (chosen by boundary_integral.accuracy) or >= {}",
                        elements, fewest_elements));
    require(p.time.tolerance == 0 || p.time.tolerance >= strictest_tolerance,
            fmt::format("time.tolerance = {:g} must be 0 (chosen by the engine) or >= {:g}", p.time.tolerance,
                        strictest_tolerance));
}

void check_times(const Parameters& p, const Require& require) {
    require(first_step(p) <= longest_step(p),
            fmt::format("time.initial_step = {:.5g} µs must not exceed time.max_step = {:.5g} µs", first_step(p),
                        longest_step(p)));
    const auto check_interval = [&](const char* name, double interval) {
        require(p.time.end <= most_outputs * interval,
                fmt::format("output.{} = {} µs gives more than {} files or shapes until time.end = {} µs; enlarge it",
                            name, interval, most_outputs, p.time.end));
    };
    if (p.output.shape_interval > 0) check_interval("shape_interval", p.output.shape_interval);
    if (p.output.field_interval > 0) check_interval("field_interval", p.output.field_interval);
}

}  // namespace

void check_case(const Parameters& p, const std::string& where) {
    const Require require = [&](bool holds, const std::string& message) {
        if (!holds) throw InputError(where + ": " + message);
    };
    if (p.domain.kind == DomainKind::box) check_box(p, require);
    check_loads(p, require);
    check_molecules(p, require);
    check_exchange(p, require);
    check_bulk(p, require);
    check_maturation(p, require);
    check_resolution(p, require);
    check_times(p, require);
}

}  // namespace endoflow
