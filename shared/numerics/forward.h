#pragma once

// Forward differentiation in N variables: Dual carries first derivatives, Jet the second ones, too. What is written as
// a template on the number type runs with either of them and with double; functions of one number are given to chain().

#include <array>
#include <cmath>
#include <cstddef>

namespace endoflow {

/// A value with its N partial derivatives.
template <std::size_t N>
struct Dual {
    double value = 0;
    std::array<double, N> partial{};

    Dual() = default;
    Dual(double constant) : value(constant) {}  // NOLINT(google-explicit-constructor): constants mix with duals

    /// The variable of this index, at this value.
    [[nodiscard]] static Dual variable(double value, std::size_t index) {
        Dual result(value);
        result.partial[index] = 1;
        return result;
    }

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

/// A value with its N partial derivatives and the N × N second ones.
template <std::size_t N>
struct Jet {
    double value = 0;
    std::array<double, N> partial{};
    std::array<std::array<double, N>, N> second{};

    Jet() = default;
    Jet(double constant) : value(constant) {}  // NOLINT(google-explicit-constructor): constants mix with jets

    /// The variable of this index, at this value.
    [[nodiscard]] static Jet variable(double value, std::size_t index) {
        Jet result(value);
        result.partial[index] = 1;
        return result;
    }

    /// Adds factor × b.
    Jet& add(double factor, const Jet& b) {
        value += factor * b.value;
        for (std::size_t i = 0; i < N; ++i) {
            partial[i] += factor * b.partial[i];
            for (std::size_t j = 0; j < N; ++j) second[i][j] += factor * b.second[i][j];
        }
        return *this;
    }
    Jet& operator+=(const Jet& b) { return add(1, b); }
    friend Jet operator+(Jet a, const Jet& b) { return a += b; }
    friend Jet operator-(Jet a, const Jet& b) { return a.add(-1, b); }
    friend Jet operator-(const Jet& a) { return -1.0 * a; }
    friend Jet operator*(const Jet& a, const Jet& b) {
        Jet result(a.value * b.value);
        for (std::size_t i = 0; i < N; ++i) {
            result.partial[i] = a.value * b.partial[i] + b.value * a.partial[i];
            for (std::size_t j = 0; j < N; ++j)
                result.second[i][j] = a.value * b.second[i][j] + b.value * a.second[i][j] +
                                      a.partial[i] * b.partial[j] + a.partial[j] * b.partial[i];
        }
        return result;
    }
    friend Jet operator/(const Jet& a, const Jet& b) {
        const double inverse = 1 / b.value;
        return a * chain(b, inverse, -inverse * inverse, 2 * inverse * inverse * inverse);
    }
    friend Jet operator*(double a, const Jet& b) { return Jet().add(a, b); }
    friend Jet operator*(const Jet& a, double b) { return b * a; }
    friend Jet operator/(const Jet& a, double b) { return (1 / b) * a; }
    friend Jet operator+(Jet a, double b) {
        a.value += b;
        return a;
    }
    friend Jet operator+(double a, const Jet& b) { return b + a; }
    friend Jet operator-(const Jet& a, double b) { return a + (-b); }
    friend Jet operator-(double a, const Jet& b) { return (-b) + a; }
};

[[nodiscard]] inline double value_of(double x) {
    return x;
}
template <std::size_t N>
[[nodiscard]] double value_of(const Dual<N>& x) {
    return x.value;
}
template <std::size_t N>
[[nodiscard]] double value_of(const Jet<N>& x) {
    return x.value;
}

/// f(x) from f, f' and f'' at the value of x; f'' is used by jets alone.
[[nodiscard]] inline double chain(double /*x*/, double f, double /*first*/, double /*second*/ = 0) {
    return f;
}
template <std::size_t N>
[[nodiscard]] Dual<N> chain(Dual<N> x, double f, double first, double /*second*/ = 0) {
    x.value = f;
    for (double& p : x.partial) p *= first;
    return x;
}
template <std::size_t N>
[[nodiscard]] Jet<N> chain(const Jet<N>& x, double f, double first, double second) {
    Jet<N> y(f);
    for (std::size_t i = 0; i < N; ++i) {
        y.partial[i] = first * x.partial[i];
        for (std::size_t j = 0; j < N; ++j)
            y.second[i][j] = first * x.second[i][j] + second * x.partial[i] * x.partial[j];
    }
    return y;
}

/// √x of a dual or jet.
template <template <std::size_t> class Number, std::size_t N>
[[nodiscard]] Number<N> sqrt(const Number<N>& x) {
    const double root = std::sqrt(x.value);
    return chain(x, root, 0.5 / root, -0.25 / (root * x.value));
}

/// f(x₁ … x_M) from the jet of f in its own arguments at their values.
template <std::size_t M>
[[nodiscard]] double compose(const Jet<M>& f, const std::array<double, M>& /*x*/) {
    return f.value;
}
template <std::size_t M, std::size_t N>
[[nodiscard]] Dual<N> compose(const Jet<M>& f, const std::array<Dual<N>, M>& x) {
    Dual<N> y(f.value);
    for (std::size_t a = 0; a < M; ++a)
        for (std::size_t i = 0; i < N; ++i) y.partial[i] += f.partial[a] * x[a].partial[i];
    return y;
}
template <std::size_t M, std::size_t N>
[[nodiscard]] Jet<N> compose(const Jet<M>& f, const std::array<Jet<N>, M>& x) {
    Jet<N> y(f.value);
    std::array<std::array<double, N>, M> image{};  // second derivatives of f times the gradients of x
    for (std::size_t a = 0; a < M; ++a)
        for (std::size_t b = 0; b < M; ++b)
            for (std::size_t i = 0; i < N; ++i) image[a][i] += f.second[a][b] * x[b].partial[i];
    for (std::size_t a = 0; a < M; ++a)
        for (std::size_t i = 0; i < N; ++i) {
            y.partial[i] += f.partial[a] * x[a].partial[i];
            for (std::size_t j = 0; j < N; ++j)
                y.second[i][j] += f.partial[a] * x[a].second[i][j] + x[a].partial[i] * image[a][j];
        }
    return y;
}

/// ∂f/∂x_a as a function of x₁ … x_M.
template <std::size_t M>
[[nodiscard]] double compose_partial(const Jet<M>& f, std::size_t a, const std::array<double, M>& /*x*/) {
    return f.partial[a];
}
template <std::size_t M, std::size_t N>
[[nodiscard]] Dual<N> compose_partial(const Jet<M>& f, std::size_t a, const std::array<Dual<N>, M>& x) {
    Dual<N> y(f.partial[a]);
    for (std::size_t b = 0; b < M; ++b)
        for (std::size_t i = 0; i < N; ++i) y.partial[i] += f.second[a][b] * x[b].partial[i];
    return y;
}

}  // namespace endoflow
