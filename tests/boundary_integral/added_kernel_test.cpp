// The recipe "A kernel or a surface of the sharp engine" of docs/extending.md, carried out: a kernel set that the
// engine does not have, Laplace's, is one class, and the builder makes its layers on the membrane's surface. On a unit
// sphere they multiply the harmonic z by 4π/3 (single layer) and −2π/3 (double layer, principal value), at a point
// inside it by 4π/3 and −8π/3.

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "boundary_integral/operators/layer_matrices.h"
#include "boundary_integral/operators/membrane_surface.h"
#include "curves.h"

namespace {

using namespace endoflow;
using namespace endoflow::boundary_integral;
using namespace endoflow::boundary_integral::testing;

using std::numbers::pi;

/// ∫ dφ / ρ and ∫ ∂(1/ρ)/∂n dφ, as kernels of the axial component.
class LaplaceKernels {
  public:
    std::span<const RingKernels> operator()(double target_radius, const RingSources& sources) {
        kernels_.resize(sources.size());
        for (std::size_t i = 0; i < sources.size(); ++i) {
            const double near = std::pow(sources.delta_r[i], 2) + std::pow(sources.delta_z[i], 2);
            const double far = near + 4 * sources.radius[i] * target_radius;
            const EllipticIntegrals integrals = elliptic_integrals(near / far);
            // n.x = n.(source - target) in the meridian plane + 2 n_r r0 sin²(φ/2), φ the angle between them
            const double fixed = sources.normal_offset[i], turned = 2 * sources.normal_r[i] * target_radius;
            kernels_.single[1][1][i] = 4 * integrals.k / std::sqrt(far);
            kernels_.doubled[1][1][i] = -4 * (fixed * integrals.e / near + turned * integrals.d / far) / std::sqrt(far);
        }
        return {&kernels_, 1};
    }

  private:
    RingKernels kernels_;
};

}  // namespace

TEST_CASE("an added kernel set has its layers from the builder", "[layers][recipe]") {
    const MembraneSpace space(24, 8);
    const MembraneState sphere = state_of(
        space, [](double x) { return std::sin(pi * x); }, [](double x) { return std::cos(pi * x); },
        [](double) { return 0.0; });
    const MembraneSamples samples = sample(space, sphere);
    const MembraneSurface surface(space, sphere, samples, membrane_functions(space), {});
    const Target inside{0.3, 0.4};
    std::vector<LayerTarget> targets = {{inside, {-1, 0}}};
    for (const double xi : {0.02, 0.2, 0.5, 0.71, 0.97})
        targets.push_back({{std::sin(pi * xi), std::cos(pi * xi)}, {-1, static_cast<Index>(targets.size())}, xi});
    const auto rows = static_cast<Index>(targets.size());
    RowMatrix single = RowMatrix::Zero(rows, space.axial_count()), doubled = single;
    add_layers(surface, targets,
               {{{Layer::single, 1, axial_table, &single}, {Layer::doubled, 1, axial_table, &doubled}}}, 2,
               [] { return LaplaceKernels(); });
    const Eigen::VectorXd of_single = single * sphere.z, of_doubled = doubled * sphere.z;
    // Splines on 24 elements have the sphere to some 1e-9.
    CHECK(of_single[0] == Approx(4 * pi / 3 * inside.z).epsilon(1e-8));
    CHECK(of_doubled[0] == Approx(-8 * pi / 3 * inside.z).epsilon(1e-8));
    for (Index i = 1; i < rows; ++i) {
        CAPTURE(targets[static_cast<std::size_t>(i)].xi);
        CHECK(of_single[i] == Approx(4 * pi / 3 * targets[static_cast<std::size_t>(i)].at.z).margin(1e-7));
        CHECK(of_doubled[i] == Approx(-2 * pi / 3 * targets[static_cast<std::size_t>(i)].at.z).margin(1e-7));
    }
}
