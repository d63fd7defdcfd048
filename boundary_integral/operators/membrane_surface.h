#pragma once

// How layers on the membrane are integrated: Gauss points of elements that are far from the target, a rule about its
// closest point on near ones, about itself on those that hold it.

#include <optional>
#include <vector>

#include "boundary_integral/membrane/membrane_space.h"
#include "boundary_integral/operators/surface_points.h"
#include "boundary_integral/quadrature/singular_rules.h"

namespace endoflow::boundary_integral {

struct LayerQuadrature {
    int threads = 1;
    int singular_points = 24;    // per side of the target, its own element (unless the target brings its rule)
    int near_points = 20;        // per side of the closest point, near elements
    double near_distance = 0.7;  // in element lengths; there 8 Gauss points miss 3e-11 of a logarithm
};

/// Functions of one kind on the membrane, and their rows at its Gauss points.
struct MembraneFunctions {
    const SplineSpace& splines;
    const std::vector<BasisRow>& at_gauss_points;
};

/// Of axisymmetric velocities and forces: u_r and f_r, u_z, f_z.
enum MembraneTable : std::size_t { radial_table, axial_table, force_table };
[[nodiscard]] std::vector<MembraneFunctions> membrane_functions(const MembraneSpace& space);

/// A rule on one element and the functions at its points: rows[kind of functions][point].
struct ElementPoints {
    Index element;
    OffsetRule rule;
    std::vector<std::vector<BasisRow>> rows;
};

/// The elements that hold a target of parameter ξ on the membrane. They do not change as it moves.
[[nodiscard]] std::vector<ElementPoints> own_elements(const MembraneSpace& space,
                                                      const std::vector<MembraneFunctions>& functions, double xi,
                                                      const QuadratureRule& base);

class MembraneSurface {
  public:
    /// The first two kinds of functions are those of r and z. What is passed by reference must outlive the object.
    MembraneSurface(const MembraneSpace& space, const MembraneState& state, const MembraneSamples& samples,
                    std::vector<MembraneFunctions> functions, const LayerQuadrature& quadrature);

    [[nodiscard]] const SurfacePoints& nodes() const { return nodes_; }
    [[nodiscard]] double length(Index element) const { return lengths_[at(element)]; }  // nm

    /// What to integrate an element with where its Gauss points do not serve this target.
    [[nodiscard]] std::optional<SurfacePoints> points(const LayerTarget& target, Index element) const;

    /// The rule on an element that a target off the membrane is near to; none where it is far.
    [[nodiscard]] std::optional<ElementPoints> near_points(const Target& target, Index element) const;

  private:
    const MembraneSpace& space_;
    const MembraneState& state_;
    const MembraneSamples& samples_;
    std::vector<MembraneFunctions> functions_;
    QuadratureRule singular_rule_, near_rule_;
    double near_distance_;
    SurfacePoints nodes_;
    std::vector<double> lengths_;

    template <class OffsetOf>
    [[nodiscard]] SurfacePoints shown(const ElementPoints& on, const OffsetOf& offset_of) const;
};

}  // namespace endoflow::boundary_integral
