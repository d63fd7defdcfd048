#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "phasefield/fem/mesh.h"
#include "shared/geometry/membrane_curve.h"
#include "shared/parameters/parameters.h"

namespace endoflow::phasefield {

/// ε at a point and its gradient.
struct PointThickness {
    double value = 0;     // [nm]
    double r = 0, z = 0;  // ∂ε/∂r, ∂ε/∂z
};

/// ε₀ at the distance r from the axis [nm]: phase_field.epsilon as far as the coat and what forms of it reach, r_c + πL
/// (L: length_of_structure), half the arc of the sphere beside the coat, and at the rim, where the layer crosses the
/// pin band. Between the two, where an open membrane is flat and hardly moves, thicker by `thinning_slope` of the
/// distance to the nearer one, as far as the walls leave room. So a wide box costs few cells. Everywhere
/// phase_field.epsilon for a vesicle, a coat that grows, and a uniform layer.
double widest_layer(const Parameters& parameters, double r);

/// ε at the points of the membrane [nm]: ε₀, and where a radius of curvature ρ, along the meridian or
/// around the axis, is below ρ₀, `thinning` times L, smaller in proportion, ε₀ (1 + Σ (ρ₀/ρ)⁸)^(−1/8), and
/// so where the layer of another part of the membrane is met within `room_needed` ε₀, but nowhere below the part
/// `thinnest` of ε₀. Along the membrane it changes by at most `thinning_slope`. What a layer
/// does to a neck is of the order of (ε/ρ)².
std::vector<double> thickness_along(const MembraneCurve& curve, const Parameters& parameters);

/// ε of the layer as data: that of the membrane's closest point at the end of a step, as far as it is known before the
/// step, and the same for all time levels of the step. The energy of a layer depends on ε a little: one that lagged
/// behind a moving bend would hold it back.
struct ThicknessCurve {
    std::vector<double> r, z, epsilon;  // [nm]; empty: ε₀ everywhere

    ThicknessCurve() = default;
    /// Of a membrane that moves with its velocity for `time` [µs].
    ThicknessCurve(const MembraneCurve& curve, double time, const Parameters& parameters);

    template <class Archive>
    void serialize(Archive& archive) {
        archive("thickness_r", r);
        archive("thickness_z", z);
        archive("thickness_epsilon", epsilon);
    }

    /// At any point [nm]; only where the curve is not empty.
    [[nodiscard]] double at(double r, double z) const;
};

/// ε within the cells of this process: bilinear between their corners, so that it is nowhere beyond what it is there,
/// not even where the closest point jumps, and continuous: a jump would be a line of force, as large as the moment m.
class CellThickness {
  public:
    CellThickness(ThicknessCurve curve, const dealii::Triangulation<2>& mesh);

    /// What it was made from.
    [[nodiscard]] const ThicknessCurve& curve() const { return curve_; }

    /// At the point (x, y) of the unit cell.
    [[nodiscard]] PointThickness at(std::size_t active_cell, const CellBox& box, double x, double y) const;

  private:
    ThicknessCurve curve_;
    std::vector<std::array<double, 4>> corners_;  // [nm]; of cells of other processes 0
};

/// The layer's thickness on a mesh; nothing for an empty curve: uniform.
std::shared_ptr<const CellThickness> thickness_on(const dealii::Triangulation<2>& mesh, ThicknessCurve curve);

}  // namespace endoflow::phasefield
