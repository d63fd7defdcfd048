#include "shared/output/output_size.h"

#include <fmt/format.h>

#include <cmath>

#include "shared/case/resolution.h"
#include "shared/output/output_plan.h"

namespace endoflow {

namespace {

constexpr double much = 1e9;  // bytes

/// Bytes of a shape in HDF5: eight columns of numbers, and what it costs to name them.
constexpr double bytes_per_point = 64, bytes_of_names = 21e3;

/// Points of a curve: each of the sharp engine's elements has so many, the diffuse one's are so far apart, in ε.
constexpr double points_per_element = 8, spacing_in_layers = 0.33;

/// Bytes of a file of fields: for each quadrilateral of the sharp engine's grid, and for a piece of the diffuse layer ε
/// long with its part of the mesh around, 15 cells of cubic elements (16 points, 17 numbers of 4 bytes each).
constexpr double bytes_per_quadrilateral = 78, bytes_per_layer = 2e4;

double layers(const Parameters& p) {
    return p.domain.radius / p.phase_field.epsilon;
}

double points(const Parameters& p, bool diffuse) {
    if (diffuse) return layers(p) / spacing_in_layers;
    const int given = p.boundary_integral.elements;
    return points_per_element * (given > 0 ? given : elements_asked_for(p));
}

double bytes_of_fields(const Parameters& p, bool diffuse) {
    if (diffuse) return bytes_per_layer * layers(p);
    if (p.domain.kind != DomainKind::box) return 0;
    return bytes_per_quadrilateral * p.domain.radius * p.domain.height / std::pow(p.boundary_integral.field_spacing, 2);
}

}  // namespace

OutputSize expected_output(const Parameters& p, const std::string& engine, double start) {
    const bool diffuse = engine == "phase-field";
    OutputSize size;
    if (diffuse && p.domain.kind != DomainKind::box) return size;  // which that engine does not have
    OutputPlan plan(p, start);
    plan.shapes_until(p.time.end, [&](double) { ++size.shapes; });
    if (bytes_of_fields(p, diffuse) > 0) plan.fields_until(p.time.end, [&](double) { ++size.field_files; });
    size.bytes = static_cast<double>(size.shapes) * (bytes_per_point * points(p, diffuse) + bytes_of_names) +
                 static_cast<double>(size.field_files) * bytes_of_fields(p, diffuse);
    return size;
}

std::string much_output(const Parameters& p, const std::string& engine, double start) {
    const OutputSize size = expected_output(p, engine, start);
    if (size.bytes <= much) return "";
    return fmt::format("{} will write some {:.2g} GB until {:g} µs: {} shapes, {} files of fields", engine,
                       size.bytes / much, p.time.end, size.shapes, size.field_files);
}

}  // namespace endoflow
