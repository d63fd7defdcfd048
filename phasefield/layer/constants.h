#pragma once

#include <stdexcept>
#include <string_view>

namespace endoflow::phasefield {

/// A number of the scheme that is no parameter: docs/phase-field.md says what happens where some of them change.
struct Constant {
    std::string_view name;
    double value;
    std::string_view unit;
    std::string_view meaning;
};

/// All of them; the files that use one take it from here by constant(), and run.json lists them.
inline constexpr Constant constant_table[] = {
    // The equations
    {"tail_cut", 1e-3, "max δ",
     "f of the energy's weight δ²/(δ + f): 4 ε from the membrane normals may cross, and the last solution's take over"},
    {"weight_cut", 1e-4, "(1 − φ²)²", "below it δ_Γ is cut off, and the last solution's normals take over for c"},
    {"surface_floor", 1.2e-8, "1/ε", "added to δ, so that G, μ and s are defined everywhere"},
    {"largest_sheet_bend", 0.5, "", "of κψ, by which the sheet at the distance ψ is longer than the membrane"},
    {"moment_floor", 3.33e-5, "ε", "continues m smoothly where the energy has no weight"},
    {"steepest_sheets", 0.25, "", "ε over the radius around the axis at most, where the energy accounts for it"},
    {"gradient_floor", 1e-3, "", "of |∇ψ| in the normal"},
    {"concentration_margin", 0.05, "", "how far beyond 0 and 1 the laws see c"},
    {"alignment", 20, "ε²", "keeps G and m constant along the normal, and per step c, s and ∂ψ/∂t"},
    {"strong_alignment", 1000, "ε²", "the same for what each sheet gives another value: a coupled energy's μ, a bulk"},
    {"layer_pressure_alignment", 0.03, "1/ν", "keeps p_Γ constant along the normal"},
    {"pressure_leak", 1.2e-5, "1/(ν ε)", "∇·u per p_Γ: decides between p and δ p_Γ"},
    {"divergence_penalty", 0.124, "ν V over the membrane's speed",
     "of ∇·u, of which pressures leave some within cells"},
    {"most_penalty", 30, "ν", "the same where the membrane is at rest"},
    {"far_part", 1e-7, "M_p", "with which ψ becomes the distance far from the layer"},
    {"least_normal_diffusivity", 0.0101, "V L (L/ε)³", "of c along the normal: 6.4e4 nm²/µs at ε = 1.2 nm"},
    {"fast_membrane", 0.373, "V", "below it that fades with the membrane's speed"},
    {"slowest_alignment", 0.05, "", "part of it that is left where the membrane is slow"},
    {"molecule_leak", 3.63e-6, "V", "defines c far from the layer"},
    {"crowding_length", 0.1, "h", "D_s over the speed at which molecules crowd the membrane within a cell"},
    {"uneven_fade", 20, "1/ε", "∂_N∇ψ beyond which what acts along normals fades: there layers meet"},
    // The weight δ_Γ (membrane_weight.cpp)
    {"equal_square", -19.568237, "", "of φ² in δ_Γ for equal viscosities, from where others are found"},
    {"equal_fourth", 21.450931, "", "the same of φ⁴"},
    {"largest_ratio", 45, "", "of the viscosities for which δ_Γ is free of excess shear"},
    {"smallest_viscosity", 0.2, "", "in the layer, of the smaller one, for larger ratios"},
    {"ratio_step", 1.15, "", "of the ratios through which δ_Γ is found"},
    {"smallest_square", -5.2, "", "of φ² in a δ_Γ without φ⁴: just below the zero for equal viscosities"},
    {"equal_viscosities", 1e-3, "", "relative difference below which the excess fluidity is round-off"},
    {"smallest_fluidity", 0.5, "", "in the layer, of the smaller one, with harmonic means"},
    {"rim_half_width", 4.5, "ε", "where ψ and G are held at the rim: the layer as far as it weighs anything"},
    // The bulk (bulk_equations.cpp)
    {"bulk_floor", 1e-6, "", "χ of the fluid that has no molecules, so that the bulk is defined everywhere"},
    {"shortest_gradient", 0.3, "", "below it normals fade: they are about to cross"},
    // The layer's thickness (layer_thickness.cpp)
    {"thinnest", 0.125, "phase_field.epsilon", "the layer, however narrow the membrane"},
    {"room_needed", 6.5, "ε", "from the membrane to where its layer meets another one: 2e-7 of δ are left there"},
    {"thinning_slope", 0.1, "", "of the thickness along the membrane, at most"},
    {"thinning_window", 1, "phase_field.epsilon", "half the arc from which the membrane's curvature is taken"},
    // Steps (production_scheme.cpp)
    {"default_tolerance", 1e-4, "", "time.tolerance where that is 0"},
    {"error_part", 0.05, "time.tolerance", "error of one step: the errors of the steps add up"},
    {"first_order_part", 0.125, "time.initial_step's default", "the first step, which is of order 1"},
    {"safety", 0.85, "", "of the step"},
    {"largest_growth", 1.5, "", "of the step, per step"},
    {"after_hard_step", 0.8, "",
     "of a step beyond time.max_step's default, at most, where one factorisation did not serve"},
    {"almost_all", 0.7, "", "of the time left: one step, or ever shorter ones would approach the end"},
    {"tolerated_excess", 2, "", "of the error over its tolerance, beyond which a step is repeated"},
    {"retry", 0.5, "", "of a step, its repetition at most; its square at least"},
    {"smallest_step", 1e-4, "the first step", "below it the run ends"},
    {"relaxation_per_speed", 2000, "", "M_p is at most this many times the speed of the membrane"},
    {"largest_motion", 1.5, "ε", "of the membrane in one step"},
    {"longer_steps", 5, "", "than those of time.max_step's default, which the sharp engine has"},
    // Newton's method (step_solver.cpp)
    {"newton_part", 0.02, "the step's tolerance", "to which Newton's method converges"},
    {"most_iterations", 16, "", "with old factors, twice as many with new ones: making those costs as much as twenty"},
    {"seen_enough", 3, "", "iterations after which the number needed is foreseen"},
    {"farthest", 0.25, "ε", "from where the factors were made: beyond they do not serve"},
    {"most_failures", 6, "", "in a row: the k-th lets old factors, or single precision, alone for 2^(k − 2) steps"},
    {"most_factorisations", 4, "", "in one step"},
    {"fast_contraction", 0.5, "", "of the changes by new factors: below it the next change can be foreseen"},
    {"largest_rest", 0.01, "", "of the first increment, in all fields: m follows ψ's second derivatives"},
    {"hardly_present", 3e-4, "", "of (1 − φ²)² at the membrane: increments there count half"},
    {"round_off", 1e-8, "a field's size", "first increments below it count as that large: at rest they are noise"},
    {"most_divergence", 10, "", "of a change beyond the first one, where Newton's method gives up"},
    // The mesh (refinement.cpp, mesh_following.cpp)
    {"cell_per_epsilon", 4.0 / 3, "ε",
     "cells in the layer where phase_field.cell_size is 0: they resolve the distance"},
    {"edge_cells", 0.75, "ε_c", "largest cell at the patch's edge"},
    {"edge_part", 0.47, "", "|c − ½| below this is the edge: in the bud 1 − c comes to 0.016"},
    {"fine_band", 3, "ε", "half-width of the finer cells, and of those in the layer where phase_field.band_width is 0"},
    {"cells_slack", 1.05, "", "cells of a thinner layer may be this much wider, in units of ε"},
    {"pin_cells", 0.1, "z_p", "largest cell at the ends of the pin band, between which u_z is held node by node"},
    {"neck_cells", 0.25, "", "largest cell where the membrane is narrow, in units of its radius there"},
    {"motion_without_flow", 0.5, "ε", "after which the mesh follows without flow; with it largest_motion"},
    {"most_neck_levels", 2, "", "with cells of 4/3 ε: necks below 1.4 ε have left the model anyway"},
    {"most_passes", 8, "", "of refinement: a cell changes by one level per pass"},
};

/// The value of a constant; asked at compile time, where a name that is not in the table does not compile.
consteval double constant(std::string_view name) {
    for (const auto& row : constant_table)
        if (row.name == name) return row.value;
    throw std::logic_error("no such constant");
}

/// A constant that counts.
consteval unsigned int count(std::string_view name) {
    return static_cast<unsigned int>(constant(name));
}

}  // namespace endoflow::phasefield
