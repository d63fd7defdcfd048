// How many elements a membrane gets: the estimate of what they resolve, and the same membrane on more of them.

#include <catch2/catch.hpp>
#include <numbers>

#include "boundary_integral/evolution/observation.h"
#include "boundary_integral/evolution/refinement.h"
#include "boundary_integral/evolution/resolution_estimate.h"
#include "curves.h"
#include "shared/case/resolution.h"

namespace {

using namespace endoflow;
using namespace endoflow::boundary_integral;
using endoflow::boundary_integral::testing::bulge;

// A flat membrane with c = cos(2π m ξ).
MembraneState with_waves(const MembraneSpace& space, double waves) {
    const Interpolation axial(space.axial());
    std::vector<double> c;
    for (const double xi : space.axial().greville_points()) c.push_back(std::cos(2.0 * std::numbers::pi * waves * xi));
    MembraneState state = bulge(space, 0.0);
    state.c = axial(c);
    return state;
}

}  // namespace

TEST_CASE("the estimate is h⁶ times the sixth derivative, and scales with the curvature", "[resolution]") {
    constexpr double waves = 2.0;
    for (const Index elements : {40, 80}) {
        const MembraneSpace space(elements, 8);
        const double unit = std::pow(2.0 * std::numbers::pi * waves / static_cast<double>(elements), 6);
        const ResolutionEstimate found = estimate_resolution(space, with_waves(space, waves));
        // The jump is a mean of the derivative over six elements: (2 π m h)²/4 = 2.5 % less with 40.
        CHECK(found.concentration == Approx(unit).epsilon(0.03));
        CHECK(found.curve < 1e-9);
    }
}

TEST_CASE("a membrane on more elements is the same membrane", "[resolution]") {
    Parameters parameters;
    const auto coarse = dynamics_with(parameters, 48), fine = dynamics_with(parameters, 64);
    MembraneState state = bulge(coarse->space(), 20.0);
    state.c = coarse->unpack(coarse->initial_vector()).c;
    const Eigen::VectorXd y = coarse->packed(state), moved = transferred(*coarse, y, *fine);
    const double mass = y.tail(coarse->space().axial_count()).sum();
    CHECK(moved.tail(fine->space().axial_count()).sum() == Approx(mass).epsilon(1e-14));
    const ShapeMeasures before = measure_shape(coarse->space(), coarse->unpack(y), parameters.domain),
                        after = measure_shape(fine->space(), fine->unpack(moved), parameters.domain);
    const auto molecules = [](const MembraneDynamics& dynamics, const Eigen::VectorXd& at) {
        return molecule_mass(dynamics.space(), sample(dynamics.space(), dynamics.unpack(at)));
    };
    CHECK(molecules(*fine, moved) == Approx(molecules(*coarse, y)).epsilon(1e-12));
    // What 48 elements leave unresolved of the coat's edge and the bulge is 10⁻⁶ of them; interpolation adds less.
    CHECK(after.membrane_area == Approx(before.membrane_area).epsilon(1e-8));
    CHECK(after.extracellular_volume == Approx(before.extracellular_volume).epsilon(1e-8));
    // The jumps fall with h⁶: (48/64)⁶ = 0.18, and those between the old elements are left.
    CHECK(estimate_resolution(fine->space(), fine->unpack(moved)).relative_error() <
          0.1 * estimate_resolution(coarse->space(), coarse->unpack(y)).relative_error());
}

TEST_CASE("elements follow from the accuracy, the membrane's size and the coat's edge", "[resolution]") {
    Parameters parameters;
    const Index standard = initial_elements(parameters);
    CHECK(standard == elements_asked_for(parameters));
    parameters.boundary_integral.accuracy = 1e-5;
    // A twelfth root of a hundredth is 1.47, but for rounding up.
    CHECK(static_cast<double>(elements_asked_for(parameters)) / static_cast<double>(standard) ==
          Approx(1.47).epsilon(0.02));
    const int strict = elements_asked_for(parameters);
    parameters.boundary_integral.accuracy = 1e-3;
    parameters.time.tolerance = 1e-6;  // elements keep up with the steps, but are no fewer where those are loose
    CHECK(elements_asked_for(parameters) == strict);
    parameters.time.tolerance = 1e-2;
    CHECK(elements_asked_for(parameters) == standard);
    parameters.time.tolerance = 0;
    parameters.domain.radius = 160;
    CHECK(elements_asked_for(parameters) == standard + 40);
    parameters.domain.radius = 1e4;
    CHECK(elements_asked_for(parameters) == most_elements);
    parameters.domain.radius = 80;
    parameters.boundary_integral.mesh_edge_length = 0;  // an edge without elements of its own needs more of them
    CHECK(initial_elements(parameters) > elements_asked_for(parameters));
    parameters.boundary_integral.elements = 24;
    CHECK(initial_elements(parameters) == 24);
}

TEST_CASE("a patch narrower than its edge gets elements for its shape, not for the kink on the axis", "[resolution]") {
    Parameters parameters;
    parameters.molecules.patch_radius = 2;  // nm; the edge is 3.4 nm wide: its slope at the axis is a kink there
    // The kink's estimate falls with h² alone: a hundredth of the accuracy would take 304 elements.
    CHECK(initial_elements(parameters) < 2 * elements_asked_for(parameters));
}

TEST_CASE("elements are added where the estimate asks for them, up to the most there may be", "[resolution]") {
    const MembraneSpace space(30, 8), most(most_elements, 4);
    const MembraneState rough = with_waves(space, 7.5);  // four elements a wave
    CHECK(elements_for(space, rough, 1e-3) == 40);
    CHECK(elements_for(space, with_waves(space, 0.5), 1e-3) == 30);
    const MembraneState smooth = with_waves(space, 0.5);
    CHECK(elements_for(space, smooth, 1e-3, 1e-4, 1e-3) == 30);
    CHECK(elements_for(space, smooth, 1e-3, 3e-4, 1e-3) ==
          40);  // more than a fifth of what the energy's balance may be
    CHECK(elements_for(most, with_waves(most, 80.0), 1e-6) == most_elements);
}
