#pragma once

#include "phasefield/schemes/interface/scheme.h"
#include "phasefield/schemes/paper/discretization.h"
#include "phasefield/schemes/paper/step_control.h"

namespace endoflow::phasefield::paper {

/// Largest cells in the layer, in units of ε: they resolve fourth derivatives of the tanh profile.
inline constexpr double cell_per_epsilon = 1.25 / 1.2;

/// Sec. 3 of the paper: first order in time, one linear system per block of unknowns and step.
class PaperScheme : public Scheme {
  public:
    PaperScheme(const Parameters& parameters, MPI_Comm communicator);

    StepOutcome start() override;
    StepOutcome load(const std::filesystem::path& directory, const Checkpoint& checkpoint) override;
    void save(const std::filesystem::path& directory, Checkpoint& checkpoint) override;
    [[nodiscard]] double step(double time, double deadline) const override { return control_.step(time, deadline); }
    StepOutcome attempt(double time, double tau) override;
    void keep(double time, double tau, const StepOutcome& outcome) override;
    void reject(double time, double tau) override;
    void follow(const MembraneCurve& curve) override;
    [[nodiscard]] LayerIntegrals integrate() const override;
    [[nodiscard]] Contour contour_at(double time) const override;
    void write_fields(const std::filesystem::path& run_directory, std::vector<double>& times,
                      double time) const override;
    [[nodiscard]] double thickness_at(double /*r*/, double /*z*/) const override;
    [[nodiscard]] double unknowns() const override;
    [[nodiscard]] double cells() const override;

  private:
    StepOutcome begin();
    /// Linear over the last step, as accurate as the steps are: φ moves by less than max_motion.
    [[nodiscard]] State state_at(double time) const;

    Discretization discretization_;
    StepControl control_;
    State state_, trial_;
    State before_;                     // the last step, on its mesh: until follow()
    double time_ = 0, last_step_ = 0;  // of state_ [µs]
    double moved_ = 0;                 // since the mesh was made [nm]
    double energy_ = 0;                // bending energy of the present state [pN nm]
};

}  // namespace endoflow::phasefield::paper
