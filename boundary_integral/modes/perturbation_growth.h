#pragma once

// What perturbations of a run's start become while the run goes on: the propagator of each mode.

#include <optional>
#include <string>
#include <vector>

#include "boundary_integral/modes/along_run.h"
#include "boundary_integral/modes/linear_propagation.h"

namespace endoflow::boundary_integral {

/// Largest displacement |w| of every initial shape, or that of the coat's edge, nm.
inline constexpr double initial_amplitude = 0.1;

/// A perturbation at one time.
struct Perturbation {
    std::string initial;         // its shape at the start: a name of initial_shapes(), or "worst"
    Eigen::VectorXd y;           // coefficients on the run's mesh
    double peak = 0.0;           // largest |w|, nm
    double rms = 0.0;            // of w cos(m phi) over the membrane, nm
    std::optional<double> gain;  // of the rms since the start; none for a shape without displacement
};

class PerturbationGrowth {
  public:
    /// `tolerance`: see LinearPropagation.
    PerturbationGrowth(const AlongRun& run, double tolerance);
    PerturbationGrowth(const PerturbationGrowth&) = delete;  // its propagation holds its address
    PerturbationGrowth& operator=(const PerturbationGrowth&) = delete;

    void advance(double time) { propagation_.advance(time); }

    /// The linearised membrane at the time reached.
    [[nodiscard]] const Moment& moment() const { return moment_; }

    /// The named initial shapes, and the worst: of all displacements without c' at the start, that whose rms has grown
    /// most by now.
    [[nodiscard]] std::vector<Perturbation> perturbations(int mode) const;

    /// The worst initial shape, at the start.
    [[nodiscard]] Perturbation worst_at_start(int mode) const;

    [[nodiscard]] long steps() const { return propagation_.steps(); }

  private:
    struct Start {
        PerturbationNorms norms;
        double area;
        std::vector<InitialShape> shapes;
        Eigen::MatrixXd basis;  // columns of unit norm, of w first
    };
    const AlongRun& run_;
    Moment moment_;  // of the latest evaluation: at the end of a step, the time reached
    std::vector<double> points_;
    std::vector<Start> start_;
    LinearPropagation propagation_;

    [[nodiscard]] std::size_t index(int mode) const { return static_cast<std::size_t>(mode - run_.first_mode()); }
    [[nodiscard]] std::vector<LinearRate> rates(double time);
    [[nodiscard]] std::vector<Eigen::MatrixXd> starts();
    [[nodiscard]] Perturbation measured(int mode, std::string name, Eigen::VectorXd y, const PerturbationNorms& norms,
                                        double area) const;
    [[nodiscard]] Eigen::VectorXd worst_direction(int mode, const PerturbationNorms& now) const;
};

}  // namespace endoflow::boundary_integral
