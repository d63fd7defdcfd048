#pragma once

#include <deal.II/distributed/solution_transfer.h>

#include <memory>
#include <vector>

#include "phasefield/fem/space.h"

namespace endoflow::phasefield {

/// Vectors of a space, with ghost values, across a change of the mesh or a checkpoint. All calls are collective, and in
/// the same order for all spaces on a mesh.
class MeshTransfer {
  public:
    /// Before the mesh is adapted.
    static MeshTransfer for_adaptation(const Space& space, const std::vector<Vector>& vectors) {
        MeshTransfer out(space, vectors.size());
        out.transfer_->prepare_for_coarsening_and_refinement(addresses(vectors));
        return out;
    }
    /// When the space is distributed on the adapted mesh.
    [[nodiscard]] std::vector<Vector> adapted(const Space& space) const {
        std::vector<Vector> out(count_, space.vector());
        auto into = targets(out);
        transfer_->interpolate(into);
        for (auto& vector : out) {
            space.hanging_nodes.distribute(vector);
            vector.update_ghost_values();
        }
        return out;
    }

    /// Until the mesh is saved.
    static MeshTransfer for_saving(const Space& space, const std::vector<Vector>& vectors) {
        MeshTransfer out(space, vectors.size());
        out.transfer_->prepare_for_serialization(addresses(vectors));
        return out;
    }
    /// When the mesh is loaded and the space distributed on it.
    static std::vector<Vector> loaded(const Space& space, std::size_t count) {
        std::vector<Vector> out(count, space.vector());
        auto into = targets(out);
        Transfer(space.dofs).deserialize(into);
        for (const auto& vector : out) vector.update_ghost_values();
        return out;
    }

  private:
    using Transfer = dealii::parallel::distributed::SolutionTransfer<2, Vector>;

    MeshTransfer(const Space& space, std::size_t count)
        : transfer_(std::make_unique<Transfer>(space.dofs)), count_(count) {}
    static std::vector<const Vector*> addresses(const std::vector<Vector>& vectors) {
        std::vector<const Vector*> out;
        for (const auto& vector : vectors) out.push_back(&vector);
        return out;
    }
    static std::vector<Vector*> targets(std::vector<Vector>& vectors) {
        std::vector<Vector*> out;
        for (auto& vector : vectors) out.push_back(&vector);
        return out;
    }

    std::unique_ptr<Transfer> transfer_;  // the mesh knows its address
    std::size_t count_;
};

}  // namespace endoflow::phasefield
