#pragma once

#include <deal.II/base/index_set.h>

#include <vector>

#include "phasefield/fem/space.h"

namespace endoflow::phasefield {

/// Anderson's acceleration (type II; Walker & Ni, SIAM J. Numer. Anal. 49 (2011) 1715) of the fixed-point iteration
/// x ← x + d(x): what former changes of d have shown to be linear in x is taken out at once. With d a Newton increment
/// by the factors of an earlier step this finds the few directions in which those factors no longer serve.
class AndersonMixing {
  public:
    /// The norm of an increment is that of its fields' l² norms, in which unknown i has the weight counted(i), each
    /// relative to the larger one of the first two increments (one sweep over blocks of fields may leave a field as it
    /// is) or, where both are round-off, to `least[field]` per unknown.
    AndersonMixing(const Space& space, std::vector<double> least, Vector counted);

    /// The norm above: at most √(number of fields) for the first increment. Collective.
    [[nodiscard]] double norm(const Vector& increment) const;

    /// x becomes the next iterate; `increment` is d(x). Ghost values of x are updated. Collective.
    void advance(Vector& x, const Vector& increment);

  private:
    [[nodiscard]] double product(const Vector& a, const Vector& b) const;
    /// Of each field the square of its l² norm, over all processes.
    [[nodiscard]] std::vector<double> squares(const Vector& a) const;
    void measure_by(const Vector& increment);
    void remember(const Vector& increment);

    std::vector<dealii::IndexSet> fields_;     // own unknowns
    std::vector<double> largest_;              // l² norms of the fields, squared
    Vector counted_, weight_;                  // weight_: of the inner product
    std::vector<Vector> changes_, movements_;  // orthonormal changes of d, and the movements of x that caused them
    Vector last_increment_, last_movement_;
    int increments_ = 0;
};

}  // namespace endoflow::phasefield
