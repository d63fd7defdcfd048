#pragma once

#include <memory>

#include "phasefield/fem/space.h"
#include "phasefield/schemes/paper/coupled_point.h"
#include "phasefield/schemes/paper/fields.h"
#include "phasefield/solver/linear_system.h"
#include "shared/model/bending_model.h"

namespace endoflow::phasefield::paper {

/// The spaces of all unknowns on one mesh.
struct Spaces {
    Spaces(const Mesh& mesh, const Parameters& parameters);
    void distribute(const Parameters& parameters);

    Space flow;        // FlowComponent
    Space molecules;   // MoleculeComponent
    Space stretching;  // s
    Space gradient;    // of φ, recovered
};

/// All unknowns at one time level; ghosted vectors.
struct State {
    Vector flow, molecules, stretching;
};

/// `state` becomes `other`, ghost values included. Assigning vectors instead would keep the ghosts of an earlier mesh
/// if the processes own as many unknowns there as now.
void take_over(State& state, State other);

/// Fields of time level n on one cell, evaluated at the quadrature points of the coupled system.
class OldFields {
  public:
    OldFields(const Spaces& spaces, const Parameters& parameters, const dealii::Quadrature<2>& quadrature);
    /// Also evaluate the profile relaxation, for which `recovered_gradient` of φ is needed (kept by reference).
    void with_relaxation(const Vector& recovered_gradient) { gradient_ = &recovered_gradient; }
    /// Fills `points` for the cell with the given flow-space iterator position.
    void evaluate_cell(const dealii::DoFHandler<2>::active_cell_iterator& cell, const State& state,
                       CoupledPoints& points);

  private:
    void evaluate_relaxation(const dealii::DoFHandler<2>::active_cell_iterator& cell, CoupledPoints& points);

    const Spaces* spaces_;
    const Vector* gradient_ = nullptr;
    Parameters parameters_;
    BendingModel model_;
    dealii::Quadrature<2> quadrature_;
    std::vector<std::shared_ptr<const ScalarBasis>> flow_bases_;
    ScalarBasis molecule_basis_, stretching_basis_;
    dealii::Vector<double> flow_values_, molecule_values_, stretching_values_, gradient_values_;
    std::vector<double> coefficients_;
    ScalarField phi_, u_r_, u_z_, moment_, concentration_, stretching_, gradient_r_, gradient_z_;
};

/// Number of Gauss points per direction that integrates the coupled system well.
unsigned int quadrature_points(const PhaseFieldParameters& parameters);

/// Assembles Jacobian and right-hand side (−residual) of the coupled system at `iterate`, the old level being
/// `old_state`.
void assemble_coupled(const Spaces& spaces, const State& old_state, const Vector& iterate, const Parameters& parameters,
                      double tau, LinearSystem& system);

/// Which components meet in the coupled system's matrix.
Couplings flow_couplings(const Parameters& parameters);

}  // namespace endoflow::phasefield::paper
