#pragma once

// The outer walls: straight segments cut into panels, with Gauss nodes clustered towards corners, band edges and the
// rim.

#include <vector>

#include <Eigen/Core>

#include "boundary_integral/operators/layer_target.h"
#include "shared/numerics/gauss_legendre.h"
#include "shared/parameters/parameters.h"

namespace endoflow::boundary_integral {

enum class WallKind { free, band };  // stress-free; pin band with u_z = 0 and t_r = 0
enum class Clustering { end, both_ends };

/// Straight segment from (r_begin, z_begin) to (r_end, z_end), parametrised by τ in [0, 1] so that nodes crowd at the
/// ends: the fraction of the length is sin²(π τ/2) (both ends) or sin(π τ/2) (the end). Traction ~
/// distance^(-1/2) at a band edge and velocity ~ distance^(1/2) beside it become smooth in τ.
struct WallSegment {
    double r_begin, z_begin, r_end, z_end;  // nm
    double normal_r, normal_z;              // outward
    double viscosity;                       // of the fluid inside, pN µs/nm²
    WallKind kind;
    Clustering clustering;
    int panels;

    [[nodiscard]] double length() const;
    /// n.(x - target), nm, the same for all points x.
    [[nodiscard]] double normal_offset(const Target& target) const;
    [[nodiscard]] double fraction(double tau) const;
    [[nodiscard]] double fraction_rate(double tau) const;  // d fraction / dτ
    double fraction_difference(double tau,
                               double offset) const;  // fraction(τ + offset) - fraction(τ), no cancellation
};

struct WallPanel {
    std::size_t segment;
    double tau_begin, tau_end;
    Index first_node;
};

struct WallNode {
    std::size_t segment;
    double tau;
    double weight;  // dτ weight
    double r, z;
    double speed;  // ds/dτ, nm
};

/// Where a panel comes closest to a target off the wall, for the near-singular rule.
struct PanelApproach {
    double distance;  // nm
    double length;    // of the panel, nm
    double tau;
    double width;  // of the rule, in τ
};

/// Unknown 2 i of node i is u_r; 2 i + 1 is u_z on free walls and t_z ds/dτ (pN/nm) in the band.
class WallPanels {
  public:
    /// Few long panels: with ten nodes each, 280 unknowns, forces balance to 1e-11.
    WallPanels(const DomainParameters& domain, const FluidParameters& fluid, int nodes_per_panel = 10);

    [[nodiscard]] const std::vector<WallSegment>& segments() const { return segments_; }
    [[nodiscard]] const std::vector<WallPanel>& panels() const { return panels_; }
    [[nodiscard]] const std::vector<WallNode>& nodes() const { return nodes_; }
    [[nodiscard]] const QuadratureRule& rule() const { return rule_; }
    [[nodiscard]] Index unknowns() const { return 2 * static_cast<Index>(nodes_.size()); }
    [[nodiscard]] bool is_band(const WallNode& node) const { return segments_[node.segment].kind == WallKind::band; }

    [[nodiscard]] PanelApproach approach(const WallPanel& panel, const Target& target) const;

    /// Values at τ of the Lagrange polynomials through the panel's nodes.
    [[nodiscard]] std::vector<double> lagrange(const WallPanel& panel, double tau) const;
    /// d(i, j): derivative by τ at node i of that of node j.
    [[nodiscard]] Eigen::MatrixXd lagrange_slopes(const WallPanel& panel) const;

  private:
    std::vector<WallSegment> segments_;
    std::vector<WallPanel> panels_;
    std::vector<WallNode> nodes_;
    QuadratureRule rule_;
    std::vector<double> barycentric_;
};

}  // namespace endoflow::boundary_integral
