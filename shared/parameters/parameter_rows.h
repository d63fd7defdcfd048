#pragma once

// What the rows of the table of parameters are made with: the words of enumerations, bounds, and the binding of a row
// to the member that it sets.

#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <type_traits>

#include "shared/parameters/parameter_table.h"

namespace endoflow::parameter_rows {

/// The words of case files for the values of each enumeration, in their order; a row an enumeration.
template <class Enum>
inline constexpr std::nullptr_t words{};  // an enumeration without a row does not compile
template <>
inline constexpr std::array words<DomainKind>{"box", "free-space"};
template <>
inline constexpr std::array words<Dynamics>{"flow", "geometric"};
template <>
inline constexpr std::array words<CurvatureConvention>{"as-printed", "consistent"};
template <>
inline constexpr std::array words<ConstitutiveLaw>{"linear", "coarse-grained", "lumped"};
template <>
inline constexpr std::array words<Transport>{"cahn-hilliard", "fickian", "advection"};
template <>
inline constexpr std::array words<Coupling>{"none", "energetic"};
template <>
inline constexpr std::array words<Exchange>{"none", "reservoir", "edge"};
template <>
inline constexpr std::array words<Maturation>{"none", "exponential", "cooperative"};
template <>
inline constexpr std::array words<Bulk>{"none", "extracellular", "intracellular"};
template <>
inline constexpr std::array words<PhaseFieldScheme>{"paper", "production"};
template <>
inline constexpr std::array words<StepRule>{"guarded", "ramp"};
template <>
inline constexpr std::array words<BendingUnknown>{"moment", "f"};
template <>
inline constexpr std::array words<ForceSign>{"plus", "minus"};
template <>
inline constexpr std::array words<ViscosityMean>{"arithmetic", "harmonic"};

/// Binds a row to the member it sets; `section` finds the member's struct in Parameters. `Member` decides the type a
/// case file must use.
template <class Find, class Section, class Member>
ParameterRow row(const char* section_name, const char* key, Find section, Member Section::*member, const char* unit,
                 Bounds bounds, const char* symbol, const char* meaning) {
    ParameterRow result{section_name, key, unit, bounds, symbol, meaning, {}, nullptr, nullptr};
    if constexpr (std::is_enum_v<Member>) {
        for (const char* name : words<Member>) result.choices.emplace_back(name);
        result.get = [section, member](const Parameters& p) -> ParameterValue {
            return std::string(words<Member>[static_cast<std::size_t>(std::invoke(section, p).*member)]);
        };
        result.set = [section, member](Parameters& p, const ParameterValue& value) {
            const auto& name = std::get<std::string>(value);
            for (std::size_t i = 0; i < words<Member>.size(); ++i)
                if (name == words<Member>[i]) std::invoke(section, p).*member = static_cast<Member>(i);
        };
    } else if constexpr (std::is_same_v<Member, int>) {
        result.get = [section, member](const Parameters& p) -> ParameterValue {
            return static_cast<long long>(std::invoke(section, p).*member);
        };
        result.set = [section, member](Parameters& p, const ParameterValue& value) {
            std::invoke(section, p).*member = static_cast<int>(std::get<long long>(value));
        };
    } else {
        result.get = [section, member](const Parameters& p) -> ParameterValue {
            return std::invoke(section, p).*member;
        };
        result.set = [section, member](Parameters& p, const ParameterValue& value) {
            std::invoke(section, p).*member = std::get<Member>(value);
        };
    }
    return result;
}

/// A row of a parameter that a restart may change.
inline ParameterRow free_on_restart(ParameterRow row) {
    row.free_on_restart = true;
    return row;
}

inline constexpr double infinity = std::numeric_limits<double>::infinity();

inline Bounds any() {
    return {};
}
inline Bounds positive(double highest = infinity) {
    return {0, highest, true, false};
}
inline Bounds at_least(double lowest, double highest = infinity) {
    return {lowest, highest, false, false};
}

}  // namespace endoflow::parameter_rows
