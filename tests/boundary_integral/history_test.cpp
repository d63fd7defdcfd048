#include "boundary_integral/driver/history_recorder.h"

#include <catch2/catch.hpp>

#include "shared/output/atomic_file.h"

using namespace endoflow;
using namespace endoflow::boundary_integral;

TEST_CASE("the documentation's table of this engine's own columns is the program's", "[history]") {
    const std::string page = read_file(ENDOFLOW_DOCS "/outputs.md", 1 << 20);
    CHECK_THAT(page, Catch::Matchers::Contains(columns_as_markdown(texts_of(own_history_columns()))));
}
