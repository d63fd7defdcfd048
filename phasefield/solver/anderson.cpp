#include "phasefield/solver/anderson.h"

#include <deal.II/base/mpi.h>
#include <deal.II/dofs/dof_tools.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace endoflow::phasefield {

namespace {

constexpr double linearly_dependent = 1e-8;  // part of a change that is left beside the former ones

}  // namespace

AndersonMixing::AndersonMixing(const Space& space, std::vector<double> least, Vector counted)
    : fields_(dealii::DoFTools::locally_owned_dofs_per_component(space.dofs)),
      largest_(std::move(least)),
      counted_(std::move(counted)) {
    weight_.reinit(counted_, false);
    weight_ = 1;
    const auto unknowns = squares(weight_);
    for (std::size_t field = 0; field < fields_.size(); ++field) largest_[field] *= largest_[field] * unknowns[field];
}

std::vector<double> AndersonMixing::squares(const Vector& a) const {
    std::vector<double> out(fields_.size());
    for (std::size_t field = 0; field < fields_.size(); ++field)
        for (const auto i : fields_[field]) out[field] += counted_(i) * a(i) * a(i);
    dealii::Utilities::MPI::sum(out, a.get_mpi_communicator(), out);
    return out;
}

void AndersonMixing::measure_by(const Vector& increment) {
    const auto found = squares(increment);
    for (std::size_t field = 0; field < fields_.size(); ++field) {
        largest_[field] = std::max(largest_[field], found[field]);
        for (const auto i : fields_[field]) weight_(i) = largest_[field] > 0 ? counted_(i) / largest_[field] : 0;
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
    ++increments_;
    if (increments_ <= 2) measure_by(increment);
    if (increments_ > 1) remember(increment);
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
