#pragma once

#include <boost/math/tools/roots.hpp>
#include <cstdint>

namespace endoflow {

/// The bracket of a zero of f between `lower` and `upper`, where its values have different signs or one is 0: ends that
/// agree to `bits` (Alefeld, Potra and Shi, ACM TOMS 748). Throws std::domain_error when f does not change its sign.
template <class Function>
[[nodiscard]] std::pair<double, double> bracketed_root(const Function& f, double lower, double upper, double f_lower,
                                                       double f_upper, int bits) {
    std::uintmax_t evaluations = 100;
    return boost::math::tools::toms748_solve(f, lower, upper, f_lower, f_upper,
                                             boost::math::tools::eps_tolerance<double>(static_cast<unsigned>(bits)),
                                             evaluations);
}

/// The middle of that bracket.
template <class Function>
[[nodiscard]] double root_between(const Function& f, double lower, double upper, double f_lower, double f_upper,
                                  int bits) {
    const auto [below, above] = bracketed_root(f, lower, upper, f_lower, f_upper, bits);
    return 0.5 * (below + above);
}

template <class Function>
[[nodiscard]] double root_between(const Function& f, double lower, double upper, int bits) {
    return root_between(f, lower, upper, f(lower), f(upper), bits);
}

}  // namespace endoflow
