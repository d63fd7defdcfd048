#pragma once

namespace endoflow {

/// (r, z) = (equator sin t, polar cos t), 0 <= t <= π, nm.
struct Spheroid {
    double equator, polar;

    [[nodiscard]] double radius(double t) const;
    [[nodiscard]] double height(double t) const;
    /// Speed of the parametrisation |d(r, z)/dt|.
    [[nodiscard]] double metric(double t) const;
    /// Sum of the principal curvatures, positive [1/nm].
    [[nodiscard]] double curvature(double t) const;
    /// a = A/2π between the north pole and t, nm².
    [[nodiscard]] double label(double t) const;
    /// t of the parallel above which a given fraction of the area lies.
    [[nodiscard]] double parameter_of(double label_fraction) const;
    /// t of the point of the meridian that is closest to (r, z) [nm], r >= 0.
    [[nodiscard]] double closest(double r, double z) const;
    [[nodiscard]] double area() const;
    [[nodiscard]] double volume() const;
    /// Arc length from pole to pole.
    [[nodiscard]] double length() const;
};

}  // namespace endoflow
