// The list of field files and the text of one.

#include <catch2/catch.hpp>
#include <limits>

#include "shared/output/atomic_file.h"
#include "shared/output/field_index.h"
#include "shared/output/vtu_file.h"
#include "shared/support/error.h"
#include "temporary_directory.h"

namespace {

using namespace endoflow;

QuadGrid small_grid() {
    return {{0, 1, 2}, {0, 0.5}, {{"velocity", 3, std::vector<double>(18, 0.25)}, {"pressure", 1, {1, 2, 3, 4, 5, 6}}}};
}

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
}

}  // namespace

TEST_CASE("a field file holds the grid's points, quadrilaterals and values", "[fields]") {
    const std::string text = vtu_text(small_grid());
    CHECK(count(text, "NumberOfPoints=\"6\" NumberOfCells=\"2\"") == 1);
    CHECK(count(text, "\n0 1 4 3\n1 2 5 4\n") == 1);  // counter-clockwise
    CHECK(count(text, "\n2 0.5 0\n") == 1);
    CHECK(count(text, "Name=\"velocity\" NumberOfComponents=\"3\"") == 1);
    CHECK(count(text, "0.25 0.25 0.25\n") == 6);
    CHECK(count(text, "\n1\n2\n3\n4\n5\n6\n</DataArray>") == 1);
    QuadGrid broken = small_grid();
    broken.data[1].values[3] = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS(vtu_text(broken), SolverError);
}

TEST_CASE("fields are listed with their times, and a restart drops the later ones", "[fields]") {
    const TemporaryDirectory scratch;
    const RunDirectory directory{scratch.path()};
    {
        FieldIndex index(directory);
        CHECK(!index.latest());
        for (const double time : {0.0, 0.1, 0.30000000000000004}) index.add(time, vtu_text(small_grid()));
        CHECK(index.latest() == 0.30000000000000004);
    }
    CHECK(read_file(directory.fields() / "fields_000002.vtu", 1 << 20) == vtu_text(small_grid()));
    CHECK(FieldIndex(directory, 0.30000000000000004).latest() == 0.30000000000000004);
    FieldIndex index(directory, 0.2);
    CHECK(index.latest() == 0.1);
    index.add(0.2, "new");
    const std::string list = read_file(directory.field_index(), 1 << 20);
    CHECK(count(list, "<DataSet") == 3);
    CHECK(count(list, "timestep=\"0.2\" group=\"\" part=\"0\" file=\"fields/fields_000002.vtu\"") == 1);
    CHECK(read_file(directory.fields() / "fields_000002.vtu", 1 << 20) == "new");
    CHECK(!FieldIndex({scratch.path() / "nothing"}, 1.0).latest());
}
