#include "shared/support/fast_blas.h"

#include <catch2/catch.hpp>
#include <string>

using namespace endoflow;

TEST_CASE("OpenBLAS is told the processor's kernels where it does not know the processor, and only there") {
    CHECK(better_blas_kernels("Prescott", true, true) == std::string("SKYLAKEX"));
    CHECK(better_blas_kernels("Prescott", true, false) == std::string("HASWELL"));
    CHECK(better_blas_kernels("Prescott", false, false) == nullptr);
    CHECK(better_blas_kernels("Zen", true, true) == nullptr);
    CHECK(better_blas_kernels(nullptr, true, true) == nullptr);  // another library
}
