#include "phasefield/fem/space.h"

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

void finish_interpolation(const Space& space, Vector& vector) {
    vector.compress(dealii::VectorOperation::insert);
    space.hanging_nodes.distribute(vector);
    vector.update_ghost_values();
}

void scale_component(const Space& space, unsigned int component, double factor, Vector& vector) {
    const Vector old = vector;
    old.update_ghost_values();
    std::vector<dealii::types::global_dof_index> indices(space.element.n_dofs_per_cell());
    vector.zero_out_ghost_values();
    for (const auto& cell : space.dofs.active_cell_iterators()) {
        if (!cell->is_locally_owned()) continue;
        cell->get_dof_indices(indices);
        for (const unsigned int i : space.local[component])
            if (space.owned.is_element(indices[i])) vector(indices[i]) = factor * old(indices[i]);
    }
    vector.update_ghost_values();
}

Vector combination(const Space& space, const std::vector<double>& weights, const std::vector<Vector>& vectors) {
    Vector out = space.vector();
    for (std::size_t j = 0; j < weights.size(); ++j) out.add(weights[j], vectors[j]);
    out.update_ghost_values();
    return out;
}

void component_values(const Space& space, unsigned int component, const dealii::Vector<double>& cell_values,
                      std::vector<double>& out) {
    const auto& indices = space.local[component];
    out.resize(indices.size());
    for (std::size_t i = 0; i < indices.size(); ++i) out[i] = cell_values(indices[i]);
}

}  // namespace endoflow::phasefield
