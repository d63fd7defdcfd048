#include "shared/model/bending_model.h"

#include <algorithm>

#include "shared/model/maturation.h"

namespace endoflow {

namespace {

ValueAndDerivatives scaled(const ValueAndDerivatives& f, double factor) {
    return {factor * f.value, factor * f.first, factor * f.second};
}

/// a / (d − e c) as a function of c.
ValueAndDerivatives reciprocal(double a, double d, double e, double c) {
    const double q = 1 / (d - e * c);
    return {a * q, a * e * q * q, 2 * a * e * e * q * q * q};
}

/// a c / (d + e c) as a function of c.
ValueAndDerivatives saturating(double a, double d, double e, double c) {
    const double q = 1 / (d + e * c);
    return {a * c * q, a * d * q * q, -2 * a * d * e * q * q * q};
}

}  // namespace

double clip_concentration(double c) {
    return std::clamp(c, 0.0, 1.0);
}

BendingModel::BendingModel(const MembraneParameters& membrane, double maturity)
    : law_(membrane.constitutive_law),
      bare_(membrane.bending_stiffness),
      added_(membrane.bending_stiffness_coated - membrane.bending_stiffness),
      curvature_(maturity * membrane.spontaneous_curvature),
      stiffness_scale_(membrane.curvature_convention == CurvatureConvention::as_printed ? 0.5 : 1.0),
      curvature_scale_(membrane.curvature_convention == CurvatureConvention::as_printed ? 2.0 : 1.0) {}

ValueAndDerivatives BendingModel::stiffness(double c) const {
    const double coated = added_ + bare_;
    const ValueAndDerivatives b = law_ == ConstitutiveLaw::coarse_grained
                                      ? reciprocal(coated * bare_, coated, added_, c)
                                      : ValueAndDerivatives{bare_ + added_ * c, added_, 0};
    return scaled(b, stiffness_scale_);
}

ValueAndDerivatives BendingModel::spontaneous_curvature(double c) const {
    ValueAndDerivatives h{curvature_ * c, curvature_, 0};
    if (law_ == ConstitutiveLaw::coarse_grained) h = scaled(h, added_ / (added_ + bare_));
    if (law_ == ConstitutiveLaw::lumped) h = saturating(curvature_ * added_, bare_, added_, c);
    return scaled(h, curvature_scale_);
}

BendingModel bending_model(const Parameters& parameters, double time) {
    return BendingModel(parameters.membrane, MaturationLaw(parameters.molecules).maturity(time));
}

}  // namespace endoflow
