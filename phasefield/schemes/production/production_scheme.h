#pragma once

#include "phasefield/fem/mesh.h"
#include "phasefield/schemes/interface/scheme.h"
#include "phasefield/schemes/production/bulk_transport.h"
#include "phasefield/schemes/production/constants.h"
#include "phasefield/schemes/production/diagnostics.h"
#include "phasefield/schemes/production/step_solver.h"

namespace endoflow::phasefield::production {

/// Cells in the layer, in units of ε, where phase_field.cell_size is 0.
inline constexpr double cell_per_epsilon = constant("cell_per_epsilon");

/// All fields at one time level are solved for together by Newton's method; BDF3 in time with the error of ψ
/// controlled.
class ProductionScheme : public Scheme {
  public:
    ProductionScheme(const Parameters& parameters, MPI_Comm communicator);

    StepOutcome start() override;
    StepOutcome load(const std::filesystem::path& directory, const Checkpoint& checkpoint) override;
    void save(const std::filesystem::path& directory, Checkpoint& checkpoint) override;
    [[nodiscard]] double step(double time, double deadline) const override;
    StepOutcome attempt(double time, double tau) override;
    void keep(double time, double tau, const StepOutcome& outcome) override;
    void reject(double time, double tau) override;
    void follow(const MembraneCurve& curve) override;
    [[nodiscard]] LayerIntegrals integrate() const override { return integrals_; }
    [[nodiscard]] Contour contour_at(double time) const override { return contour(polynomial(time, times_.size())); }
    void write_fields(const std::filesystem::path& run_directory, std::vector<double>& times,
                      double time) const override;
    [[nodiscard]] double thickness_at(double r, double z) const override;
    [[nodiscard]] double unknowns() const override { return static_cast<double>(space_.dofs.n_dofs()); }
    [[nodiscard]] double cells() const override { return static_cast<double>(mesh_->n_global_active_cells()); }
    [[nodiscard]] std::vector<NamedNumber> constants() const override;
    [[nodiscard]] std::vector<NamedNumber> solver_counts() const override;
    /// So far.
    [[nodiscard]] unsigned int factorisations() const { return solver_.counts().factorisations; }

  private:
    void distribute();
    void renew();
    bool adapt_once(const MembraneCurve& curve);
    /// That of the membrane at the end of the step; the molecules keep their integrals.
    void foresee_thickness(double tau);
    /// Each solution's to its own: with one factor for all, what is left of the others' errors would be a source.
    void restore_molecules();
    /// The polynomial through the newest `count` solutions.
    [[nodiscard]] Vector polynomial(double time, std::size_t count) const;
    [[nodiscard]] std::size_t order() const;
    [[nodiscard]] Contour contour(const Vector& solution) const;
    /// Measures the newest solution: renews integrals_ and returns the rest.
    StepOutcome present();

    Parameters parameters_;
    LayerEnergy energy_;
    std::unique_ptr<Mesh> mesh_;
    Space space_;
    StepNumbers numbers_;
    StepSolver solver_;
    std::unique_ptr<BulkTransport> bulk_;  // none: it is never depleted
    std::vector<Vector> solutions_;        // newest first
    std::vector<double> times_;            // of them [µs]
    std::vector<double> masses_;           // ∫ c dA of them [nm²]
    LayerIntegrals integrals_{};
    MembraneCurve membrane_;

    Vector trial_;
    LayerIntegrals trial_integrals_{};
    double trial_factor_ = 1;  // by which the step may grow
    double trial_motion_ = 0;  // of the layer
    double trial_change_ = 0;  // of membrane and molecules in the step, over the errors that it may have

    double nominal_;          // the next step [µs]
    double speed_ = 0;        // of the membrane in the last step [nm/µs]
    double moved_ = 0;        // of the layer, since the mesh was made: in units of ε, times phase_field.epsilon [nm]
    double since_start_ = 0;  // steps taken
};

}  // namespace endoflow::phasefield::production
