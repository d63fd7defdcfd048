#pragma once

#include <array>
#include <cmath>

namespace endoflow::statics {

/// A number that carries its partial derivatives with respect to N variables: forward automatic differentiation.
template <std::size_t N>
struct Dual {
    double value = 0;
    std::array<double, N> partial{};

    Dual() = default;
    Dual(double constant) : value(constant) {}  // NOLINT(google-explicit-constructor): constants mix with duals

    /// The variable of this index, at this value.
    static Dual variable(double value, std::size_t index) {
        Dual result(value);
        result.partial[index] = 1;
        return result;
    }

    /// f(x) when f(x.value) and f'(x.value) are known.
    static Dual chain(double f, double slope, const Dual& x) {
        Dual result(f);
        for (std::size_t i = 0; i < N; ++i) result.partial[i] = slope * x.partial[i];
        return result;
    }

    friend Dual operator+(Dual a, const Dual& b) {
        a.value += b.value;
        for (std::size_t i = 0; i < N; ++i) a.partial[i] += b.partial[i];
        return a;
    }
    friend Dual operator-(Dual a, const Dual& b) {
        a.value -= b.value;
        for (std::size_t i = 0; i < N; ++i) a.partial[i] -= b.partial[i];
        return a;
    }
    friend Dual operator-(const Dual& a) { return Dual(0.0) - a; }
    friend Dual operator*(const Dual& a, const Dual& b) {
        Dual result(a.value * b.value);
        for (std::size_t i = 0; i < N; ++i) result.partial[i] = a.partial[i] * b.value + a.value * b.partial[i];
        return result;
    }
    friend Dual operator/(const Dual& a, const Dual& b) {
        Dual result(a.value / b.value);
        for (std::size_t i = 0; i < N; ++i) result.partial[i] = (a.partial[i] - result.value * b.partial[i]) / b.value;
        return result;
    }
};

}  // namespace endoflow::statics
