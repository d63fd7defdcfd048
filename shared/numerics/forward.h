#pragma once

// Forward differentiation in N variables: Dual carries first derivatives, Jet the second ones, too. What is written as
// a template on the number type runs with either of them and with double; functions of one number are given to chain().

#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>

namespace endoflow {

/// N numbers that are calculated with together, 32 bytes at a time: compilers vectorise loops this short so badly that
/// a product of jets took ten times as long.
template <std::size_t N, class Real = double>
class Row {
  public:
    [[nodiscard]] Real& operator[](std::size_t i) { return numbers_[i]; }
    [[nodiscard]] Real operator[](std::size_t i) const { return numbers_[i]; }

    /// Sets this to a x + b y.
    void combine(double a, const Row& x, double b, const Row& y) {
        const auto of_x = static_cast<Real>(a), of_y = static_cast<Real>(b);
        for (std::size_t k = 0; k < size; k += width) put(k, of_x * Chunk(x, k).numbers + of_y * Chunk(y, k).numbers);
    }
    void multiply(double a) {
        const auto by = static_cast<Real>(a);
        for (std::size_t k = 0; k < size; k += width) put(k, by * Chunk(*this, k).numbers);
    }
    /// Adds a x.
    void add(double a, const Row& x) { combine(1, *this, a, x); }
    /// Adds a x + b y.
    void add(double a, const Row& x, double b, const Row& y) {
        const auto of_x = static_cast<Real>(a), of_y = static_cast<Real>(b);
        for (std::size_t k = 0; k < size; k += width)
            put(k, Chunk(*this, k).numbers + of_x * Chunk(x, k).numbers + of_y * Chunk(y, k).numbers);
    }

  private:
    static constexpr std::size_t at_once = 32 / sizeof(Real), width = N > at_once ? at_once : 1,
                                 size = (N + width - 1) / width * width;
    struct Chunk {  // a class, for functions that return vectors differ from one instruction set to the next
        [[gnu::vector_size(width * sizeof(Real))]] Real numbers;
        Chunk(const Row& row, std::size_t k) { std::memcpy(&numbers, &row.numbers_[k], sizeof numbers); }
    };
    template <class Numbers>
    void put(std::size_t k, const Numbers& numbers) {
        std::memcpy(&numbers_[k], &numbers, sizeof numbers);
    }

    std::array<Real, size> numbers_{};
};

/// A value with its N partial derivatives, of a precision of their own.
template <std::size_t N, class Partial = double>
struct Dual {
    double value = 0;
    Row<N, Partial> partial;

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
        partial.add(1, b.partial);
        return *this;
    }
    friend Dual operator+(Dual a, const Dual& b) { return a += b; }
    friend Dual operator-(Dual a, const Dual& b) {
        a.value -= b.value;
        a.partial.add(-1, b.partial);
        return a;
    }
    friend Dual operator-(const Dual& a) { return -1.0 * a; }
    friend Dual operator*(const Dual& a, const Dual& b) {
        Dual result(a.value * b.value);
        result.partial.combine(b.value, a.partial, a.value, b.partial);
        return result;
    }
    friend Dual operator/(const Dual& a, const Dual& b) {
        const double inverse = 1 / b.value;
        Dual result(a.value * inverse);
        result.partial.combine(inverse, a.partial, -result.value * inverse, b.partial);
        return result;
    }
    friend Dual operator*(double a, Dual b) {
        b.value *= a;
        b.partial.multiply(a);
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
    Row<N> partial;
    std::array<Row<N>, N> second;

    Jet() = default;
    Jet(double constant) : value(constant) {}  // NOLINT(google-explicit-constructor): constants mix with jets

    /// The variable of this index, at this value.
    [[nodiscard]] static Jet variable(double value, std::size_t index) {
        Jet result(value);
        result.partial[index] = 1;
        return result;
    }
    /// a x + b y
    [[nodiscard]] static Jet combination(double a, const Jet& x, double b, const Jet& y) {
        Jet result(a * x.value + b * y.value);
        result.partial.combine(a, x.partial, b, y.partial);
        for (std::size_t i = 0; i < N; ++i) result.second[i].combine(a, x.second[i], b, y.second[i]);
        return result;
    }

    Jet& operator+=(const Jet& b) {
        value += b.value;
        partial.add(1, b.partial);
        for (std::size_t i = 0; i < N; ++i) second[i].add(1, b.second[i]);
        return *this;
    }
    friend Jet operator+(const Jet& a, const Jet& b) { return combination(1, a, 1, b); }
    friend Jet operator-(const Jet& a, const Jet& b) { return combination(1, a, -1, b); }
    friend Jet operator-(const Jet& a) { return -1.0 * a; }
    friend Jet operator*(const Jet& a, const Jet& b) {
        Jet result(a.value * b.value);
        result.partial.combine(a.value, b.partial, b.value, a.partial);
        for (std::size_t i = 0; i < N; ++i) {
            result.second[i].combine(a.value, b.second[i], b.value, a.second[i]);
            result.second[i].add(a.partial[i], b.partial, b.partial[i], a.partial);
        }
        return result;
    }
    friend Jet operator/(const Jet& a, const Jet& b) {
        const double inverse = 1 / b.value;
        return a * chain(b, inverse, -inverse * inverse, 2 * inverse * inverse * inverse);
    }
    friend Jet operator*(double a, const Jet& b) {
        Jet result(a * b.value);
        result.partial.add(a, b.partial);
        for (std::size_t i = 0; i < N; ++i) result.second[i].add(a, b.second[i]);
        return result;
    }
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
template <std::size_t N, class Partial>
[[nodiscard]] double value_of(const Dual<N, Partial>& x) {
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
template <std::size_t N, class Partial>
[[nodiscard]] Dual<N, Partial> chain(Dual<N, Partial> x, double f, double first, double /*second*/ = 0) {
    x.value = f;
    x.partial.multiply(first);
    return x;
}
template <std::size_t N>
[[nodiscard]] Jet<N> chain(const Jet<N>& x, double f, double first, double second) {
    Jet<N> y(f);
    y.partial.add(first, x.partial);
    for (std::size_t i = 0; i < N; ++i) y.second[i].combine(first, x.second[i], second * x.partial[i], x.partial);
    return y;
}

/// √x of a dual or jet.
template <class Number>
requires requires(const Number& x) {
    x.partial;
}
[[nodiscard]] Number sqrt(const Number& x) {
    const double root = std::sqrt(x.value);
    return chain(x, root, 0.5 / root, -0.25 / (root * x.value));
}

/// f(x₁ … x_M) from the jet of f in its own arguments at their values.
template <std::size_t M>
[[nodiscard]] double compose(const Jet<M>& f, const std::array<double, M>& /*x*/) {
    return f.value;
}
template <std::size_t M, std::size_t N, class Partial>
[[nodiscard]] Dual<N, Partial> compose(const Jet<M>& f, const std::array<Dual<N, Partial>, M>& x) {
    Dual<N, Partial> y(f.value);
    for (std::size_t a = 0; a < M; ++a) y.partial.add(f.partial[a], x[a].partial);
    return y;
}
template <std::size_t M, std::size_t N>
[[nodiscard]] Jet<N> compose(const Jet<M>& f, const std::array<Jet<N>, M>& x) {
    Jet<N> y(f.value);
    for (std::size_t a = 0; a < M; ++a) {
        Row<N> image;  // second derivatives of f times the gradients of x
        for (std::size_t b = 0; b < M; ++b) image.add(f.second[a][b], x[b].partial);
        y.partial.add(f.partial[a], x[a].partial);
        for (std::size_t i = 0; i < N; ++i) {
            y.second[i].add(f.partial[a], x[a].second[i], x[a].partial[i], image);
        }
    }
    return y;
}

/// ∂f/∂x_a as a function of x₁ … x_M.
template <std::size_t M>
[[nodiscard]] double compose_partial(const Jet<M>& f, std::size_t a, const std::array<double, M>& /*x*/) {
    return f.partial[a];
}
template <std::size_t M>
[[nodiscard]] double compose_partial(const Dual<M>& f, std::size_t a, const std::array<double, M>& /*x*/) {
    return f.partial[a];
}
template <std::size_t M, std::size_t N, class Partial>
[[nodiscard]] Dual<N, Partial> compose_partial(const Jet<M>& f, std::size_t a,
                                               const std::array<Dual<N, Partial>, M>& x) {
    Dual<N, Partial> y(f.partial[a]);
    for (std::size_t b = 0; b < M; ++b) y.partial.add(f.second[a][b], x[b].partial);
    return y;
}

}  // namespace endoflow
