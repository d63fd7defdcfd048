#define CATCH_CONFIG_RUNNER
#include <catch2/catch.hpp>

#include "phasefield/simulation.h"

int main(int argc, char** argv) {
    const endoflow::phasefield::Environment environment(argv);
    return Catch::Session().run(argc, argv);
}
