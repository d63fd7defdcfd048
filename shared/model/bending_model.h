#pragma once

#include "shared/parameters/parameters.h"

namespace endoflow {

/// A scalar function of one variable with its first two derivatives.
struct ValueAndDerivatives {
    double value;
    double first;
    double second;
};

/// c limited to [0, 1]. The phase field's c may leave this range slightly; the laws below do not limit it themselves,
/// so that they stay smooth where a spectral representation over- or undershoots by its own small error.
[[nodiscard]] double clip_concentration(double c);

/// The membrane's bending law as the sharp energy (S) = ∫ ½ β(c) (κ − C(c))² dA uses it, κ being the total curvature.
///
/// The constitutive law gives b(c) and H0(c):
///   linear          b = b_m + b_c c,                      H0 = H0 c                              (Table 1)
///   coarse-grained  b = (b_c+b_m) b_m/(b_c+b_m − c b_c),  H0 = H0 c b_c/(b_c+b_m)                (A.7)
///   lumped          b = b_m + b_c c,                      H0 = H0 c b_c/(c b_c+b_m)              (A.8)
/// with b_c = b(1) − b_m; the curvature convention maps them once and for all onto
///   as-printed      β = b/2, C = 2 H0      (what (4), (5), (32), (36), (37) converge to)
///   consistent      β = b,   C = H0        (what (1), (2), (A.26) say)
class BendingModel {
  public:
    /// `maturity`: χ, by which C is the smaller (maturation.h).
    explicit BendingModel(const MembraneParameters& membrane, double maturity = 1);

    /// β(c) in pN nm.
    [[nodiscard]] ValueAndDerivatives stiffness(double c) const;

    /// C(c) in 1/nm, total curvature.
    [[nodiscard]] ValueAndDerivatives spontaneous_curvature(double c) const;

  private:
    ConstitutiveLaw law_;
    double bare_;             // b_m, pN nm
    double added_;            // b_c, pN nm
    double curvature_;        // H0, 1/nm
    double stiffness_scale_;  // β/b
    double curvature_scale_;  // C/H0
};

/// The law of a case at a time [µs].
[[nodiscard]] BendingModel bending_model(const Parameters& parameters, double time);

}  // namespace endoflow
