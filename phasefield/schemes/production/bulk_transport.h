#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "phasefield/fem/mesh_transfer.h"
#include "phasefield/schemes/interface/diagnostics.h"
#include "phasefield/schemes/production/bulk_equations.h"
#include "shared/numerics/bdf.h"
#include "shared/output/checkpoint.h"

namespace endoflow::phasefield::production {

/// A step as the bulk sees it: the membrane at its end with flow and molecules, as far as they are known.
struct BulkStep {
    const Space& space;
    const LayerEnergy& energy;
    const StepNumbers& numbers;
    const BdfCoefficients& bdf;
    const Vector& membrane;
};

/// The bulk that the membrane's molecules come from, with fields of its own on the membrane's mesh: where there is none
/// it costs nothing. A step solves for it twice. First with the membrane foreseen, all at once with the exchange, so
/// that a membrane that takes up whatever comes is no stiff problem; that is the supply the membrane's own step sees.
/// Then, with what the membrane has taken up, to the last molecule.
class BulkTransport {
  public:
    BulkTransport(const Parameters& parameters, const Mesh& mesh, MPI_Comm communicator);

    /// Undepleted, beside a membrane with this much coat [nm²], before any step.
    BulkMeasures start(const BulkStep& at_rest, double membrane_mass);
    std::shared_ptr<const BulkSupply> foresee(const BulkStep& step);
    /// `masses`: ∫ c dA of the membrane's solutions [nm²], newest first, `mass` that at the end of the step.
    BulkMeasures take(const BulkStep& step, const std::vector<double>& masses, double mass, double tau);
    /// Makes what was taken the state; `most` solutions are kept.
    void keep(std::size_t most);
    /// Forgets what was before the newest time.
    void start_anew();
    /// What the membrane has been left to see.
    [[nodiscard]] std::shared_ptr<const BulkSupply> supply() const;

    /// Around a change of the mesh.
    void before_adaptation();
    void after_adaptation();
    /// When it has changed for the last time.
    void renew();

    /// Before the mesh is saved, after the membrane's own vectors.
    void save(Checkpoint& checkpoint);
    /// In the same order.
    void load(const Checkpoint& checkpoint);

    [[nodiscard]] const Space& space() const { return space_; }
    [[nodiscard]] const std::vector<Vector>& solutions() const { return solutions_; }

  private:
    [[nodiscard]] BulkProblem problem(const BulkStep& step) const;
    Vector solve(const BulkStep& step, BulkExchange exchange);
    [[nodiscard]] std::shared_ptr<const BulkSupply> supply_of(const Vector& solution) const;
    void distribute();
    template <class Archive>
    void serialize(Archive&& archive) {
        archive("bulk_missing", missing_);
        archive("bulk_made_up", made_up_);
        archive("bulk_first_mass", first_mass_);
        archive("bulk_corrected", corrected_);
    }

    BulkNumbers numbers_;
    Space space_;
    LinearSystem system_;
    std::vector<Vector> solutions_;  // newest first, as all below
    std::vector<double> missing_;    // a₀c_∞ ∫ χd [nm²]
    std::vector<double> made_up_;    // what the walls have let in of it since the start [nm²]
    double first_mass_ = 0;          // of the membrane [nm²]
    double corrected_ = 0;           // what `take` has corrected since the start [nm²]

    Vector trial_;
    double trial_missing_ = 0, trial_made_up_ = 0, trial_corrected_ = 0;
    std::optional<MeshTransfer> transfer_;
};

}  // namespace endoflow::phasefield::production
