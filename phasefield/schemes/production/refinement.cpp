#include "phasefield/schemes/production/refinement.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "phasefield/contour/layer_thickness.h"
#include "phasefield/fem/flow_domain.h"
#include "phasefield/layer/constants.h"
#include "phasefield/schemes/production/step_control.h"

namespace endoflow::phasefield::production {

namespace {

constexpr double edge_cells = constant("edge_cells");
constexpr double edge_part = constant("edge_part");
constexpr double fine_band = constant("fine_band");
constexpr double pin_cells = constant("pin_cells");
constexpr double neck_cells = constant("neck_cells");
constexpr double motion_without_flow = constant("motion_without_flow");
constexpr double cells_slack = constant("cells_slack");
constexpr int most_neck_levels = count("most_neck_levels");

using Indices = std::vector<std::size_t>;

/// Points of the curve, where the layer has this thickness [nm], and where they will be when the mesh follows again:
/// the one that moves most layers of its own is `motion` of a layer `widest` away [nm].
class Path {
  public:
    Path(const MembraneCurve& curve, const std::vector<double>& thickness, double widest, double motion)
        : curve_(&curve), thickness_(&thickness), ahead_(curve.size()) {
        if (curve.u_r.size() != curve.size()) return;  // at rest
        double fastest = 0;
        for (std::size_t i = 0; i < curve.size(); ++i) {
            const std::size_t before = i > 0 ? i - 1 : i, after = i + 1 < curve.size() ? i + 1 : i;
            const double dr = curve.r[after] - curve.r[before], dz = curve.z[after] - curve.z[before];
            const double speed = (curve.u_z[i] * dr - curve.u_r[i] * dz) / (dr * dr + dz * dz);
            ahead_[i] = {-speed * dz, speed * dr};  // the velocity's part across the membrane
            fastest = std::max(fastest, std::hypot(ahead_[i].r, ahead_[i].z) * widest / thickness[i]);
        }
        const double time = fastest > 0 ? motion / fastest : 0;
        for (auto& step : ahead_) step = {step.r * time, step.z * time};
    }

    /// All within `layers` of its own thickness of these points.
    [[nodiscard]] std::vector<RefinedBand::Point> around(const Indices& indices, double layers) const {
        std::vector<RefinedBand::Point> out;
        for (const std::size_t i : indices) {
            const double reach = layers * (*thickness_)[i];
            out.push_back({{curve_->r[i], curve_->z[i]}, reach});
            out.push_back({{curve_->r[i] + ahead_[i].r, curve_->z[i] + ahead_[i].z}, reach});
        }
        return out;
    }

  private:
    const MembraneCurve* curve_;
    const std::vector<double>* thickness_;
    std::vector<PlanePoint> ahead_;
};

Indices whole(const MembraneCurve& curve) {
    Indices out(curve.size());
    std::iota(out.begin(), out.end(), std::size_t{0});
    return out;
}

/// Where the membrane's radius of curvature around the axis is below `radius` [nm].
Indices narrow_part(const MembraneCurve& curve, double radius) {
    Indices out;
    for (std::size_t i = 0; i + 1 < curve.size(); ++i) {
        const double dr = curve.r[i + 1] - curve.r[i], dz = curve.z[i + 1] - curve.z[i];
        if ((curve.r[i] + 0.5 * dr) * std::hypot(dr, dz) < radius * std::abs(dz)) out.push_back(i);
    }
    return out;
}

/// Where the layer is thinner than `epsilon` [nm].
Indices thin_part(const std::vector<double>& thickness, double epsilon) {
    Indices out;
    for (std::size_t i = 0; i < thickness.size(); ++i)
        if (thickness[i] < epsilon) out.push_back(i);
    return out;
}

/// The ends of the pin band on the side wall, where the fluid's stress is singular.
std::vector<RefinedBand::Point> pin_ends(const DomainParameters& box, double reach) {
    return {{{box.radius, box.membrane_height - box.pin_half_width}, reach},
            {{box.radius, box.membrane_height + box.pin_half_width}, reach}};
}

Indices patch_edge(const MembraneCurve& curve) {
    Indices out;
    for (std::size_t i = 0; i < curve.size(); ++i)
        if (std::abs(curve.c[i] - 0.5) < edge_part) out.push_back(i);
    return out;
}

}  // namespace

double edge_motion(const MembraneCurve& before, const MembraneCurve& after) {
    const auto edge = [](const MembraneCurve& curve) -> std::optional<PlanePoint> {
        for (std::size_t i = curve.size(); i > 1; --i) {
            const double outer = curve.c[i - 1] - 0.5, inner = curve.c[i - 2] - 0.5;
            if (outer < 0 && inner >= 0) {
                const double t = inner / (inner - outer);
                return PlanePoint{curve.r[i - 2] + t * (curve.r[i - 1] - curve.r[i - 2]),
                                  curve.z[i - 2] + t * (curve.z[i - 1] - curve.z[i - 2])};
            }
        }
        return {};
    };
    const auto from = edge(before), to = edge(after);
    return from && to ? std::hypot(to->r - from->r, to->z - from->z) : 0;
}

double follow_after_motion(const Parameters& p) {
    return (p.fluid.dynamics == Dynamics::flow ? largest_motion : motion_without_flow) * p.phase_field.epsilon;
}

std::vector<RefinedBand> refined_bands(const MembraneCurve& curve, const Parameters& parameters) {
    const auto& p = parameters.phase_field;
    const auto level_of_layer = static_cast<int>(layer_level(parameters));
    const auto thickness = thickness_along(curve, parameters);
    const Path path(curve, thickness, p.epsilon, follow_after_motion(parameters));
    std::vector<RefinedBand> out;
    const auto add_points = [&](const std::vector<RefinedBand::Point>& points, int halvings) {
        out.push_back(
            {points, static_cast<unsigned int>(level_of_layer + halvings), std::ldexp(p.cell_size, -halvings)});
    };
    const auto add = [&](const Indices& part, double layers, int halvings) {
        add_points(path.around(part, layers), halvings);
    };
    const auto halvings_to = [&](double size) {
        return static_cast<int>(std::max(0.0, std::ceil(std::log2(p.cell_size / size))));
    };
    const int edge_levels = halvings_to(edge_cells * parameters.molecules.interface_width);
    if (edge_levels > 0) add(patch_edge(curve), fine_band, edge_levels);
    if (parameters.domain.kind == DomainKind::box && parameters.fluid.dynamics == Dynamics::flow) {
        const int pin_levels = halvings_to(pin_cells * parameters.domain.pin_half_width);
        add_points(pin_ends(parameters.domain, 1e-3 * std::ldexp(p.cell_size, -pin_levels)), pin_levels);
    }
    const double widest = *std::ranges::max_element(thickness);
    int halvings = -std::min(level_of_layer, static_cast<int>(std::log2(cells_slack * widest / p.epsilon)));
    for (Indices part = whole(curve); !part.empty();
         part = thin_part(thickness, std::ldexp(p.epsilon / cells_slack, 1 - halvings)))
        add(part, p.band_width > 0 ? p.band_width : fine_band, halvings++);
    for (int k = 1; k <= most_neck_levels; ++k) {
        const Indices neck = narrow_part(curve, p.cell_size / (1U << (k - 1)) / neck_cells);
        if (!neck.empty()) add(neck, fine_band, k);
    }
    return out;
}

}  // namespace endoflow::phasefield::production
