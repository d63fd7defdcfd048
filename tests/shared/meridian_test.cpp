#include "shared/geometry/meridian.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "shared/geometry/wall_distance.h"
#include "shared/support/error.h"

using namespace endoflow;
using Catch::Matchers::Contains;

namespace {

/// r = 4t − t²/2 + 10 sin²t: two beads, the second one wider than the first and with a narrower neck.
class Pearls : public Meridian {
  public:
    explicit Pearls(double end) {
        for (double t = 0; t < end; t += 0.1) knots_.push_back(t);
        knots_.push_back(end);
    }
    [[nodiscard]] const std::vector<double>& knots() const override { return knots_; }
    [[nodiscard]] double radius(double t) const override { return 4 * t - 0.5 * t * t + 10 * std::pow(std::sin(t), 2); }
    [[nodiscard]] double slope(double t) const override { return 4 - t + 10 * std::sin(2 * t); }

  private:
    std::vector<double> knots_;
};

double widest(const Meridian& meridian, double end) {
    double r = 0;
    for (double t = 0; t < end; t += 1e-4) r = std::max(r, meridian.radius(t));
    return r;
}

}  // namespace

TEST_CASE("of several necks the narrowest one counts, with the widest place before it") {
    for (const double end : {4.0, 7.0}) {  // behind the first neck, behind the second one
        const Pearls pearls(end);
        const auto neck = find_neck(pearls);
        REQUIRE(neck.has_value());
        CHECK(std::abs(neck->t - end) < 1);
        CHECK(neck->t < end);
        CHECK(std::abs(pearls.slope(neck->t)) < 1e-12);
        CHECK(neck->radius == pearls.radius(neck->t));
        // Samples 1e-4 apart miss a maximum with r'' = −20 by 2.5e-8.
        CHECK(neck->lateral_diameter == Approx(2 * widest(pearls, neck->t)).margin(1e-6));
    }
    CHECK_FALSE(find_neck(Pearls(1)).has_value());  // widens all the way
    CHECK_FALSE(find_neck(Pearls(3)).has_value());  // narrows towards its end, and has no neck yet
}

TEST_CASE("the membrane's distance to the walls leaves out its rim, and an error names the wall") {
    const DomainParameters domain;  // 80 nm wide, 160 nm high, clearance of 2 nm, pinned on 5 nm
    WallDistance walls(domain);
    for (double r = 0; r <= domain.radius; r += 0.5) walls.look_at(r, domain.membrane_height, domain.radius - r);
    CHECK(walls.smallest() == 8.5);  // of four clearances
    CHECK_NOTHROW(walls.require_clearance(0));
    walls.look_at(10, domain.height - 1, 70);
    CHECK(walls.smallest() == 1);
    CHECK_THROWS_WITH(walls.require_clearance(0.5),
                      Contains("t = 0.500000 µs") && Contains("1.000000 nm from the top at r = 10.000000 nm"));

    DomainParameters long_pin = domain;
    long_pin.pin_half_width = 20;
    WallDistance pinned(long_pin);
    for (double r = 0; r <= domain.radius; r += 0.5) pinned.look_at(r, domain.membrane_height, domain.radius - r);
    CHECK(pinned.smallest() == 20.5);
}
