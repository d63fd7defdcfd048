#include "phasefield/discretization/space.h"

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>

#include <cmath>

namespace endoflow::phasefield {

namespace {

dealii::FESystem<2> system_element(const std::vector<unsigned int>& degrees) {
    std::vector<const dealii::FiniteElement<2>*> elements;
    std::vector<unsigned int> multiplicities(degrees.size(), 1);
    for (const unsigned int degree : degrees) elements.push_back(new dealii::FE_Q<2>(degree));
    dealii::FESystem<2> system(elements, multiplicities);
    for (const auto* element : elements) delete element;
    return system;
}

}  // namespace

Space::Space(const Mesh& mesh, const std::vector<unsigned int>& degrees_)
    : degrees(degrees_), element(system_element(degrees_)), dofs(mesh), local(degrees_.size()) {
    for (unsigned int component = 0; component < degrees.size(); ++component)
        local[component].resize((degrees[component] + 1) * (degrees[component] + 1));
    for (unsigned int i = 0; i < element.n_dofs_per_cell(); ++i) {
        const auto [component, index] = element.system_to_component_index(i);
        local[component][index] = i;
    }
}

void Space::distribute() {
    dofs.distribute_dofs(element);
    owned = dofs.locally_owned_dofs();
    dealii::DoFTools::extract_locally_relevant_dofs(dofs, relevant);
    constraints.clear();
    constraints.reinit(relevant);
    dealii::DoFTools::make_hanging_node_constraints(dofs, constraints);
    hanging_nodes.clear();
    hanging_nodes.copy_from(constraints);
    hanging_nodes.close();
}

Vector Space::vector() const {
    return Vector(owned, relevant, dofs.get_communicator());
}

std::vector<unsigned int> flow_degrees(const PhaseFieldParameters& p) {
    const auto k = static_cast<unsigned int>(p.degree), ku = static_cast<unsigned int>(p.velocity_degree),
               kt = static_cast<unsigned int>(p.tension_degree);
    return {ku, ku, ku - 1, kt, k, k, k};
}

namespace {

/// Calls visit(component, global index, support point) for every unknown on a boundary face of the known cells.
template <class Visit>
void for_boundary_unknowns(const Space& space, const Visit& visit) {
    std::vector<dealii::types::global_dof_index> indices(space.element.n_dofs_per_cell());
    for (const auto& cell : space.dofs.active_cell_iterators()) {
        if (cell->is_artificial() || !cell->at_boundary()) continue;
        cell->get_dof_indices(indices);
        const auto extent = cell->vertex(3) - cell->vertex(0);
        for (const unsigned int face : cell->face_indices()) {
            if (!cell->face(face)->at_boundary()) continue;
            for (unsigned int i = 0; i < indices.size(); ++i)
                if (space.element.has_support_on_face(i, face)) {
                    const auto unit = space.element.unit_support_point(i);
                    visit(cell->face(face)->boundary_id(), space.element.system_to_component_index(i).first, indices[i],
                          cell->vertex(0)[1] + unit[1] * extent[1]);
                }
        }
    }
}

void switch_off(Space& space, const std::vector<unsigned int>& components) {
    std::vector<dealii::types::global_dof_index> indices(space.element.n_dofs_per_cell());
    for (const auto& cell : space.dofs.active_cell_iterators()) {
        if (cell->is_artificial()) continue;
        cell->get_dof_indices(indices);
        for (const unsigned int component : components)
            for (const unsigned int i : space.local[component])
                if (!space.constraints.is_constrained(indices[i])) space.constraints.add_line(indices[i]);
    }
}

}  // namespace

void close_flow_constraints(Space& space, const Parameters& p) {
    for_boundary_unknowns(space, [&](dealii::types::boundary_id boundary, unsigned int component,
                                     dealii::types::global_dof_index index, double z) {
        const bool outer = boundary != axis;
        const bool pinned =
            boundary == side && std::abs(z - p.domain.membrane_height) <= p.domain.pin_half_width * (1 + 1e-12);
        const bool fixed = (component == u_r && boundary == axis) || (component == u_z && pinned) ||
                           (component == tension && outer) || (component == phi && boundary == side);
        if (fixed && !space.constraints.is_constrained(index)) space.constraints.add_line(index);
    });
    if (p.fluid.dynamics == Dynamics::geometric)
        switch_off(space, {u_r, u_z, pressure, tension});
    else if (!p.membrane.inextensible)
        switch_off(space, {tension});
    space.constraints.close();
}

void component_values(const Space& space, unsigned int component, const dealii::Vector<double>& cell_values,
                      std::vector<double>& out) {
    const auto& indices = space.local[component];
    out.resize(indices.size());
    for (std::size_t i = 0; i < indices.size(); ++i) out[i] = cell_values(indices[i]);
}

}  // namespace endoflow::phasefield
