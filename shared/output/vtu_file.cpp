#include "shared/output/vtu_file.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <stdexcept>

#include "shared/support/error.h"
#include "shared/support/version.h"

namespace endoflow {

namespace {

constexpr int vtk_quad = 9;

void require_good(const PointData& data, std::size_t points) {
    if (data.values.size() != points * static_cast<std::size_t>(data.components))
        throw std::logic_error(data.name + ": not one value for each point of the grid");
    for (const double value : data.values)
        if (!std::isfinite(value))
            throw SolverError("not-finite", fmt::format("the field {} is not finite", data.name),
                              "lower time.tolerance, or set output.field_interval = 0 to write no fields");
}

}  // namespace

std::string vtu_text(const QuadGrid& grid) {
    const std::size_t columns = grid.x.size(), rows = grid.y.size(), points = columns * rows;
    if (columns < 2 || rows < 2) throw std::logic_error("a grid of quadrilaterals has at least 2 x 2 points");
    const std::size_t cells = (columns - 1) * (rows - 1);
    std::string text;
    auto out = std::back_inserter(text);
    fmt::format_to(out,
                   "<?xml version=\"1.0\"?>\n<!-- {} -->\n"
                   "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
                   "<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n"
                   "<Points>\n<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n",
                   written_by(), points, cells);
    for (const double y : grid.y)
        for (const double x : grid.x) fmt::format_to(out, "{:.9g} {:.9g} 0\n", x, y);
    fmt::format_to(out,
                   "</DataArray>\n</Points>\n<Cells>\n"
                   "<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">\n");
    for (std::size_t j = 0; j + 1 < rows; ++j)
        for (std::size_t i = 0; i + 1 < columns; ++i) {
            const std::size_t corner = j * columns + i;
            fmt::format_to(out, "{} {} {} {}\n", corner, corner + 1, corner + columns + 1, corner + columns);
        }
    fmt::format_to(out, "</DataArray>\n<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">\n");
    for (std::size_t cell = 1; cell <= cells; ++cell) fmt::format_to(out, "{}\n", 4 * cell);
    fmt::format_to(out, "</DataArray>\n<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">\n");
    for (std::size_t cell = 0; cell < cells; ++cell) fmt::format_to(out, "{}\n", vtk_quad);
    fmt::format_to(out, "</DataArray>\n</Cells>\n<PointData>\n");
    for (const PointData& data : grid.data) {
        require_good(data, points);
        const auto components = static_cast<std::size_t>(data.components);
        fmt::format_to(out, "<DataArray type=\"Float64\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"ascii\">\n",
                       data.name, data.components);
        for (std::size_t i = 0; i < data.values.size(); ++i)
            fmt::format_to(out, "{:.9g}{}", data.values[i], (i + 1) % components == 0 ? '\n' : ' ');
        fmt::format_to(out, "</DataArray>\n");
    }
    fmt::format_to(out, "</PointData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
    return text;
}

}  // namespace endoflow
