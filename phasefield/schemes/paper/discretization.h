#pragma once

#include <memory>

#include "phasefield/contour/cell_contour.h"
#include "phasefield/fem/mesh.h"
#include "phasefield/schemes/paper/coupled_step.h"

namespace endoflow::phasefield::paper {

/// Mesh, spaces and linear systems. They belong together: a new mesh renews them all.
class Discretization {
  public:
    Discretization(const Parameters& parameters, MPI_Comm communicator);

    /// Renumbers and reallocates on the present mesh.
    void renew();

    Parameters parameters;
    MPI_Comm communicator;
    std::unique_ptr<Mesh> mesh;
    Spaces spaces;
    LinearSystem coupled, molecules, stretching;
};

/// The flat membrane at z₀ with its patch of molecules at rest, on a mesh adapted to it (allocates the discretization).
State initial_state(Discretization& discretization);

/// A state of zeros with the layout of the present spaces.
State empty_state(const Spaces& spaces);

/// The membrane φ = 0 and what is known on it; ∫|∇φ| across the layer is 2, so the sharp tension is 2 λ.
ContourFields contour_fields(const Spaces& spaces, const State& state);

/// The layer around the curve, whose cells are the finest.
RefinedBand layer_band(const std::vector<PlanePoint>& curve, const PhaseFieldParameters& parameters);

/// Adapts the mesh to the curve and carries the state over. Cells are refined ahead of the membrane and coarsened far
/// from it, so that φ, c and s are carried over exactly within the layer; ∫|∇φ| c and ∫|∇φ| s are then restored to
/// round-off. Returns false, with nothing changed, when the mesh already fits.
bool adapt(Discretization& discretization, State& state, const std::vector<PlanePoint>& curve);

}  // namespace endoflow::phasefield::paper
