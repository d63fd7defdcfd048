#include "phasefield/schemes/paper/discretization.h"

#include <limits>

#include "phasefield/schemes/paper/bending.h"
#include "phasefield/schemes/paper/diagnostics.h"
#include "shared/model/initial_condition.h"

namespace endoflow::phasefield::paper {

namespace {

constexpr double default_band_width = 4.5;  // [ε]

}  // namespace

Discretization::Discretization(const Parameters& parameters_, MPI_Comm communicator_)
    : parameters(parameters_),
      communicator(communicator_),
      mesh(coarse_mesh(parameters, communicator)),
      spaces(*mesh, parameters),
      coupled(communicator, "coupled"),
      molecules(communicator, "molecules"),
      stretching(communicator, "stretching") {}

void Discretization::renew() {
    spaces.distribute(parameters);
    coupled.reinit(spaces.flow, flow_couplings(parameters));
    const auto full = [](unsigned int components) {
        Couplings table(components, components);
        table.fill(dealii::DoFTools::always);
        return table;
    };
    molecules.reinit(spaces.molecules, full(2));
    stretching.reinit(spaces.stretching, full(1));
}

State empty_state(const Spaces& spaces) {
    return {spaces.flow.vector(), spaces.molecules.vector(), spaces.stretching.vector()};
}

ContourFields contour_fields(const Spaces& spaces, const State& state) {
    return {&spaces.flow, &state.flow, phi, u_r, u_z, tension, 2, &spaces.molecules, &state.molecules, concentration};
}

RefinedBand layer_band(const std::vector<PlanePoint>& curve, const PhaseFieldParameters& p) {
    RefinedBand band{{}, static_cast<unsigned int>(p.far_refinements), 2 * p.cell_size};
    const double layers = p.band_width > 0 ? p.band_width : default_band_width;
    for (const auto& point : curve) band.points.push_back({point, layers * p.epsilon});
    return band;
}

State initial_state(Discretization& d) {
    const Parameters& p = d.parameters;
    const double z0 = p.domain.membrane_height, epsilon = p.phase_field.epsilon;
    std::vector<PlanePoint> curve;
    for (double r = 0; r <= p.domain.radius; r += 0.25 * p.phase_field.cell_size) curve.push_back({r, z0});
    RefinedBand band = layer_band(curve, p.phase_field);
    band.slack = std::numeric_limits<double>::infinity();
    while (flag_bands(*d.mesh, {band})) d.mesh->execute_coarsening_and_refinement();
    d.renew();

    State state = empty_state(d.spaces);
    const BendingModel model(p.membrane);
    const auto c = [&](double r) { return initial_concentration(p.molecules, r); };
    const auto profile = [&](double z) { return equilibrium_profile(z0 - z, epsilon); };  // φ = +1 below
    interpolate(
        d.spaces.flow, phi, [&](double, double z) { return profile(z); }, state.flow);
    // On the flat profile ε Δφ = (φ² − 1) φ/ε, so f = (1 − φ²) C/√2.
    interpolate(
        d.spaces.flow, moment,
        [&](double r, double z) {
            const auto b = bending_coefficients(model, c(r));
            const double stiffness = p.phase_field.paper.bending_unknown == BendingUnknown::f ? 1 : b.stiffness;
            return stiffness * b.curvature * inverse_sqrt2 * (1 - profile(z) * profile(z));
        },
        state.flow);
    interpolate(
        d.spaces.molecules, concentration, [&](double r, double) { return c(r); }, state.molecules);
    interpolate(
        d.spaces.stretching, 0, [](double, double) { return 1.0; }, state.stretching);
    finish_interpolation(d.spaces.flow, state.flow);
    finish_interpolation(d.spaces.molecules, state.molecules);
    finish_interpolation(d.spaces.stretching, state.stretching);
    return state;
}

}  // namespace endoflow::phasefield::paper
