#pragma once

#include <array>
#include <type_traits>

#include "phasefield/schemes/production/fields.h"
#include "shared/numerics/forward.h"

namespace endoflow::phasefield::production {

/// What W depends on, ε as if it were one number at all points.
template <class Number>
struct EnergyArguments {
    AtPoint<Number> psi, m, c;
    Number epsilon;
};

/// Their order; ∇c is one of them where the energy knows ∇_Γ c.
namespace argument {
enum Index : std::size_t { psi, psi_r, psi_z, m, m_r, m_z, c, epsilon, c_r, c_z };
inline constexpr std::size_t count = c_z + 1, without_gradient = c_r;
}  // namespace argument

template <std::size_t count, class Number>
std::array<Number, count> listed(const EnergyArguments<Number>& x) {
    const auto& [psi, m, c, epsilon] = x;
    if constexpr (count == argument::count)
        return {psi.value, psi.r, psi.z, m.value, m.r, m.z, c.value, epsilon, c.r, c.z};
    else
        return {psi.value, psi.r, psi.z, m.value, m.r, m.z, c.value, epsilon};
}

/// The same values as variables: with second derivatives where the caller's numbers have first ones.
template <class Number, std::size_t count>
auto differentiated(const std::array<Number, count>& x) {
    using Variable = std::conditional_t<std::is_same_v<Number, double>, Dual<count>, Jet<count>>;
    const auto variable = [&x](std::size_t a) {
        return a < count ? Variable::variable(value_of(x[a]), a) : Variable(0.0);
    };
    using enum argument::Index;
    return EnergyArguments<Variable>{{variable(psi), variable(psi_r), variable(psi_z)},
                                     {variable(m), variable(m_r), variable(m_z)},
                                     {variable(c), variable(c_r), variable(c_z)},
                                     variable(epsilon)};
}

}  // namespace endoflow::phasefield::production
