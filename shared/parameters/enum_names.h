#pragma once

#include <array>

#include "shared/parameters/parameters.h"

namespace endoflow {

/// The words of case files for the values of each enumeration, in their order.
template <class Enum>
struct EnumNames;

template <>
struct EnumNames<DomainKind> {
    static constexpr std::array names{"box", "free-space"};
};
template <>
struct EnumNames<Dynamics> {
    static constexpr std::array names{"flow", "geometric"};
};
template <>
struct EnumNames<CurvatureConvention> {
    static constexpr std::array names{"as-printed", "consistent"};
};
template <>
struct EnumNames<ConstitutiveLaw> {
    static constexpr std::array names{"linear", "coarse-grained", "lumped"};
};
template <>
struct EnumNames<Transport> {
    static constexpr std::array names{"cahn-hilliard", "fickian", "advection"};
};
template <>
struct EnumNames<Coupling> {
    static constexpr std::array names{"none", "energetic"};
};
template <>
struct EnumNames<Exchange> {
    static constexpr std::array names{"none", "reservoir", "edge"};
};
template <>
struct EnumNames<PhaseFieldScheme> {
    static constexpr std::array names{"paper", "production"};
};
template <>
struct EnumNames<StepRule> {
    static constexpr std::array names{"guarded", "ramp"};
};
template <>
struct EnumNames<BendingUnknown> {
    static constexpr std::array names{"moment", "f"};
};
template <>
struct EnumNames<ForceSign> {
    static constexpr std::array names{"plus", "minus"};
};
template <>
struct EnumNames<ViscosityMean> {
    static constexpr std::array names{"arithmetic", "harmonic"};
};

}  // namespace endoflow
