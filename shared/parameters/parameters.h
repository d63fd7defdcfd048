#pragma once

#include <array>
#include <string>

namespace endoflow {

// Every default is the paper's standard case (Table 1) unless the parameter table says otherwise.
// Units: nm, µs, pN. Bounds, units, meanings and symbols of all of these stand in parameter_table.cpp.

enum class DomainKind { box, free_space };
enum class Dynamics { flow, geometric };
enum class CurvatureConvention { as_printed, consistent };
enum class ConstitutiveLaw { linear, coarse_grained, lumped };
enum class Transport { cahn_hilliard, fickian, advection };
enum class Coupling { none, energetic };
enum class Exchange { none, reservoir, edge };
enum class Maturation { none, exponential, cooperative };
enum class Bulk { none, extracellular, intracellular };
enum class PhaseFieldScheme { paper, production };
enum class StepRule { guarded, ramp };
enum class BendingUnknown { moment, f };
enum class ForceSign { plus, minus };
enum class ViscosityMean { arithmetic, harmonic };

struct CaseParameters {
    std::string name = "standard";
    std::string description;
};

struct DomainParameters {
    DomainKind kind = DomainKind::box;
    double radius = 80;
    double height = 160;
    double membrane_height = 80;
    double pin_half_width = 5;
    double wall_clearance = 2;
    double spheroid_polar_axis = 60;
    double spheroid_equatorial_axis = 40;
};

struct FluidParameters {
    double viscosity_extracellular = 1e-3;
    double viscosity_intracellular = 1e-2;
    double density = 1e-9;
    bool inertia = false;
    Dynamics dynamics = Dynamics::flow;
    double normal_mobility = 5.345;
    double pressure_difference = 0;
};

struct MembraneParameters {
    double bending_stiffness = 100;
    double bending_stiffness_coated = 1200;
    double spontaneous_curvature = 0.0709219858;
    CurvatureConvention curvature_convention = CurvatureConvention::as_printed;
    ConstitutiveLaw constitutive_law = ConstitutiveLaw::linear;
    bool inextensible = true;
    double rim_tension = 0;
    double pole_force = 0;
    double pole_force_width = 5;
    double coat_force = 0;
    std::array<double, 2> coat_force_ring{};
    double collar_force = 0;
    double collar_width = 5;
    double collar_position = 0;
    double gaussian_stiffness = 0;
};

struct MoleculeParameters {
    double patch_radius = 36;
    Transport transport = Transport::cahn_hilliard;
    double diffusivity = 16;
    double mobility = 64e3;
    double interface_width = 1.2;
    double normal_diffusivity = 1600;
    Coupling coupling = Coupling::none;
    double line_energy = 0;
    Exchange exchange = Exchange::none;
    double on_rate = 0;
    double off_rate = 0;
    double curvature_sensing = 0;
    double thermal_energy = 4.11;
    double molecule_area = 0;
    double edge_speed = 0;
    double pool_area = 0;
    Bulk bulk = Bulk::none;
    double bulk_diffusivity = 0;
    double bulk_concentration = 0;
    double bulk_reach = 0;
    Maturation maturation = Maturation::none;
    double maturation_rate = 0;
    double maturation_start = 0;
};

/// What scheme `paper` alone reads.
struct PaperSchemeParameters {
    double mobility = 0.0064;
    double tension_extension = 0.390625;
    double stretching_relaxation = 0.05;
    double profile_mobility = 600;
    double advection_centering = 0.5;
    double force_centering = 1;
    BendingUnknown bending_unknown = BendingUnknown::moment;
    ForceSign force_sign = ForceSign::plus;
    StepRule step_rule = StepRule::guarded;
    int ramp_steps = 10;
    double max_step = 2e-3;
    double max_motion = 0.3;
};

/// What scheme `production` alone reads.
struct ProductionSchemeParameters {
    double profile_relaxation = 73;
    double tension_alignment = 0.03;
    double tension_leak = 1e-5;
    double strain_relaxation = 5.15;
    double stretching_alignment = 51.6;
    double thinning = 1;
};

struct PhaseFieldParameters {
    PhaseFieldScheme scheme = PhaseFieldScheme::production;
    double epsilon = 1.2;
    double stretching_diffusivity = 16;
    ViscosityMean viscosity_mean = ViscosityMean::arithmetic;
    double cell_size = 0;
    int far_refinements = 3;
    double free_space = 8;
    double band_width = 0;
    int degree = 3;
    int velocity_degree = 3;
    int tension_degree = 2;
    int surface_degree = 3;
    PaperSchemeParameters paper;
    ProductionSchemeParameters production;
};

struct BoundaryIntegralParameters {
    double accuracy = 1e-3;
    int elements = 0;
    int quadrature_order = 8;
    int threads = 0;
    double mesh_curvature_length = 20;
    double mesh_edge_length = 27;
    double mesh_smoothing = 0.05;
    double mesh_relaxation_time = 0.002;
    int restart_interval = 200;
    double neck_closed_radius = 0.5;
    double field_spacing = 2;
};

struct TimeParameters {
    double end = 20;
    double tolerance = 0;
    double initial_step = 0;
    double max_step = 0;
};

struct OutputParameters {
    double shape_interval = 0;
    double field_interval = 0.5;
    double checkpoint_interval = 30;
    bool stop_at_budding = false;
};

struct Parameters {
    CaseParameters case_;
    DomainParameters domain;
    FluidParameters fluid;
    MembraneParameters membrane;
    MoleculeParameters molecules;
    PhaseFieldParameters phase_field;
    BoundaryIntegralParameters boundary_integral;
    TimeParameters time;
    OutputParameters output;
};

}  // namespace endoflow
