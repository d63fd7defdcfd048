#pragma once

// Forward differentiation in N variables: a value with its gradient (Gradient) and also its Hessian (Jet).

#include <array>
#include <cmath>
#include <cstddef>

namespace endoflow::boundary_integral {

template <std::size_t N>
struct Jet {
    double value = 0.0;
    std::array<double, N> gradient{};
    std::array<std::array<double, N>, N> hessian{};

    static Jet constant(double v) {
        Jet jet;
        jet.value = v;
        return jet;
    }
    static Jet variable(double v, std::size_t which) {
        Jet jet = constant(v);
        jet.gradient[which] = 1.0;
        return jet;
    }
};

// f(x) from f, f', f'' at the value of x.
template <std::size_t N>
Jet<N> chain(const Jet<N>& x, double f, double first, double second) {
    Jet<N> y;
    y.value = f;
    for (std::size_t i = 0; i < N; ++i) {
        y.gradient[i] = first * x.gradient[i];
        for (std::size_t j = 0; j < N; ++j) {
            y.hessian[i][j] = first * x.hessian[i][j] + second * x.gradient[i] * x.gradient[j];
        }
    }
    return y;
}

// alpha x + beta y
template <std::size_t N>
Jet<N> combine(double alpha, const Jet<N>& x, double beta, const Jet<N>& y) {
    Jet<N> sum;
    sum.value = alpha * x.value + beta * y.value;
    for (std::size_t i = 0; i < N; ++i) {
        sum.gradient[i] = alpha * x.gradient[i] + beta * y.gradient[i];
        for (std::size_t j = 0; j < N; ++j) sum.hessian[i][j] = alpha * x.hessian[i][j] + beta * y.hessian[i][j];
    }
    return sum;
}

template <std::size_t N>
Jet<N> operator*(const Jet<N>& x, const Jet<N>& y) {
    Jet<N> product;
    product.value = x.value * y.value;
    for (std::size_t i = 0; i < N; ++i) {
        product.gradient[i] = x.value * y.gradient[i] + y.value * x.gradient[i];
        for (std::size_t j = 0; j < N; ++j) {
            product.hessian[i][j] = x.value * y.hessian[i][j] + y.value * x.hessian[i][j] +
                                    x.gradient[i] * y.gradient[j] + x.gradient[j] * y.gradient[i];
        }
    }
    return product;
}

template <std::size_t N>
struct Gradient {
    double value = 0.0;
    std::array<double, N> gradient{};

    static Gradient constant(double v) {
        Gradient result;
        result.value = v;
        return result;
    }
    static Gradient variable(double v, std::size_t which) {
        Gradient result = constant(v);
        result.gradient[which] = 1.0;
        return result;
    }
};

template <std::size_t N>
Gradient<N> chain(const Gradient<N>& x, double f, double first, double /*second*/) {
    Gradient<N> y;
    y.value = f;
    for (std::size_t i = 0; i < N; ++i) y.gradient[i] = first * x.gradient[i];
    return y;
}

template <std::size_t N>
Gradient<N> combine(double alpha, const Gradient<N>& x, double beta, const Gradient<N>& y) {
    Gradient<N> sum;
    sum.value = alpha * x.value + beta * y.value;
    for (std::size_t i = 0; i < N; ++i) sum.gradient[i] = alpha * x.gradient[i] + beta * y.gradient[i];
    return sum;
}

template <std::size_t N>
Gradient<N> operator*(const Gradient<N>& x, const Gradient<N>& y) {
    Gradient<N> product;
    product.value = x.value * y.value;
    for (std::size_t i = 0; i < N; ++i) product.gradient[i] = x.value * y.gradient[i] + y.value * x.gradient[i];
    return product;
}

// For either of the two.
template <template <std::size_t> class Type, std::size_t N>
Type<N> operator+(const Type<N>& x, const Type<N>& y) {
    return combine(1.0, x, 1.0, y);
}

template <template <std::size_t> class Type, std::size_t N>
Type<N> operator-(const Type<N>& x, const Type<N>& y) {
    return combine(1.0, x, -1.0, y);
}

template <template <std::size_t> class Type, std::size_t N>
Type<N> reciprocal(const Type<N>& x) {
    const double inverse = 1.0 / x.value;
    return chain(x, inverse, -inverse * inverse, 2.0 * inverse * inverse * inverse);
}

template <template <std::size_t> class Type, std::size_t N>
Type<N> sqrt(const Type<N>& x) {
    const double root = std::sqrt(x.value);
    return chain(x, root, 0.5 / root, -0.25 / (root * x.value));
}

}  // namespace endoflow::boundary_integral
