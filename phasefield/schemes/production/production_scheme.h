#pragma once

#include <optional>

#include "phasefield/fem/mesh.h"
#include "phasefield/layer/constants.h"
#include "phasefield/schemes/interface/scheme.h"
#include "phasefield/schemes/production/bulk_transport.h"
#include "phasefield/schemes/production/diagnostics.h"
#include "phasefield/schemes/production/scheme_state.h"
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
    [[nodiscard]] bool collar_waits() const override { return case_.loads.collar_waits(); }
    void place_collar(double area) override;
    void follow(const MembraneCurve& curve) override;
    [[nodiscard]] LayerIntegrals integrate() const override { return state_.integrals; }
    [[nodiscard]] Contour contour_at(double time) const override {
        return contour(polynomial(state_.solutions, time, state_.times.size()));
    }
    void write_fields(const std::filesystem::path& run_directory, std::vector<double>& times,
                      double time) const override;
    [[nodiscard]] double thickness_at(double r, double z) const override;
    [[nodiscard]] double unknowns() const override { return static_cast<double>(space_.dofs.n_dofs()); }
    [[nodiscard]] double cells() const override { return static_cast<double>(mesh_->n_global_active_cells()); }
    [[nodiscard]] std::vector<NamedNumber> constants() const override;
    [[nodiscard]] std::vector<NamedNumber> solver_counts() const override;
    /// So far.
    [[nodiscard]] unsigned int factorisations() const { return solver_.factors().made(); }

  private:
    void distribute();
    /// The mesh has changed, and the space with it.
    bool adapt_once(const MembraneCurve& curve);
    /// The state's solutions, each with its own ∫ c dA where the layer has a step's thickness: with one factor for all,
    /// what is left of the others' errors would be a source.
    [[nodiscard]] std::vector<Vector> with_their_molecules(const StepNumbers& step) const;
    /// What Newton's method has left of the molecules' balance a₀ ∫ c dA + Σ_j b_j ∫ c(t_j) dA = ∫ j dA, which the rows
    /// of c have exactly, goes into c as a whole.
    void balance_molecules(const BdfCoefficients& bdf, SolutionMeasures& measures, Vector& solution) const;
    /// The polynomial in time through the newest `count` of the state's times, of these vectors.
    [[nodiscard]] Vector polynomial(const std::vector<Vector>& solutions, double time, std::size_t count) const;
    [[nodiscard]] Contour contour(const Vector& solution) const;
    /// Numbers of the state, where no step is made.
    [[nodiscard]] StepNumbers at_rest() const;
    /// Those of a step, with what is foreseen for its end.
    [[nodiscard]] StepNumbers foreseen(double tau, const BdfCoefficients& bdf, double end) const;
    /// Measures the newest solution into the state and returns the rest.
    StepOutcome present();

    Parameters parameters_;
    CaseNumbers case_;
    std::unique_ptr<Mesh> mesh_;
    Space space_;
    StepSolver solver_;
    std::unique_ptr<BulkTransport> bulk_;  // none: it is never depleted
    SchemeState state_;
    std::optional<Trial> trial_;
};

}  // namespace endoflow::phasefield::production
