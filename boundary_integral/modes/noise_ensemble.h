#pragma once

// Thermal noise of the start by brute force: nonlinear runs from random flat membranes.

#include <functional>
#include <random>
#include <vector>

#include "boundary_integral/modes/along_run.h"

namespace endoflow::boundary_integral {

/// Of a number in the members of an ensemble: mean and standard deviation.
struct SampleSpread {
    double mean, deviation;
};

/// Runs from states of the flat bare membrane's equilibrium in mode 0, on which the coat lies as the case says, without
/// noise of their own: their spread is what NoiseGrowth calls inherited, as far as the motion is linear in it.
class NoiseEnsemble {
  public:
    /// `temperature` in K. The same seed gives the same members.
    NoiseEnsemble(const AlongRun& run, double temperature, unsigned int seed);

    /// Adds members, followed to the last of `times` (µs, ascending); all calls with the same times. Throws the
    /// SolverError of a member that cannot be followed.
    void add(std::size_t members, const std::vector<double>& times);

    [[nodiscard]] std::size_t members() const { return heights_.size(); }
    /// Of the pole over the rim's plane at a time, nm.
    [[nodiscard]] SampleSpread height(std::size_t time) const { return spread(heights_, time); }
    /// Of the neck's radius, nm; no number while a member has no neck.
    [[nodiscard]] SampleSpread neck(std::size_t time) const { return spread(necks_, time); }

  private:
    using Table = std::vector<std::vector<double>>;  // a row for each member, a column for each time

    [[nodiscard]] Eigen::VectorXd random_start();
    [[nodiscard]] static SampleSpread spread(const Table& values, std::size_t time);

    const AlongRun& run_;
    Eigen::MatrixXd root_;  // heights at the nodes of the splines from independent normal numbers, nm
    std::mt19937_64 random_;
    std::normal_distribution<double> normal_;
    Table heights_, necks_;
};

}  // namespace endoflow::boundary_integral
