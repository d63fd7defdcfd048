#include "phasefield/schemes/paper/conserved_terms.h"
#include "phasefield/schemes/paper/surface_transport.h"
#include "shared/model/double_well.h"

namespace endoflow::phasefield::paper {

namespace {

/// (41):  |∇φ| μ + ε_c ∇·(|∇φ| ∇c) − |∇φ| W'(c)/ε_c = 0, W' linearised about the iterate. ε_c is the molecules' own
/// width.
void add_chemical_potential(const std::vector<LayerPoint>& points, double width, LocalSystem& local) {
    const auto& c = local.field(concentration).value;
    local.linear(potential, Op::value, potential, Op::value,
                 at_layer_points(points, [](const auto& p, std::size_t) { return p.measure * p.weight; }));
    add_layer_diffusion(points, -width, potential, concentration, local);
    local.residual(potential, Op::value, at_layer_points(points, [&](const auto& p, std::size_t q) {
                       return -p.measure * p.weight / width * double_well(c[q]).first;
                   }));
    local.jacobian(potential, Op::value, concentration, Op::value,
                   at_layer_points(points, [&](const auto& p, std::size_t q) {
                       return -p.measure * p.weight / width * double_well(c[q]).second;
                   }));
}

/// Without a chemical potential μ is just kept zero.
void add_no_potential(const std::vector<LayerPoint>& points, LocalSystem& local) {
    local.linear(potential, Op::value, potential, Op::value,
                 at_layer_points(points, [](const auto& p, std::size_t) { return p.measure * p.weight; }));
}

void add_molecule_terms(const std::vector<LayerPoint>& points, const MoleculeParameters& molecules, double tau,
                        LocalSystem& local) {
    add_conserved_rate(points, tau, concentration, concentration, local);
    switch (molecules.transport) {
        case Transport::cahn_hilliard:  // (40), (41)
            add_layer_diffusion(points, molecules.mobility, concentration, potential, local);
            add_chemical_potential(points, molecules.interface_width, local);
            break;
        case Transport::fickian:  // (39)
            add_layer_diffusion(points, molecules.diffusivity, concentration, concentration, local);
            [[fallthrough]];
        case Transport::advection:  // (14), with the diffusion across the layer that keeps c constant there
            add_normal_diffusion(points, molecules.normal_diffusivity, concentration, concentration, local);
            add_no_potential(points, local);
            break;
    }
}

}  // namespace

void advance_molecules(const Spaces& spaces, const Vector& flow_old, const Vector& flow_new,
                       const Parameters& parameters, double tau, LinearSystem& system, Vector& molecules) {
    const auto terms = [&](const std::vector<LayerPoint>& points, LocalSystem& local) {
        add_molecule_terms(points, parameters.molecules, tau, local);
    };
    const auto no_inflow = [](const auto&, const CellBox&, dealii::Vector<double>&) {};
    advance_on_layer(spaces, spaces.molecules, flow_old, flow_new, parameters, terms, no_inflow, system, molecules);
}

}  // namespace endoflow::phasefield::paper
