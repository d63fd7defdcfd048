// How a coat's preferred curvature ages.

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "shared/model/maturation.h"
#include "shared/model/membrane_energy.h"
#include "shared/support/error.h"

using namespace endoflow;

namespace {

MoleculeParameters maturing(Maturation law, double rate, double start) {
    MoleculeParameters m;
    m.maturation = law;
    m.maturation_rate = rate;
    m.maturation_start = start;
    return m;
}

}  // namespace

TEST_CASE("maturity solves its equation, from its start to one") {
    for (const Maturation law : {Maturation::exponential, Maturation::cooperative})
        for (const double start : {0.0, 0.3, 1.0}) {
            const MaturationLaw maturation(maturing(law, 0.7, start));
            CHECK(maturation.maturity(0) == Approx(start).margin(1e-15));
            CHECK(maturation.maturity(std::numeric_limits<double>::infinity()) == 1);
            for (const double time : {0.0, 0.4, 1.3, 4.0}) {
                const double chi = maturation.maturity(time), step = 1e-4;
                const double power = law == Maturation::cooperative ? chi * chi : chi;
                CHECK(maturation.rate(time) == Approx(0.7 * (1 - power)).epsilon(1e-14).margin(1e-15));
                // The central difference errs by step²/6 times a third derivative below one.
                const double slope = (maturation.maturity(time + step) - maturation.maturity(time - step)) / (2 * step);
                CHECK(slope == Approx(maturation.rate(time)).margin(1e-8));
            }
        }
}

TEST_CASE("without maturation the curvature is the law's at all times, with it in proportion") {
    Parameters p;
    const auto spontaneous = [&p](double time) { return bending_model(p, time).spontaneous_curvature(0.6).value; };
    const double mature = spontaneous(0);
    CHECK(spontaneous(1e9) == mature);
    CHECK(MaturationLaw(p.molecules).rate(3) == 0);
    p.molecules = maturing(Maturation::cooperative, 2, 0.1);
    CHECK(spontaneous(0.2) == Approx(mature * std::tanh(0.4 + std::atanh(0.1))).epsilon(1e-14));
    CHECK(bending_model(p, 0.2).stiffness(0.6).value == bending_model(p, 0).stiffness(0.6).value);
    // e = ½ β (κ − χC)²: its moment vanishes where κ = χC.
    const double chi_C = spontaneous(0.2);
    CHECK(std::abs(membrane_energy(p, 0.2).density(chi_C, 0.6, 0).partial[local::curvature]) < 1e-13);
}

TEST_CASE("an engine without maturation says so") {
    Parameters p;
    CHECK_NOTHROW(require_no_maturation(p, "statics engine"));
    p.molecules = maturing(Maturation::exponential, 1, 0);
    CHECK_THROWS_WITH(require_no_maturation(p, "scheme paper"), Catch::Contains("scheme paper"));
}
