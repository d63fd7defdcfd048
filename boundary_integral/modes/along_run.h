#pragma once

// A recorded run followed again: its axisymmetric motion as a function of time, and the linearised membrane at any
// moment of it.

#include <functional>
#include <memory>
#include <vector>

#include "boundary_integral/modes/base_trajectory.h"
#include "boundary_integral/modes/linearised_membrane.h"
#include "boundary_integral/modes/perturbations.h"
#include "boundary_integral/modes/recorded_run.h"

namespace endoflow::boundary_integral {

/// The linearised membrane at one time, for modes first_mode ... last of the run that is followed.
struct Moment {
    double time;  // µs
    int first_mode;
    Evaluation evaluation;
    std::unique_ptr<LinearisedMembrane> membrane;
    std::vector<ModeRates> rates;
    [[nodiscard]] const ModeRates& rates_of(int mode) const {
        return rates[static_cast<std::size_t>(mode - first_mode)];
    }
};

/// Of propagations from a run's start, µs.
inline constexpr double first_propagation_step = 1e-7;

class AlongRun {
  public:
    /// Integrates the run's case from its start to its last shape, with steps whose error is at most 1e-6 nm. Throws
    /// SolverError("modes-off-the-run") when that motion is not the recorded one.
    AlongRun(const RecordedRun& run, int first_mode, int last_mode);
    AlongRun(const AlongRun&) = delete;
    AlongRun& operator=(const AlongRun&) = delete;

    [[nodiscard]] const Parameters& parameters() const { return parameters_; }
    [[nodiscard]] const MembraneDynamics& dynamics() const { return dynamics_; }
    [[nodiscard]] const Surroundings& surroundings() const { return surroundings_; }
    [[nodiscard]] const BaseTrajectory& trajectory() const { return trajectory_; }
    [[nodiscard]] int first_mode() const { return first_mode_; }
    [[nodiscard]] int last_mode() const { return surroundings_.highest_mode(); }
    [[nodiscard]] double distance() const { return distance_; }  // largest, of a recorded point from the motion, nm

    [[nodiscard]] Moment moment(double time, int first_mode) const;

    /// dy/dt of each mode on the run's mesh.
    [[nodiscard]] std::vector<LinearRate> mesh_rates(const Moment& moment) const;

  private:
    Parameters parameters_;
    int first_mode_;
    MembraneDynamics dynamics_;
    Surroundings surroundings_;
    BaseTrajectory trajectory_;
    double distance_ = 0.0;

    /// Calls work(mode, its index) for each mode from the first on, in as many threads as the run asks for.
    void for_modes(int first_mode, const std::function<void(int mode, std::size_t index)>& work) const;
};

}  // namespace endoflow::boundary_integral
