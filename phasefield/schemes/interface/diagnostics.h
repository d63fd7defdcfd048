#pragma once

namespace endoflow::phasefield {

/// Integrals over the layer, with 2πr; collective.
struct LayerIntegrals {
    double area;        // ½ ∫|∇φ| [nm²]
    double molecules;   // ½ ∫|∇φ| c [nm²]
    double stretching;  // ½ ∫|∇φ| s [nm²]
};

/// The fluid that the molecules come from.
struct BulkMeasures {
    double molecules = 0;  // ∫ χc_b
    double supply = 1;     // mean of c_b/c_∞ at the membrane
    double residual = 0;   // |∫ c dA − its first value − what fluid and walls have given| over the first value
    double made_up = 0;    // what has come through the walls since t = 0, as coat beyond c_∞ times the inflow [nm²]
    double corrected = 0;  // coat that was put right at the membrane since t = 0 [nm²]
};

/// What one time step did; collective.
struct StepDiagnostics {
    double bending_energy;        // (D) [pN nm]
    double viscous_dissipation;   // ∫ ½ ν D:D, and what a penalty of ∇·u takes [pN nm/µs]
    double mobility_dissipation;  // ∫ γ g²
    double tension_power;         // ∫ λ |∇φ| P:∇u: the tension's, 0 if the membrane does not stretch anywhere
    double transport_power;  // ∫ ∂E/∂c (∂c/∂t + u·∇c): what molecules that move along the membrane add to E
    double area_strain_max;           // max |s − 1| on |φ| < 0.9
    double thickness_error_max;       // max | √2 ε|∇φ|/(1 − φ²) − 1 | along the membrane, on |φ| < 0.5
    double profile_error_max;         // the same on |φ| < 0.9, where the layers of two parts of the membrane may meet
    double motion_max;                // max |φ − φⁿ|/|∇φⁿ| on |φ| < 0.9 [nm]
    double net_vertical_force = 0;    // of the membrane on the fluid [pN]; the pinned rim takes it up
    double extracellular_inflow = 0;  // −∮ ½(1 + φ) u·n dA [nm³/µs]
    double load_power = 0;            // of rim tension, pressure and pole force [pN nm/µs]
    double line_energy = 0;           // E_c [pN nm]
    double molecule_dissipation = 0;  // ∫ M |∇_Γ μ|² where bending and line energy drive the molecules
    double exchange_rate = 0;         // ∫ j dA [nm²/µs]
    double exchange_power = 0;        // E + E_c that molecules bring when they come [pN nm/µs]
    double maturation_power = 0;      // ∂E/∂χ dχ/dt [pN nm/µs]
    double molecules_put_right = 0;   // ∫ c dA that was added so that the step's balance of molecules is exact [nm²]
    BulkMeasures bulk{};
};

}  // namespace endoflow::phasefield
