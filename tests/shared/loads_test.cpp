// What rides on the material: the ring that bears the force on the coat.

#include "shared/model/loads.h"

#include <catch2/catch.hpp>

using namespace endoflow;

namespace {

Loads ringed(double inner, double outer) {
    Parameters p;
    p.membrane.coat_force = 30;
    p.membrane.coat_force_ring = {inner, outer};
    return loads_of(p);
}

}  // namespace

TEST_CASE("the ring bears all of the force, between its radii") {
    const Loads loads = ringed(40, 60);
    constexpr double pi = std::numbers::pi, inner = pi * 1600, outer = pi * 3600;
    CHECK(loads.ring_share(inner - 1) == 0);
    CHECK(loads.ring_share(outer + 1) == 0);
    CHECK(loads.ring_within(inner - 1) == 0);
    CHECK(loads.ring_within(outer + 1) == Approx(1).epsilon(1e-14));
    CHECK(loads.ring_within(0.5 * (inner + outer)) == Approx(0.5).epsilon(1e-14));
    // Central differences err by step²/6 times the share's second derivative, at most 30/width³: 1e-7 of 1/width.
    constexpr double step = 1, width = outer - inner;
    for (const double part : {0.1, 0.4, 0.75, 0.95}) {
        const double a = inner + part * (outer - inner);
        const auto at = Jet<1>::variable(a, 0);
        const double share = loads.ring_share(a);
        const double difference = (loads.ring_within(a + step) - loads.ring_within(a - step)) / (2 * step);
        CHECK(difference == Approx(share).margin(1e-6 / width));
        CHECK(loads.ring_within(at).partial[0] == Approx(share).epsilon(1e-14));
        CHECK(loads.ring_within(at).second[0][0] == Approx(loads.ring_share(at).partial[0]).epsilon(1e-14));
        const double slope = (loads.ring_share(a + step) - loads.ring_share(a - step)) / (2 * step);
        const double typical = share / width;
        CHECK(loads.ring_share(at).partial[0] == Approx(slope).margin(1e-5 * typical));
        const double second = (loads.ring_share(Jet<1>::variable(a + step, 0)).partial[0] -
                               loads.ring_share(Jet<1>::variable(a - step, 0)).partial[0]) /
                              (2 * step);
        CHECK(loads.ring_share(at).second[0][0] == Approx(second).margin(1e-4 * typical / width));
    }
    CHECK(loads.material_force_within(outer) == Approx(-30).epsilon(1e-14));
}

TEST_CASE("a collar that has a place presses with all of its force around it") {
    Parameters p;
    p.membrane.collar_force = 20;
    CHECK(loads_of(p).collar_waits());
    CHECK_FALSE(loads_of(p).radial());
    CHECK(loads_of(p).radial_force(1e3) == 0);
    p.membrane.collar_position = 45;
    const Loads loads = loads_of(p);
    CHECK_FALSE(loads.collar_waits());
    CHECK(loads.on_material());
    CHECK_FALSE(loads.vertical());
    // A width of 5 nm along a neck of 10 nm; the trapezoidal rule is exact to round-off for what has decayed.
    const double middle = std::numbers::pi * 45 * 45, spread = 2 * std::numbers::pi * 10 * 5;
    double force = 0, square = 0;
    for (int i = -800; i <= 800; ++i) {
        const double x = 0.01 * i * spread, share = loads.radial_force(middle + x) * 0.01 * spread;
        force += share;
        square += share * x * x;
    }
    CHECK(force == Approx(-20).epsilon(1e-12));
    CHECK(square == Approx(-20 * spread * spread).epsilon(1e-12));
    // Central differences err by step²/6 of what changes over the spread: 2e-6 of it.
    constexpr double step = 1;
    for (const double part : {-1.5, -0.4, 0.7, 2.0}) {
        const double a = middle + part * spread, typical = loads.collar_share(middle) / spread;
        const auto at = loads.collar_share(Jet<1>::variable(a, 0));
        const auto before = loads.collar_share(Jet<1>::variable(a - step, 0)),
                   after = loads.collar_share(Jet<1>::variable(a + step, 0));
        CHECK(at.partial[0] == Approx((after.value - before.value) / (2 * step)).margin(1e-5 * typical));
        CHECK(at.second[0][0] ==
              Approx((after.partial[0] - before.partial[0]) / (2 * step)).margin(1e-5 * typical / spread));
    }
}

TEST_CASE("without a ring nothing rides on the material") {
    const Loads loads = ringed(0, 0);
    CHECK_FALSE(loads.none());
    CHECK_FALSE(loads.has_ring());
    for (const double a : {0.0, 10.0, 1e5}) {
        CHECK(loads.material_force(a) == 0);
        CHECK(loads.material_force_within(a) == 0);
    }
}
