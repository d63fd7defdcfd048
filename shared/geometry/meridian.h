#pragma once

#include <optional>
#include <vector>

namespace endoflow {

/// How a function of the meridian's parameter continues through the axis: heights and concentrations are even, radii
/// odd.
enum class Parity { even, odd };

/// A membrane's meridian r(t) from the axis to the rim, in whatever representation an engine has it, as those see it
/// who measure it. Lengths in nm; the parameter t is the engine's own.
class Meridian {
  public:
    Meridian() = default;
    Meridian(const Meridian&) = delete;
    Meridian& operator=(const Meridian&) = delete;
    virtual ~Meridian() = default;

    /// Parameters from axis to rim, so close that r' changes its sign between two of them at most once.
    [[nodiscard]] virtual const std::vector<double>& knots() const = 0;
    [[nodiscard]] virtual double radius(double t) const = 0;
    /// r'(t).
    [[nodiscard]] virtual double slope(double t) const = 0;
};

/// The neck is the narrowest place between the bud's widest place and the rim.
struct Neck {
    double radius;            // nm
    double lateral_diameter;  // of the bud above it: twice the largest r between axis and neck, nm
    double t;                 // where it is on the meridian
};

/// Budding is the event that the neck radius falls below this, nm (Sec. 4.4).
inline constexpr double budding_neck_radius = 5.0;

/// Zeros of r', found to round-off; empty when r grows all the way from the axis to the rim.
[[nodiscard]] std::optional<Neck> find_neck(const Meridian& meridian);

/// [nm]; infinite without a neck.
[[nodiscard]] double neck_radius(const std::optional<Neck>& neck);

}  // namespace endoflow
