#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace endoflow::phasefield {

/// A number with its derivatives with respect to N variables: forward automatic differentiation. Functions of it that
/// are also called with plain doubles exist here for both.
template <std::size_t N>
struct Dual {
    double value = 0;
    std::array<double, N> partial{};

    Dual() = default;
    Dual(double constant) : value(constant) {}  // NOLINT(google-explicit-constructor): constants mix with duals

    Dual& operator+=(const Dual& b) {
        value += b.value;
        for (std::size_t i = 0; i < N; ++i) partial[i] += b.partial[i];
        return *this;
    }
    friend Dual operator+(Dual a, const Dual& b) { return a += b; }
    friend Dual operator-(Dual a, const Dual& b) {
        a.value -= b.value;
        for (std::size_t i = 0; i < N; ++i) a.partial[i] -= b.partial[i];
        return a;
    }
    friend Dual operator-(Dual a) {
        a.value = -a.value;
        for (double& p : a.partial) p = -p;
        return a;
    }
    friend Dual operator*(const Dual& a, const Dual& b) {
        Dual result(a.value * b.value);
        for (std::size_t i = 0; i < N; ++i) result.partial[i] = a.partial[i] * b.value + a.value * b.partial[i];
        return result;
    }
    friend Dual operator/(const Dual& a, const Dual& b) {
        const double inverse = 1 / b.value;
        Dual result(a.value * inverse);
        for (std::size_t i = 0; i < N; ++i) result.partial[i] = (a.partial[i] - result.value * b.partial[i]) * inverse;
        return result;
    }
    friend Dual operator*(double a, Dual b) {
        b.value *= a;
        for (double& p : b.partial) p *= a;
        return b;
    }
    friend Dual operator*(Dual a, double b) { return b * a; }
    friend Dual operator/(Dual a, double b) { return (1 / b) * a; }
    friend Dual operator+(Dual a, double b) {
        a.value += b;
        return a;
    }
    friend Dual operator+(double a, Dual b) { return b + a; }
    friend Dual operator-(Dual a, double b) { return a + (-b); }
    friend Dual operator-(double a, Dual b) { return (-b) + a; }
};

inline double value_of(double x) {
    return x;
}
template <std::size_t N>
double value_of(const Dual<N>& x) {
    return x.value;
}

/// f(x) from f and f' at the value of x.
inline double chain(double /*x*/, double f, double /*slope*/) {
    return f;
}
template <std::size_t N>
Dual<N> chain(Dual<N> x, double f, double slope) {
    x.value = f;
    for (double& p : x.partial) p *= slope;
    return x;
}

}  // namespace endoflow::phasefield
