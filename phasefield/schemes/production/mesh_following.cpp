#include <deal.II/distributed/solution_transfer.h>

#include "phasefield/checkpoint/mesh_checkpoint.h"
#include "phasefield/schemes/production/constants.h"
#include "phasefield/schemes/production/production_scheme.h"
#include "phasefield/schemes/production/refinement.h"
#include "phasefield/schemes/production/thickness_checkpoint.h"

namespace endoflow::phasefield::production {

namespace {

using Transfer = dealii::parallel::distributed::SolutionTransfer<2, Vector>;

constexpr int most_passes = count("most_passes");

std::vector<const Vector*> addresses(const std::vector<Vector>& vectors) {
    std::vector<const Vector*> out;
    for (const auto& vector : vectors) out.push_back(&vector);
    return out;
}

}  // namespace

bool ProductionScheme::adapt_once(const MembraneCurve& curve) {
    if (!flag_bands(*mesh_, refined_bands(curve, parameters_))) return false;

    Transfer transfer(space_.dofs);
    transfer.prepare_for_coarsening_and_refinement(addresses(solutions_));
    if (bulk_) bulk_->before_adaptation();
    mesh_->execute_coarsening_and_refinement();
    distribute();
    std::vector<Vector> carried(solutions_.size(), space_.vector());
    std::vector<Vector*> targets;
    for (auto& vector : carried) targets.push_back(&vector);
    transfer.interpolate(targets);
    for (auto& vector : carried) space_.hanging_nodes.distribute(vector);
    solutions_ = std::move(carried);
    for (const auto& solution : solutions_) solution.update_ghost_values();
    if (bulk_) bulk_->after_adaptation();
    return true;
}

void ProductionScheme::follow(const MembraneCurve& curve) {
    if (moved_ < follow_after_motion(parameters_)) return;
    moved_ = 0;
    bool adapted = false;
    for (int pass = 0; pass < most_passes && adapt_once(curve); ++pass) adapted = true;
    if (!adapted) return;
    if (numbers_.thickness) numbers_.thickness = thickness_on(*mesh_, numbers_.thickness->curve());
    solver_.reinit(space_);
    if (bulk_) {
        bulk_->renew();
        numbers_.supply = bulk_->supply();
    }
    // Cells are coarsened outside of the layer alone; what that changes in ∫δ_Γ c is restored to round-off. s, a
    // density, stays: what changes in ∫δ_Γ s is the area that the layer measures, and would be a strain.
    restore_molecules();
    for (auto& solution : solutions_) impose_boundary_values(space_, parameters_, solution);
    present();
}

void ProductionScheme::save(const std::filesystem::path& directory, Checkpoint& checkpoint) {
    checkpoint.scalars["nominal_step"] = nominal_;
    checkpoint.scalars["speed"] = speed_;
    checkpoint.scalars["moved"] = moved_;
    checkpoint.scalars["steps_since_start"] = since_start_;
    checkpoint.arrays["solution_times"] = times_;
    checkpoint.arrays["solution_masses"] = masses_;
    save_thickness(numbers_.thickness, "thickness", checkpoint);
    make_empty_directory(directory, mesh_->get_communicator());
    Transfer transfer(space_.dofs);
    auto vectors = addresses(solutions_);
    for (const Vector* vector : solver_.save(checkpoint)) {
        vector->update_ghost_values();
        vectors.push_back(vector);
    }
    transfer.prepare_for_serialization(vectors);
    if (bulk_) bulk_->save(checkpoint, solver_.supply_of_factors());
    mesh_->save((directory / "mesh").string());
    MPI_Barrier(mesh_->get_communicator());
}

StepOutcome ProductionScheme::load(const std::filesystem::path& directory, const Checkpoint& checkpoint) {
    nominal_ = checkpoint.scalar("nominal_step");
    speed_ = checkpoint.scalar("speed");
    moved_ = checkpoint.scalar("moved");
    since_start_ = checkpoint.scalar("steps_since_start");
    times_ = checkpoint.array("solution_times");
    masses_ = checkpoint.array("solution_masses");
    numbers_.molecules = masses_.front();
    load_mesh(directory, *mesh_);
    renew();
    numbers_.thickness = thickness_on(*mesh_, load_thickness(checkpoint, "thickness"));
    Transfer transfer(space_.dofs);
    solutions_.assign(times_.size(), space_.vector());
    std::vector<Vector*> targets;
    for (auto& vector : solutions_) targets.push_back(&vector);
    std::vector<Vector> of_factors(StepSolver::saved_vectors(checkpoint), space_.vector());
    for (auto& vector : of_factors) targets.push_back(&vector);
    transfer.deserialize(targets);
    for (const Vector* vector : targets) vector->update_ghost_values();
    if (bulk_) numbers_.supply = bulk_->load(checkpoint);
    solver_.load(space_, numbers_, checkpoint, of_factors);
    if (bulk_) numbers_.supply = bulk_->supply();
    return present();
}

}  // namespace endoflow::phasefield::production
