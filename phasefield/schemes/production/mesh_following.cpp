#include "phasefield/fem/mesh_transfer.h"
#include "phasefield/layer/constants.h"
#include "phasefield/schemes/production/production_scheme.h"
#include "phasefield/schemes/production/refinement.h"

namespace endoflow::phasefield::production {

namespace {

constexpr int most_passes = count("most_passes");

}  // namespace

bool ProductionScheme::adapt_once(const MembraneCurve& curve) {
    if (!flag_bands(*mesh_, refined_bands(curve, parameters_))) return false;
    const auto transfer = MeshTransfer::for_adaptation(space_, state_.solutions);
    if (bulk_) bulk_->before_adaptation();
    mesh_->execute_coarsening_and_refinement();
    distribute();
    state_.solutions = transfer.adapted(space_);
    if (bulk_) bulk_->after_adaptation();
    return true;
}

void ProductionScheme::follow(const MembraneCurve& curve) {
    if (state_.moved < follow_after_motion(parameters_)) return;
    state_.moved = 0;
    bool adapted = false;
    for (int pass = 0; pass < most_passes && adapt_once(curve); ++pass) adapted = true;
    if (!adapted) return;
    if (state_.thickness) state_.thickness = thickness_on(*mesh_, state_.thickness->curve());
    solver_.reinit(space_, curve);
    if (bulk_) bulk_->renew();
    // Cells are coarsened outside of the layer alone; what that changes in ∫δ_Γ c is restored to round-off. s, a
    // density, stays: what changes in ∫δ_Γ s is the area that the layer measures, and would be a strain.
    state_.solutions = with_their_molecules(at_rest());
    for (auto& solution : state_.solutions) impose_boundary_values(space_, parameters_, solution);
    present();
}

}  // namespace endoflow::phasefield::production
