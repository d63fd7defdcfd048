#include "phasefield/solver/anderson.h"

#include <deal.II/base/mpi.h>
#include <deal.II/dofs/dof_tools.h>

#include <algorithm>
#include <cmath>

#include "phasefield/fem/reduction.h"

namespace endoflow::phasefield {

namespace {

constexpr double linearly_dependent = 1e-8;  // part of a change that is left beside the former ones

}  // namespace

AndersonMixing::AndersonMixing(const Space& space, const Vector& first, const std::vector<double>& least,
                               const Vector& counted) {
    weight_.reinit(first, false);
    const auto fields = dealii::DoFTools::locally_owned_dofs_per_component(space.dofs);
    for (std::size_t field = 0; field < fields.size(); ++field) {
        double square = 0, unknowns = 0;
        for (const auto i : fields[field]) {
            square += counted(i) * first(i) * first(i);
            unknowns += counted(i);
        }
        sum_over_processes({&square, &unknowns}, first.get_mpi_communicator());
        square = std::max(square, unknowns * least[field] * least[field]);
        for (const auto i : fields[field]) weight_(i) = square > 0 ? counted(i) / square : 0;
    }
}

double AndersonMixing::product(const Vector& a, const Vector& b) const {
    double sum = 0;
    for (unsigned int i = 0; i < weight_.locally_owned_size(); ++i)
        sum += weight_.local_element(i) * a.local_element(i) * b.local_element(i);
    return dealii::Utilities::MPI::sum(sum, weight_.get_mpi_communicator());
}

double AndersonMixing::norm(const Vector& increment) const {
    return std::sqrt(product(increment, increment));
}

void AndersonMixing::remember(const Vector& increment) {
    Vector change = increment, movement = last_movement_;
    change -= last_increment_;
    const double whole = norm(change);
    for (std::size_t i = 0; i < changes_.size(); ++i) {
        const double part = product(changes_[i], change);
        change.add(-part, changes_[i]);
        movement.add(-part, movements_[i]);
    }
    const double left = norm(change);
    if (!(left > linearly_dependent * whole)) return;
    change /= left;
    movement /= left;
    changes_.push_back(std::move(change));
    movements_.push_back(std::move(movement));
}

void AndersonMixing::advance(Vector& x, const Vector& increment) {
    if (last_increment_.size() > 0) remember(increment);
    Vector movement = increment, rest = increment;
    for (std::size_t i = 0; i < changes_.size(); ++i) {
        const double part = product(changes_[i], rest);
        rest.add(-part, changes_[i]);
        movement.add(-part, changes_[i], -part, movements_[i]);
    }
    x += movement;
    x.update_ghost_values();
    last_increment_ = increment;
    last_movement_ = movement;
}

}  // namespace endoflow::phasefield
