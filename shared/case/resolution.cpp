#include "shared/case/resolution.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shared/model/time_scale.h"

namespace endoflow {

namespace {

/// Length of a flat membrane that one element resolves to 10⁻³ once it bends, and how many elements even a small
/// membrane gets for its shape. Errors go with the twelfth power of the elements.
constexpr double flat_element = 2;  // nm
constexpr double fewest_for_the_shape = 40;
constexpr double accuracy_of_these = 1e-3, order = 12;

/// With fewer of the elements that are needed, errors are ten times as large as allowed.
constexpr double fewest_part = 0.8;

/// Of boundary_integral.accuracy, whose own bound is the strictest.
constexpr double tolerance_part = 0.1, strictest = 1e-6;

/// Cells of the diffuse engine must not exceed the layer's thickness by more than this.
constexpr double largest_cells_per_epsilon = 1.5;

/// A patch beyond this part of the domain feels the wall that holds the rim.
constexpr double largest_part_of_domain = 0.8;

/// From the axis to the rim, or from pole to pole [nm].
double length_of_membrane(const DomainParameters& d) {
    if (d.kind == DomainKind::box) return d.radius;
    return std::numbers::pi * std::hypot(d.spheroid_polar_axis, d.spheroid_equatorial_axis) / std::numbers::sqrt2;
}

/// As elements_asked_for(), but without an upper bound.
double needed_elements(const Parameters& p) {
    const double shape = std::max(fewest_for_the_shape, length_of_membrane(p.domain) / flat_element);
    const double edge = p.boundary_integral.mesh_edge_length / flat_element;
    return std::ceil((shape + edge) * std::pow(accuracy_of_these / accuracy_of_elements(p), 1 / order));
}

}  // namespace

double accuracy_of_elements(const Parameters& p) {
    const double asked = p.boundary_integral.accuracy;
    return p.time.tolerance > 0 ? std::min(asked, std::max(strictest, p.time.tolerance / tolerance_part)) : asked;
}

int elements_asked_for(const Parameters& p) {
    return static_cast<int>(std::min<double>(needed_elements(p), most_elements));
}

double sharp_tolerance(const Parameters& p) {
    return time_tolerance(p, tolerance_part * p.boundary_integral.accuracy);
}

std::vector<ResolutionWarning> foreseen_inaccuracies(const Parameters& p) {
    std::vector<ResolutionWarning> warnings;
    const double needed = needed_elements(p), given = p.boundary_integral.elements;
    const std::string wanted =
        fmt::format("an accuracy of {:g} needs about {:.0f} elements", accuracy_of_elements(p), needed);
    if (given > 0 && given < fewest_part * needed)
        warnings.push_back({"boundary-integral", fmt::format("{}, not {:g}", wanted, given),
                            "set boundary_integral.elements = 0, or raise accuracy"});
    if (given == 0 && needed > most_elements)
        warnings.push_back({"boundary-integral", fmt::format("{}, more than {}", wanted, most_elements),
                            "lower domain.radius, or raise boundary_integral.accuracy"});
    if (p.domain.kind != DomainKind::box) return warnings;
    if (p.phase_field.cell_size > largest_cells_per_epsilon * p.phase_field.epsilon)
        warnings.push_back({"phase-field",
                            fmt::format("phase_field.cell_size = {:g} nm does not resolve a layer of epsilon = {:g} nm",
                                        p.phase_field.cell_size, p.phase_field.epsilon),
                            "set phase_field.cell_size = 0"});
    if (p.molecules.patch_radius > largest_part_of_domain * p.domain.radius)
        for (const char* engine : {"boundary-integral", "phase-field"})
            warnings.push_back(
                {engine,
                 fmt::format("molecules.patch_radius = {:g} nm reaches so near to the wall that the rim "
                             "takes part in what happens",
                             p.molecules.patch_radius),
                 fmt::format("raise domain.radius above {:g} nm", p.molecules.patch_radius / largest_part_of_domain)});
    return warnings;
}

}  // namespace endoflow
