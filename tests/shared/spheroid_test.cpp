// The spheroid a vesicle starts as, and the observables of closed curves.

#include "shared/geometry/spheroid.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "shared/geometry/initial_curve.h"
#include "shared/geometry/observables.h"
#include "shared/support/error.h"

using namespace endoflow;
using std::numbers::pi;

namespace {

MembraneCurve meridian(const Spheroid& spheroid, int intervals) {
    MembraneCurve curve;
    for (int i = 0; i <= intervals; ++i) {
        const double t = pi * i / intervals;
        curve.r.push_back(i == intervals ? 0 : spheroid.radius(t));
        curve.z.push_back(7 + spheroid.height(t));
        curve.kappa.push_back(spheroid.curvature(t));
    }
    curve.c.assign(curve.r.size(), 1.0);
    return curve;
}

}  // namespace

TEST_CASE("the closest point of a spheroid is where a normal starts that leads to the point") {
    for (const Spheroid& s : {Spheroid{40, 60}, Spheroid{60, 25}})
        for (const double t : {0.0, 0.4, 1.3, pi / 2, 2.6, pi})
            for (const double distance : {-5.0, 0.0, 30.0}) {  // less than the radii of curvature within
                const double n_r = s.polar * std::sin(t), n_z = s.equator * std::cos(t), n = std::hypot(n_r, n_z);
                const double r = s.radius(t) + distance * n_r / n, z = s.height(t) + distance * n_z / n;
                CAPTURE(s.equator, s.polar, t, distance);
                // The squared distance is flat at its minimum, but not its derivative: round-off alone.
                CHECK(s.closest(std::max(r, 0.0), z) == Approx(t).margin(1e-9));
            }
    // On the axis of a flat spheroid a pole is closest, on the axis of a long one, between the centres of curvature of
    // its poles, points of a parallel are.
    CHECK(Spheroid{60, 25}.closest(0, 0) == Approx(0).margin(1e-9));
    CHECK(Spheroid{40, 60}.closest(0, 10) == Approx(std::acos(10 * 60 / (60.0 * 60 - 40 * 40))).epsilon(1e-9));
}

TEST_CASE("area, volume, energy and height of a closed curve converge with order 4") {
    const Spheroid spheroid{40, 60};
    const BendingModel model{MembraneParameters{}};
    const auto coarse = measure(meridian(spheroid, 40), model), fine = measure(meridian(spheroid, 80), model);
    const auto order = [](double a, double b, double exact) {
        return std::log2(std::abs(a - exact) / std::abs(b - exact));
    };
    CHECK(order(coarse.membrane_area, fine.membrane_area, spheroid.area()) > 3.7);
    CHECK(order(coarse.extracellular_volume, fine.extracellular_volume, spheroid.volume()) > 3.7);
    CHECK(fine.membrane_area == Approx(spheroid.area()).epsilon(1e-6));
    CHECK(fine.extracellular_volume == Approx(spheroid.volume()).epsilon(1e-6));
    CHECK(fine.bud_height == Approx(120).epsilon(1e-12));
    CHECK(fine.molecule_mass == Approx(fine.membrane_area).epsilon(1e-12));
    CHECK_FALSE(fine.neck.has_value());
}

TEST_CASE("a dimple at the lower pole does not lower the height of a vesicle") {
    MembraneCurve curve = meridian({60, 20}, 200);
    for (std::size_t i = 0; i < curve.size(); ++i)  // both poles 10 nm nearer to the centre
        curve.z[i] -= 10 * std::cos(pi * static_cast<double>(i) / 200) * std::exp(-std::pow(curve.r[i] / 15, 2));
    const double highest = *std::max_element(curve.z.begin(), curve.z.end());
    // Twice the highest point's height over the centre; between samples, 1 nm apart, a parabola rises 0.01 nm more.
    CHECK(measure(curve, BendingModel{MembraneParameters{}}).bud_height == Approx(2 * (highest - 7)).margin(0.02));
    CHECK(highest - curve.z.front() > 1);
}

TEST_CASE("an inextensible sphere in a fluid is refused") {
    Parameters p;
    p.domain.kind = DomainKind::free_space;
    p.domain.spheroid_polar_axis = p.domain.spheroid_equatorial_axis = 50;
    CHECK_THROWS_AS(require_deformable(p), InputError);
    p.membrane.inextensible = false;
    CHECK_NOTHROW(require_deformable(p));
    p.membrane.inextensible = true;
    p.domain.spheroid_polar_axis = 51;
    CHECK_NOTHROW(require_deformable(p));
}
