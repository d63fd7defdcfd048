#include "shared/case/resolution.h"

#include <fmt/format.h>

namespace endoflow {

namespace {

constexpr double enough_elements_per_edge_width = 1;

/// Cells of the diffuse engine must not exceed the layer's thickness by more than this.
constexpr double largest_cells_per_epsilon = 1.5;

/// A patch beyond this part of the domain feels the wall that holds the rim.
constexpr double largest_part_of_domain = 0.8;

}  // namespace

double elements_per_edge_width(const Parameters& p) {
    return p.molecules.interface_width * p.boundary_integral.elements / p.domain.radius;
}

std::vector<ResolutionWarning> foreseen_inaccuracies(const Parameters& p) {
    std::vector<ResolutionWarning> warnings;
    if (p.domain.kind != DomainKind::box) return warnings;
    if (const double elements = elements_per_edge_width(p); elements < enough_elements_per_edge_width)
        warnings.push_back(
            {"boundary-integral",
             fmt::format(
                 "{:.2g} elements across the coat's edge (molecules.interface_width = {:g} nm), fewer than {:g}",
                 elements, p.molecules.interface_width, enough_elements_per_edge_width),
             fmt::format("raise boundary_integral.elements to {:.0f}",
                         p.boundary_integral.elements * enough_elements_per_edge_width / elements)});
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
