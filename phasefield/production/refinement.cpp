#include "phasefield/production/refinement.h"

#include <algorithm>
#include <cmath>

#include "phasefield/contour/contour.h"

namespace endoflow::phasefield::production {

namespace {

constexpr double edge_cells = 0.75;           // largest cell at the patch's edge, in units of its width
constexpr double edge_part = 0.47;            // |c − ½| below this is the edge: in the bud 1 − c comes to 0.016
constexpr double fine_band = 3;               // half-width of the finer cells, in units of ε
constexpr double neck_cells = 0.25;           // largest cell where the membrane is narrow, in units of its radius there
constexpr unsigned int most_neck_levels = 2;  // with cells of 4/3 ε: necks below 1.4 ε have left the model anyway

/// Points where the membrane's radius of curvature around the axis is below `radius` [nm].
std::vector<PlanePoint> narrow_part(const MembraneCurve& curve, double radius) {
    std::vector<PlanePoint> out;
    for (std::size_t i = 0; i + 1 < curve.size(); ++i) {
        const double dr = curve.r[i + 1] - curve.r[i], dz = curve.z[i + 1] - curve.z[i];
        const PlanePoint middle{curve.r[i] + 0.5 * dr, curve.z[i] + 0.5 * dz};
        if (middle.r * std::hypot(dr, dz) < radius * std::abs(dz)) out.push_back(middle);
    }
    return out;
}

std::vector<PlanePoint> patch_edge(const MembraneCurve& curve) {
    std::vector<PlanePoint> out;
    for (std::size_t i = 0; i < curve.size(); ++i)
        if (std::abs(curve.c[i] - 0.5) < edge_part) out.push_back({curve.r[i], curve.z[i]});
    return out;
}

}  // namespace

std::vector<RefinedBand> refined_bands(const MembraneCurve& curve, const Parameters& parameters) {
    const auto& p = parameters.phase_field;
    const auto layer_level = static_cast<unsigned int>(p.far_refinements);
    const double band = p.band_width * p.epsilon, inner = fine_band * p.epsilon, outer = inner + p.cell_size;
    std::vector<RefinedBand> out{{positions(curve), layer_level, band, band + 2 * p.cell_size}};
    const double wanted = edge_cells * parameters.molecules.interface_width;
    const auto edge_levels = static_cast<unsigned int>(std::max(0.0, std::ceil(std::log2(p.cell_size / wanted))));
    if (edge_levels > 0) out.push_back({patch_edge(curve), layer_level + edge_levels, inner, outer});
    for (unsigned int level = 0; level < most_neck_levels; ++level) {
        auto neck = narrow_part(curve, p.cell_size / (1U << level) / neck_cells);
        if (!neck.empty()) out.push_back({std::move(neck), layer_level + level + 1, inner, outer});
    }
    return out;
}

}  // namespace endoflow::phasefield::production
