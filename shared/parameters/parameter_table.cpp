#include "shared/parameters/parameter_table.h"

#include "shared/parameters/parameter_rows.h"

namespace endoflow {

namespace {

using namespace parameter_rows;
using P = Parameters;

std::vector<ParameterRow> case_rows() {
    using S = CaseParameters;
    return {
        free_on_restart(
            row("case", "name", &P::case_, &S::name, "", any(), "", "short name used in plots and reports")),
        free_on_restart(row("case", "description", &P::case_, &S::description, "", any(), "", "what the case is for")),
    };
}

std::vector<ParameterRow> domain_rows() {
    using S = DomainParameters;
    return {
        row("domain", "kind", &P::domain, &S::kind, "", any(), "",
            "box: membrane across a cylinder; free-space: closed vesicle in unbounded fluid"),
        row("domain", "radius", &P::domain, &S::radius, "nm", positive(1e5), "R", "radius of the cylindrical domain"),
        row("domain", "height", &P::domain, &S::height, "nm", positive(1e5), "",
            "height of the domain, 0 < z < height"),
        row("domain", "membrane_height", &P::domain, &S::membrane_height, "nm", positive(1e5), "z0",
            "height at which the membrane starts flat and stays attached to the outer wall"),
        row("domain", "pin_half_width", &P::domain, &S::pin_half_width, "nm", {0.01, 1e4}, "δ",
            "half width of the band |z - z0| < δ on r = R where u_z = 0 and the radial traction vanishes"),
        row("domain", "wall_clearance", &P::domain, &S::wall_clearance, "nm", positive(1e4), "",
            "a run stops when the membrane comes nearer than this to the bottom, the top or (away from its rim) the "
            "side wall"),
        row("domain", "spheroid_polar_axis", &P::domain, &S::spheroid_polar_axis, "nm", positive(1e5), "",
            "free space: semi-axis of the initial spheroid along z"),
        row("domain", "spheroid_equatorial_axis", &P::domain, &S::spheroid_equatorial_axis, "nm", positive(1e5), "",
            "free space: semi-axis of the initial spheroid across z"),
    };
}

std::vector<ParameterRow> fluid_rows() {
    using S = FluidParameters;
    return {
        row("fluid", "viscosity_extracellular", &P::fluid, &S::viscosity_extracellular, "pN µs/nm^2", positive(1e3),
            "ν1", "viscosity below the membrane (φ = +1); 1e-3 pN µs/nm^2 = 1 mPa s"),
        row("fluid", "viscosity_intracellular", &P::fluid, &S::viscosity_intracellular, "pN µs/nm^2", positive(1e3),
            "ν2", "viscosity above the membrane (φ = -1)"),
        row("fluid", "density", &P::fluid, &S::density, "pN µs^2/nm^4", at_least(0, 1), "ρ",
            "density of both fluids, used when inertia is on; 1e-9 = 1000 kg/m^3"),
        row("fluid", "inertia", &P::fluid, &S::inertia, "", any(), "",
            "Navier-Stokes instead of Stokes flow (phase-field engine only)"),
        row("fluid", "dynamics", &P::fluid, &S::dynamics, "", any(), "",
            "flow: the membrane moves with the fluid; geometric: gradient flow of the bending energy, no fluid"),
        row("fluid", "normal_mobility", &P::fluid, &S::normal_mobility, "nm^3/(pN µs)", positive(1e12), "",
            "geometric evolution: normal velocity per normal force density, the sharp limit of γ 3ε/(2√2)"),
        row("fluid", "pressure_difference", &P::fluid, &S::pressure_difference, "pN/nm^2", {-10, 10}, "p",
            "pressure outside the cell minus that inside, kept up at the outer walls; > 0 pushes the bud into the "
            "cell; 1e-3 pN/nm^2 = 1 kPa, the scale of a cell's turgor"),
    };
}

std::vector<ParameterRow> membrane_rows() {
    using S = MembraneParameters;
    return {
        row("membrane", "bending_stiffness", &P::membrane, &S::bending_stiffness, "pN nm", positive(1e6), "b_m",
            "bending stiffness of the bare membrane, b(0); 100 pN nm = 1e-19 J"),
        row("membrane", "bending_stiffness_coated", &P::membrane, &S::bending_stiffness_coated, "pN nm", positive(1e7),
            "b(1)", "bending stiffness of the fully coated membrane; Table 1: 12 b_m"),
        row("membrane", "spontaneous_curvature", &P::membrane, &S::spontaneous_curvature, "1/nm", {-10, 10}, "H0",
            "spontaneous curvature of the fully coated membrane; Table 1: 1/14.1 nm; > 0 bends it into the cell"),
        row("membrane", "curvature_convention", &P::membrane, &S::curvature_convention, "", any(), "",
            "how (b, H0) enter the energy: as-printed (4)-(5) β = b/2, C = 2 H0; consistent (1)-(2) β = b, C = H0"),
        row("membrane", "constitutive_law", &P::membrane, &S::constitutive_law, "", any(), "",
            "b(c) and H0(c): linear (Table 1), coarse-grained (A.7), lumped (A.8)"),
        row("membrane", "inextensible", &P::membrane, &S::inextensible, "", any(), "",
            "local inextensibility, enforced by the tension λ"),
        row("membrane", "rim_tension", &P::membrane, &S::rim_tension, "pN/nm", {-10, 10}, "σ",
            "tension of the membrane at its rim; cells: 0.003 to 0.3 pN/nm (1 pN/nm = 1 mN/m)"),
        row("membrane", "pole_force", &P::membrane, &S::pole_force, "pN", {-1e4, 1e4}, "F",
            "force on the membrane around the axis, as of growing actin; > 0 pulls it into the cell"),
        row("membrane", "pole_force_width", &P::membrane, &S::pole_force_width, "nm", {0.1, 1e3}, "w",
            "the pole force's density falls off as exp(-a/(π w^2)), a the membrane's area from the pole"),
        row("membrane", "coat_force", &P::membrane, &S::coat_force, "pN", {-1e4, 1e4}, "F_a",
            "force on the coat, in proportion to c, as of actin bound to it; > 0 pulls it into the cell"),
        row("membrane", "coat_force_ring", &P::membrane, &S::coat_force_ring, "nm", at_least(0, 1e5), "[a1, a2]",
            "material radii of the ring around the coat that bears -F_a; [0, 0] = the rim bears it"),
        row("membrane", "collar_force", &P::membrane, &S::collar_force, "pN", {-1e4, 1e4}, "F_d",
            "radial force of a collar around the neck, as of dynamin; > 0 narrows it"),
        row("membrane", "collar_width", &P::membrane, &S::collar_width, "nm", {0.1, 1e3}, "w_d",
            "standard deviation of the collar's force along a neck of 10 nm"),
        row("membrane", "collar_position", &P::membrane, &S::collar_position, "nm", at_least(0, 1e5), "a_d",
            "material radius of the collar; 0 = where the neck is when it is first narrower than 10 nm"),
        row("membrane", "gaussian_stiffness", &P::membrane, &S::gaussian_stiffness, "pN nm", {-1e5, 1e5}, "κ_G",
            "energy per Gaussian curvature; only statics --hold names it: scission of a neck costs 4π κ_G more"),
    };
}

std::vector<ParameterRow> molecule_rows() {
    using S = MoleculeParameters;
    return {
        row("molecules", "patch_radius", &P::molecules, &S::patch_radius, "nm", positive(1e5), "r_c",
            "radius of the initial patch of curvature-inducing molecules"),
        row("molecules", "transport", &P::molecules, &S::transport, "", any(), "",
            "cahn-hilliard (23)-(24), fickian (22) or advection (14) only"),
        row("molecules", "diffusivity", &P::molecules, &S::diffusivity, "nm^2/µs", at_least(0, 1e9), "D_c",
            "surface diffusivity of the fickian law"),
        row("molecules", "mobility", &P::molecules, &S::mobility, "nm^3/µs", positive(1e12), "D_c",
            "mobility of the cahn-hilliard law"),
        row("molecules", "interface_width", &P::molecules, &S::interface_width, "nm", {0.01, 1e4}, "ε_c",
            "width of the patch's edge, the ε of (24); independent of phase_field.epsilon"),
        row("molecules", "normal_diffusivity", &P::molecules, &S::normal_diffusivity, "nm^2/µs", at_least(0, 1e12),
            "D_n",
            "diffusivity across the layer of (39) (phase-field engine, fickian and advection; scheme production: "
            "at least 1.1e5 nm^5/µs / epsilon^3)"),
        row("molecules", "coupling", &P::molecules, &S::coupling, "", any(), "",
            "none: the molecules know nothing of bending and their edge exerts no force (the paper); energetic: they "
            "move down the variation of bending and line energy, whose stress the membrane feels"),
        row("molecules", "line_energy", &P::molecules, &S::line_energy, "pN", at_least(0, 1e6), "σ̂",
            "with coupling = energetic: the coat's edge costs σ̂ √2/6 per length; the molecules' mobility is then "
            "molecules.mobility per pN"),
        row("molecules", "exchange", &P::molecules, &S::exchange, "", any(), "",
            "how molecules come and go: none; reservoir, everywhere from the fluid; edge, assembly at the coat's edge"),
        row("molecules", "on_rate", &P::molecules, &S::on_rate, "1/µs", at_least(0, 1e6), "k_on",
            "reservoir: rate at which bare membrane is covered"),
        row("molecules", "off_rate", &P::molecules, &S::off_rate, "1/µs", at_least(0, 1e6), "k_off",
            "reservoir: rate at which molecules leave"),
        row("molecules", "curvature_sensing", &P::molecules, &S::curvature_sensing, "", at_least(0, 1), "s",
            "reservoir: part of ∂e/∂c, the bending energy a molecule frees by leaving, that makes it leave faster"),
        row("molecules", "thermal_energy", &P::molecules, &S::thermal_energy, "pN nm", {0.1, 1e3}, "k_B T",
            "what curvature sensing and barriers are compared with; 4.11 pN nm at 25 °C, 4.28 at 37 °C"),
        row("molecules", "molecule_area", &P::molecules, &S::molecule_area, "nm^2", at_least(0, 1e4), "a₀",
            "membrane's area per molecule, for curvature sensing and for molecules from a bulk"),
        row("molecules", "edge_speed", &P::molecules, &S::edge_speed, "nm/µs", at_least(0, 1e3), "v",
            "edge: speed at which a flat coat's radius grows; 1e-3 nm/µs = 1 µm/s"),
        row("molecules", "pool_area", &P::molecules, &S::pool_area, "nm^2", at_least(0, 1e12), "m_pool",
            "coat that all molecules together can make, on the membrane and off it; attachment slows down as "
            "1 - m/m_pool; 0 = unlimited"),
        row("molecules", "bulk", &P::molecules, &S::bulk, "", any(), "",
            "the fluid that the molecules of molecules.exchange come from and leave to, carried along and diffusing "
            "there; attachment slows down as c_b/c_∞ at the membrane; none: nothing is depleted"),
        row("molecules", "bulk_diffusivity", &P::molecules, &S::bulk_diffusivity, "nm^2/µs", at_least(0, 1e9), "D_b",
            "of the molecules in the bulk; 1 nm^2/µs = 1 µm^2/s"),
        row("molecules", "bulk_concentration", &P::molecules, &S::bulk_concentration, "1/nm^3", at_least(0, 1), "c_∞",
            "of the molecules in the bulk at the start; 1 µM = 6.022e-7/nm^3"),
        row("molecules", "bulk_reach", &P::molecules, &S::bulk_reach, "nm", at_least(0, 1e9), "ℓ",
            "how far beyond the walls the bulk has c_∞; 0 = the walls let no molecule through"),
        row("molecules", "maturation", &P::molecules, &S::maturation, "", any(), "",
            "how the coat's curvature ages, C = χ(t) C(c): none, χ = 1; exponential, dχ/dt = k (1 - χ); cooperative, "
            "dχ/dt = k (1 - χ²)"),
        row("molecules", "maturation_rate", &P::molecules, &S::maturation_rate, "1/µs", at_least(0, 1e6), "k",
            "maturation: how fast; 1e-6/µs = 1/s"),
        row("molecules", "maturation_start", &P::molecules, &S::maturation_start, "", at_least(0, 1), "χ₀",
            "maturation: the part of the curvature that the coat has at the start, and in statics"),
    };
}

std::vector<ParameterRow> phase_field_rows() {
    using S = PhaseFieldParameters;
    return {
        row("phase_field", "scheme", &P::phase_field, &S::scheme, "", any(), "",
            "production = all fields implicit, BDF3 with error control; paper = the first-order splitting of Sec. 3"),
        row("phase_field", "epsilon", &P::phase_field, &S::epsilon, "nm", positive(1e3), "ε", "interface thickness"),
        row("phase_field", "stretching_diffusivity", &P::phase_field, &S::stretching_diffusivity, "nm^2/µs",
            at_least(0, 1e9), "D_s", "diffusivity of the stretching s along the membrane in (38)"),
        row("phase_field", "viscosity_mean", &P::phase_field, &S::viscosity_mean, "", any(), "ν(φ)",
            "how the viscosity changes across the layer: arithmetic (the paper) or harmonic"),
        row("phase_field", "cell_size", &P::phase_field, &S::cell_size, "nm", at_least(0, 1e3), "h",
            "size of the cells at the membrane; 0 = chosen by the scheme from ε and ε_c"),
        row("phase_field", "far_refinements", &P::phase_field, &S::far_refinements, "", at_least(0, 6), "",
            "cells far from the membrane are 2^this times larger; the paper: 3"),
        row("phase_field", "free_space", &P::phase_field, &S::free_space, "", at_least(1.5, 100), "",
            "free space: radius and half height of the box, in longer semi-axes of the spheroid"),
        row("phase_field", "band_width", &P::phase_field, &S::band_width, "", at_least(0, 20), "",
            "half width of the band of small cells around the membrane, in units of ε, at least 2; 0 = chosen by the "
            "scheme"),
        row("phase_field", "degree", &P::phase_field, &S::degree, "", at_least(2, 6), "",
            "polynomial degree of φ, g and f; the paper: 2, which pins the interface to cells of size ε"),
        row("phase_field", "velocity_degree", &P::phase_field, &S::velocity_degree, "", at_least(2, 6), "",
            "polynomial degree of the velocity; the pressure is one degree lower; the paper: 2"),
        row("phase_field", "tension_degree", &P::phase_field, &S::tension_degree, "", at_least(1, 6), "",
            "polynomial degree of λ; stable for small ξ only below velocity_degree; the paper: 2"),
        row("phase_field", "surface_degree", &P::phase_field, &S::surface_degree, "", at_least(1, 6), "",
            "polynomial degree of the stretching and of the molecules; the paper: 2"),
    };
}

std::vector<ParameterRow> paper_scheme_rows() {
    using S = PaperSchemeParameters;
    const auto paper = [](auto& p) -> auto& {
        return p.phase_field.paper;
    };
    return {
        row("phase_field.paper", "mobility", paper, &S::mobility, "nm^2/(pN µs)", at_least(0, 1e6), "γ",
            "mobility of the phase field in (35); Table 1's 6.4 nm^3/s is 6.4e-6 nm^2/(pN µs)"),
        row("phase_field.paper", "tension_extension", paper, &S::tension_extension, "1/(pN µs)", positive(1e9), "ξ",
            "extension of the tension off the membrane in (34); Table 1: 390.625, which leaks area"),
        row("phase_field.paper", "stretching_relaxation", paper, &S::stretching_relaxation, "", at_least(0, 10), "ζτ",
            "part of the stretching s - 1 that (34) removes per time step; printed: 1"),
        row("phase_field.paper", "profile_mobility", paper, &S::profile_mobility, "nm/µs", at_least(0, 1e6), "M",
            "relaxation of φ towards its profile along the normal, without curvature flow; printed: 0"),
        row("phase_field.paper", "advection_centering", paper, &S::advection_centering, "", at_least(0, 1), "",
            "weight of the new φ in u·∇φ; 0 = old φ as printed, 0.5 = no anti-diffusion of the profile"),
        row("phase_field.paper", "force_centering", paper, &S::force_centering, "", at_least(0, 1), "",
            "weight of the new φ and f in the membrane's forces; 0 = as printed, 1 = exact balance"),
        row("phase_field.paper", "bending_unknown", paper, &S::bending_unknown, "", any(), "",
            "what is a finite element function: f as printed, or the moment β f, whose g is the exact variation of the "
            "discrete energy"),
        row("phase_field.paper", "force_sign", paper, &S::force_sign, "", any(), "±g ∇φ",
            "sign of the membrane's force: plus as in (20) and (32), minus as in Sec. 3, which feeds energy in"),
        row("phase_field.paper", "step_rule", paper, &S::step_rule, "", any(), "",
            "ramp = the printed steps, whatever the membrane does: a step that fails ends the run; guarded = they are "
            "held back by max_motion, and a step that fails is halved"),
        row("phase_field.paper", "ramp_steps", paper, &S::ramp_steps, "", at_least(1, 1e6), "",
            "the time step doubles after so many steps until it reaches its limit; printed: 30"),
        row("phase_field.paper", "max_step", paper, &S::max_step, "µs", positive(1e6), "τ_max",
            "largest time step (time.max_step holds as well); printed: 2e-3"),
        row("phase_field.paper", "max_motion", paper, &S::max_motion, "nm", positive(1e3), "",
            "largest motion of the membrane within one time step; step_rule = ramp does not read it"),
    };
}

std::vector<ParameterRow> production_scheme_rows() {
    using S = ProductionSchemeParameters;
    const auto production = [](auto& p) -> auto& {
        return p.phase_field.production;
    };
    return {
        row("phase_field.production", "profile_relaxation", production, &S::profile_relaxation, "V", positive(1e9), "M",
            "flux along the normal that keeps |∇ψ| = 1, at most 2000 times the membrane's speed; V = β/((ν₁ + ν₂) L²)"),
        row("phase_field.production", "tension_alignment", production, &S::tension_alignment, "1/ν", positive(1e9), "",
            "keeps λ constant across the layer; ν is the smaller viscosity"),
        row("phase_field.production", "tension_leak", production, &S::tension_leak, "1/ν", positive(1e6), "",
            "defines λ far from the layer; as small as it is, it leaks no area"),
        row("phase_field.production", "strain_relaxation", production, &S::strain_relaxation, "V/L", at_least(0, 1e9),
            "ζ", "rate at which accumulated area strain s - 1 is removed"),
        row("phase_field.production", "stretching_alignment", production, &S::stretching_alignment, "V L",
            positive(1e12), "", "keeps s constant across the layer"),
        row("phase_field.production", "thinning", production, &S::thinning, "L", at_least(0, 10), "ρ₀",
            "where a radius of curvature of the membrane is below it the layer is thinner in proportion; 0 = uniform"),
    };
}

std::vector<ParameterRow> boundary_integral_rows() {
    using S = BoundaryIntegralParameters;
    return {
        row("boundary_integral", "accuracy", &P::boundary_integral, &S::accuracy, "", {1e-6, 0.1}, "",
            "relative error wanted of neck radius and budding time: chooses the elements and the time steps' "
            "tolerance"),
        row("boundary_integral", "elements", &P::boundary_integral, &S::elements, "", at_least(0, 2000), "",
            "number of spline elements along the membrane, from 8 on; 0 = chosen by accuracy, more when a run needs "
            "them"),
        row("boundary_integral", "quadrature_order", &P::boundary_integral, &S::quadrature_order, "", at_least(4, 20),
            "", "Gauss points per element"),
        free_on_restart(row("boundary_integral", "threads", &P::boundary_integral, &S::threads, "", at_least(0, 256),
                            "",
                            "threads that share the work; 0 = one for each core that the process may use, at most "
                            "OMP_NUM_THREADS")),
        row("boundary_integral", "mesh_curvature_length", &P::boundary_integral, &S::mesh_curvature_length, "nm",
            at_least(0, 1e3), "", "elements get short where the curvature exceeds the inverse of this"),
        row("boundary_integral", "mesh_edge_length", &P::boundary_integral, &S::mesh_edge_length, "nm",
            at_least(0, 1e3), "", "the edge of the patch has as many elements as this length of a bare flat membrane"),
        row("boundary_integral", "mesh_smoothing", &P::boundary_integral, &S::mesh_smoothing, "", positive(1), "",
            "part of the mesh over which the element density is filtered, so that neighbours are similar"),
        row("boundary_integral", "mesh_relaxation_time", &P::boundary_integral, &S::mesh_relaxation_time, "µs",
            {1e-5, 1e3}, "", "time in which elements move to where they are wanted"),
        free_on_restart(row(
            "boundary_integral", "restart_interval", &P::boundary_integral, &S::restart_interval, "", at_least(5, 1e6),
            "", "time steps between points that a restart can go on from; the integrator starts anew at each of them")),
        free_on_restart(row("boundary_integral", "neck_closed_radius", &P::boundary_integral, &S::neck_closed_radius,
                            "nm", at_least(0, 10), "",
                            "the run ends with neck_closed when the neck radius falls below this")),
        free_on_restart(row("boundary_integral", "field_spacing", &P::boundary_integral, &S::field_spacing, "nm",
                            {0.1, 1e3}, "", "distance of the points where fields are evaluated")),
    };
}

std::vector<ParameterRow> time_rows() {
    using S = TimeParameters;
    return {
        free_on_restart(row("time", "end", &P::time, &S::end, "µs", positive(1e9), "T", "simulated time")),
        free_on_restart(row("time", "tolerance", &P::time, &S::tolerance, "", at_least(0, 0.1), "",
                            "relative accuracy of the time steps where they are error-controlled; 0 = a tenth of "
                            "boundary_integral.accuracy in that engine, 1e-4 in the other")),
        free_on_restart(row("time", "initial_step", &P::time, &S::initial_step, "µs", at_least(0, 1e3), "",
                            "first time step; 0 = 1.9458e-4 (ν₁ + ν₂) L³/β, L being what forms, 2/C of a coat: 1e-5 µs "
                            "in the standard case; an eighth of it with phase_field.scheme = production")),
        free_on_restart(
            row("time", "max_step", &P::time, &S::max_step, "µs", at_least(0, 1e6), "",
                "largest time step; 0 = no bound in the sharp engine: its error decides. In the other 3.8916 "
                "(ν₁ + ν₂) L³/β, 0.2 µs in the standard case, or 0.02 of the time of the molecules' "
                "exchange where that is longer; five times as long with phase_field.scheme = production")),
    };
}

std::vector<ParameterRow> output_rows() {
    using S = OutputParameters;
    return {
        free_on_restart(
            row("output", "shape_interval", &P::output, &S::shape_interval, "µs", at_least(0, 1e9), "",
                "simulated time between membrane shapes in shapes.h5, earlier ones at 1/256, 1/128, ... 1/2 of it; 0 = "
                "some 400 shapes until time.end, closer early")),
        free_on_restart(row("output", "field_interval", &P::output, &S::field_interval, "µs", at_least(0, 1e9), "",
                            "simulated time between field files for ParaView; 0 = no field files at all")),
        free_on_restart(
            row("output", "checkpoint_interval", &P::output, &S::checkpoint_interval, "s", at_least(0, 1e9), "",
                "wall time between checkpoints; less while they cost below 1 % of it, more where above 2 %")),
        free_on_restart(row("output", "stop_at_budding", &P::output, &S::stop_at_budding, "", any(), "",
                            "end the run when the neck radius falls below 5 nm")),
    };
}

std::vector<ParameterRow> build_table() {
    std::vector<ParameterRow> table;
    for (auto rows :
         {case_rows(), domain_rows(), fluid_rows(), membrane_rows(), molecule_rows(), phase_field_rows(),
          paper_scheme_rows(), production_scheme_rows(), boundary_integral_rows(), time_rows(), output_rows()})
        table.insert(table.end(), rows.begin(), rows.end());
    return table;
}

}  // namespace

const std::vector<ParameterRow>& parameter_table() {
    static const std::vector<ParameterRow> table = build_table();
    return table;
}

}  // namespace endoflow
