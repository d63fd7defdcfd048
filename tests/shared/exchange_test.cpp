// Molecules that come onto the membrane and leave it.

#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "shared/model/exchange.h"
#include "shared/model/loads.h"
#include "shared/support/error.h"

using namespace endoflow;

namespace {

MoleculeParameters reservoir() {
    MoleculeParameters m;
    m.exchange = Exchange::reservoir;
    m.on_rate = 0.3;
    m.off_rate = 0.2;
    return m;
}

MoleculeParameters edge() {
    MoleculeParameters m;
    m.exchange = Exchange::edge;
    m.edge_speed = 0.01;
    return m;
}

/// A law that the program does not have: molecules bring others, and bent membrane keeps them.
struct CooperativeExchange {
    double speed;  // 1/µs

    template <class Number>
    [[nodiscard]] Number rate(const ExchangePoint<Number>& x) const {
        const Number& c = x.concentration;
        return speed * (c * c * (1.0 - c) - 1e-4 * (x.by_concentration * x.mass * c));
    }
};

}  // namespace

TEST_CASE("the reservoir's equilibrium is Langmuir's, and bending's energy shifts it by Boltzmann's factor") {
    MoleculeParameters m = reservoir();
    CHECK(exchange_law(m).rate(0.0, 0.0, 0.0) == Approx(0.3));
    CHECK(exchange_law(m).rate(1.0, 0.0, 0.0) == Approx(-0.2));
    CHECK(std::abs(exchange_law(m).rate(0.6, 17.0, 1e5)) < 1e-16);  // k_on/(k_on + k_off), whatever does not count
    m.curvature_sensing = 1;
    m.molecule_area = 2;
    const double exponent = 2 * 1.7 / 4.11, equilibrium = 0.3 / (0.3 + 0.2 * std::exp(exponent));
    CHECK(detachment_exponent(m, 1.7) == Approx(exponent));
    CHECK(std::abs(exchange_law(m).rate(equilibrium, 1.7, 0.0)) < 1e-16);
}

TEST_CASE("edge growth is the speed times the slope of the equilibrium profile, and makes nothing from nothing") {
    const MoleculeParameters m = edge();
    for (const double x : {-3.0, -0.4, 0.0, 1.7}) {
        const double t = std::tanh(x / (std::sqrt(2.0) * m.interface_width)), c = 0.5 * (1 - t);
        const double slope = -0.5 * (1 - t * t) / (std::sqrt(2.0) * m.interface_width);
        CHECK(exchange_law(m).rate(c, 0.0, 0.0) == Approx(-0.01 * slope).epsilon(1e-12));
    }
    CHECK(exchange_law(m).rate(0.0, 0.0, 0.0) == 0);
    CHECK(exchange_law(m).rate(-1e-3, 0.0, 0.0) == 0);
    CHECK(exchange_law(m).rate(1.01, 0.0, 0.0) < 0);
}

TEST_CASE("attachment slows down as the pool is used up, detachment does not") {
    MoleculeParameters m = reservoir();
    m.pool_area = 4000;
    CHECK(exchange_law(m).rate(0.0, 0.0, 1000.0) == Approx(0.75 * 0.3));
    CHECK(exchange_law(m).rate(1.0, 0.0, 4000.0) == Approx(-0.2));
    MoleculeParameters n = edge();
    n.pool_area = 4000;
    CHECK(exchange_law(n).rate(0.5, 0.0, 1000.0) == Approx(0.75 * exchange_law(edge()).rate(0.5, 0.0, 0.0)));
}

TEST_CASE("attachment slows down as the bulk is depleted, detachment does not") {
    const ExchangeLaw law = exchange_law(reservoir()), growth = exchange_law(edge());
    CHECK(law.rate(0.0, 0.0, 0.0, 0.25) == Approx(0.25 * 0.3));
    CHECK(law.rate(1.0, 0.0, 0.0, 0.25) == Approx(-0.2));
    CHECK(growth.rate(0.5, 0.0, 0.0, 0.25) == Approx(0.25 * growth.rate(0.5, 0.0, 0.0)));
}

TEST_CASE("an exchange rate's derivatives are those of its value") {
    MoleculeParameters m = reservoir(), n = edge();
    m.pool_area = n.pool_area = 5000;
    m.curvature_sensing = 0.7, m.molecule_area = 3;
    const ExchangeLaw law =
        GENERATE_COPY(values({exchange_law(m), exchange_law(n), ExchangeLaw(CooperativeExchange{0.4})}));
    using D = Dual<4>;
    const std::array<double, 4> at{0.37, 1.2, 2100, 0.6};
    const auto rate = [&law](const auto& x) { return law.rate(x[0], x[1], x[2], x[3]); };
    std::array<D, 4> variables;
    for (std::size_t i = 0; i < at.size(); ++i) variables[i] = D::variable(at[i], i);
    const D exact = rate(variables);
    CHECK(exact.value == Approx(rate(at)).epsilon(1e-15));
    for (std::size_t i = 0; i < at.size(); ++i) {
        std::array<double, 4> up = at, down = at;
        const double step = 1e-5 * at[i];  // central differences: relative errors of 1e-10
        up[i] += step, down[i] -= step;
        CHECK(exact.partial[i] == Approx((rate(up) - rate(down)) / (2 * step)).epsilon(1e-8).margin(1e-14));
    }
}

TEST_CASE("an engine without a bulk refuses it by its name") {
    Parameters parameters;
    CHECK_NOTHROW(require_no_bulk(parameters, "boundary-integral"));
    parameters.molecules.bulk = Bulk::intracellular;
    CHECK_THROWS_WITH(require_no_bulk(parameters, "boundary-integral"), Catch::Contains("boundary-integral engine"));
}

TEST_CASE("an engine without exchange refuses it by its name") {
    Parameters parameters;
    CHECK_NOTHROW(require_no_exchange(parameters, "statics"));
    CHECK(exchange_law(parameters.molecules).none());
    CHECK(exchange_law(parameters.molecules).rate(0.5, 1.0, 1.0) == 0);
    parameters.molecules = edge();
    CHECK_THROWS_WITH(require_no_exchange(parameters, "statics"), Catch::Contains("statics engine"));
    CHECK_THROWS_AS(require_no_loads(parameters, "phase-field"), InputError);
}
