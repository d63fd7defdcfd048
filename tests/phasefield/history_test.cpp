#include "phasefield/driver/history.h"
#include "shared/output/checkpoint_archive.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "shared/output/atomic_file.h"

using namespace endoflow;
using namespace endoflow::phasefield;

TEST_CASE("the documentation's table of this engine's own columns is the program's", "[history]") {
    const std::string page = read_file(ENDOFLOW_DOCS "/outputs.md", 1 << 20);
    CHECK_THAT(page, Catch::Matchers::Contains(columns_as_markdown(texts_of(own_history_columns()))));
}

TEST_CASE("what has come is the integral of the rates", "[history]") {
    // Cubics are integrated exactly once four rates are known; here they are known from the start: 1 + 2t − t² + 4t³.
    const auto mass = [](double t) { return 100 + t + t * t - t * t * t / 3 + t * t * t * t; };
    const auto rate = [](double t) { return 1 + 2 * t - t * t + 4 * t * t * t; };
    const auto came = [&](double first, double last) {
        MoleculeBalance balance;
        balance.start(100, rate(0));
        for (const double t : {0.25 * first, 0.5 * first, first, last}) balance.advance(t, rate(t), 0);
        return balance;
    };
    // Of the first two steps the errors of lower order are 2e-11; shorter ones would amplify the rates' round-off.
    CHECK(came(2e-3, 0.7).exchanged() == Approx(mass(0.7) - 100).epsilon(1e-9));
    CHECK(came(2e-3, 0.7).residual(mass(0.7)) < 1e-10);
    CHECK(came(2e-3, 0.7).residual(mass(0.7) + 1) == Approx(0.01).epsilon(1e-6));

    Checkpoint checkpoint;
    MoleculeBalance continued, whole = came(2e-3, 0.7);
    whole.serialize(CheckpointWriter(checkpoint));
    continued.serialize(CheckpointReader(checkpoint));
    whole.advance(0.9, rate(0.9), 1e-3);
    continued.advance(0.9, rate(0.9), 1e-3);
    CHECK(continued.exchanged() == whole.exchanged());
    CHECK(continued.residual(mass(0.9)) == whole.residual(mass(0.9)));
    CHECK(whole.residual(mass(0.9)) == Approx(1e-5).epsilon(1e-3));  // 1e-3 of 100 were put right
}
