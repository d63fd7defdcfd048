#pragma once

#include "statics/continuation.h"
#include "statics/shape_equations.h"
#include "statics/stationary_state.h"

namespace endoflow::statics {

/// The families of Seifert, Berndl & Lipowsky, Phys. Rev. A 44, 1182 (1991): prolates and oblates begin at the sphere
/// and are symmetric about their equator; stomatocytes are oblates whose north pole is turned in, and exist up to a
/// fold at a reduced volume of about 0.66.
enum class VesicleFamily { prolate, oblate, stomatocyte };

/// A stationary vesicle.
struct VesicleState {
    ClosedMembrane membrane;
    PiecewiseSolution solution;
    std::vector<Fold> folds;    // passed on the way from the sphere
    double relative_error = 0;  // change of energy and pressure when every element was cut in two

    [[nodiscard]] double bending_energy() const;  // pN nm
    [[nodiscard]] double pressure() const;        // inside minus outside, pN/nm²
    [[nodiscard]] double tension() const;         // pN/nm
};

/// A spheroid of the membrane's area and volume with C = 0, prolate or oblate, as a guess for Newton's method near the
/// sphere; its pressure and tension are those of the sphere's softest mode, −12 β/R³ and −6 β/R².
[[nodiscard]] PiecewiseSolution spheroidal_guess(const ClosedMembrane& membrane, VesicleFamily family,
                                                 const GaussRule& rule, const BoundaryValueProblem& problem,
                                                 std::size_t elements);

/// The stationary vesicle that is connected with the sphere through shapes of the family: followed in the reduced
/// volume at C = 0, then in C. Throws InputError for a reduced volume outside (0, 1), SolverError "no-stationary-state"
/// where the family ends before.
[[nodiscard]] VesicleState find_vesicle(const ClosedMembrane& membrane, VesicleFamily family,
                                        const Resolution& resolution = {});

/// The branch through a vesicle along another path, from the path's value `begin`, which is this vesicle's, to `end`.
/// Empty when Newton's method fails at once.
[[nodiscard]] std::optional<Branch> continue_vesicle(const VesicleState& state, const MembranePath& with, double begin,
                                                     double end, const Visitor& visit,
                                                     const Resolution& resolution = {});

}  // namespace endoflow::statics
