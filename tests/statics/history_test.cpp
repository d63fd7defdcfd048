#include <catch2/catch.hpp>

#include "shared/output/atomic_file.h"
#include "statics/simulation.h"

using namespace endoflow;

TEST_CASE("the documentation's tables of the statics' own columns are the program's", "[history]") {
    const std::string page = read_file(ENDOFLOW_DOCS "/statics.md", 1 << 20);
    Parameters parameters;
    parameters.domain.kind = GENERATE(DomainKind::box, DomainKind::free_space);
    CHECK_THAT(page, Catch::Matchers::Contains(columns_as_markdown(statics::identity(parameters).history_columns)));
}
