#pragma once

// Thermal noise about a run: the covariance of every mode from the flat bare membrane's equilibrium on.

#include <array>
#include <optional>
#include <vector>

#include "boundary_integral/modes/along_run.h"
#include "boundary_integral/modes/covariance_propagation.h"
#include "boundary_integral/modes/noisy_quantities.h"

namespace endoflow::boundary_integral {

/// Standard deviation of a quantity, and what of it fluctuations of the start have left.
struct Spread {
    double total, inherited;
};

/// What the noise does to a membrane's numbers. Without a neck there is no bud.
struct NoisyShape {
    double height;         // of the pole over the rim's plane, nm
    Spread height_spread;  // nm
    struct Bud {
        double neck_radius, neck_rate;         // nm, nm/µs
        Spread neck;                           // of the radius, m = 0, nm
        Spread sideways;                       // of the bud's centre of volume along x, and as much along y, m = 1, nm
        Spread ellipticity, neck_ellipticity;  // (a - b)/(a + b) of the axes along x and y, m = 2
    };
    std::optional<Bud> bud;
};

class NoiseGrowth {
  public:
    /// Modes 0 ... last of the run, in the box, at `temperature` (K). `tolerance`: see CovariancePropagation. Throws
    /// SolverError("no-thermal-equilibrium").
    NoiseGrowth(const AlongRun& run, double temperature, double tolerance);
    NoiseGrowth(const NoiseGrowth&) = delete;  // its propagation holds its address
    NoiseGrowth& operator=(const NoiseGrowth&) = delete;

    void advance(double time);

    /// The linearised membrane at the time reached.
    [[nodiscard]] const Moment& moment() const { return moment_; }
    [[nodiscard]] NoisyShape shape() const;

    /// Of w of a mode along the meridian's points, nm: total and inherited. In modes m > 0 that of the amplitudes of
    /// cos(m phi) and of sin(m phi) each, and so that of the displacement at any angle.
    [[nodiscard]] std::array<Eigen::VectorXd, 2> displacement(int mode) const;
    /// Root of the mean of the displacement's variance over the membrane, nm.
    [[nodiscard]] Spread rms(int mode) const;

    /// When the neck's spread first was a third of its radius, µs: linear noise ends there.
    [[nodiscard]] std::optional<double> linear_until() const { return linear_until_; }
    [[nodiscard]] const std::vector<Covariance>& values() const { return propagation_.values(); }  // of each mode
    [[nodiscard]] long steps() const { return propagation_.steps(); }

  private:
    const AlongRun& run_;
    double thermal_energy_;  // pN nm
    Moment moment_;          // of the latest evaluation: at the end of a step, the time reached
    CovariancePropagation propagation_;
    struct Ratio {
        double time, value;  // of the neck's spread to its radius
    };
    std::optional<Ratio> ratio_;
    std::optional<double> linear_until_;

    [[nodiscard]] std::vector<Covariance> equilibria() const;
    [[nodiscard]] std::vector<NoisyRate> rates(double time);
    [[nodiscard]] Spread spread(const NoisyQuantity& quantity) const;
    void follow_neck();
};

}  // namespace endoflow::boundary_integral
