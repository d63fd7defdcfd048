// The coupled equations of a step converge with the order of their elements to a solution that is known.

#include <deal.II/base/quadrature_lib.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <utility>

#include "one_step.h"
#include "phasefield/fem/component_field.h"

using namespace endoflow;
using namespace endoflow::phasefield;
using namespace endoflow::phasefield::production;

namespace {

constexpr double domain_width = 40;  // nm

/// a + b cos(πr/L) cos(πz/L + phase), even in r, or the same times r.
std::array<double, 3> wave(double a, double b, double phase, bool odd, double r, double z) {
    constexpr double k = 3.14159265358979323846 / domain_width;
    const double cr = std::cos(k * r), sr = -k * std::sin(k * r), cz = std::cos(k * z + phase),
                 sz = -k * std::sin(k * z + phase);
    const double value = a + b * cr * cz, dr = b * sr * cz, dz = b * cr * sz;
    if (!odd) return {value, dr, dz};
    return {r * value, value + r * dr, r * dz};
}

/// A bent membrane |∇ψ| = 0.8 … 1.2 in the middle of the domain, all other fields of the size they have in a run, the
/// pressure times a factor.
PointValues solution(double r, double z, double pressures = 1) {
    PointValues x;
    x[velocity_r] = wave(0, 4, 0.3, true, r, z);
    x[velocity_z] = wave(20, 90, 0.8, false, r, z);
    x[Field::pressure] = wave(pressures * 0.01, pressures * 0.03, 0.1, false, r, z);
    x[pressure_layer] = wave(0, 0.02, 0.5, false, r, z);
    x[Field::tension] = wave(0.05, 0.1, 0.9, false, r, z);
    x[distance] = wave(0.5 * domain_width - z, 3, 0.4, false, r, z);
    x[distance][2] -= 1;
    x[normal_force] = wave(0.01, 0.02, 1.1, false, r, z);
    x[Field::moment] = wave(30, 15, 0.7, false, r, z);
    x[molecule_density] = wave(0.5, 0.3, 0.2, false, r, z);
    x[molecule_potential] = wave(0, 0.2, 0.6, false, r, z);
    x[membrane_stretch] = wave(1, 0.05, 1, false, r, z);
    return x;
}

Parameters on_squares(unsigned int cells) {
    Parameters p;
    p.domain.radius = p.domain.height = domain_width;
    p.domain.membrane_height = 0.5 * domain_width;
    p.phase_field.epsilon = 4.8;
    p.phase_field.cell_size = domain_width / cells;
    p.phase_field.far_refinements = 0;
    return p;
}

/// The step whose solution is known, on cells × cells squares.
struct KnownStep {
    explicit KnownStep(unsigned int cells, double pressure_factor = 1)
        : pressures(pressure_factor),
          parameters(on_squares(cells)),
          one(parameters),
          numbers(step_numbers(parameters, 2000, 1000)),
          past{known()},
          history(one.space, numbers, past, {-2000}, {1}, past.front()) {
        history.manufactured = [pressure_factor](double r, double z) { return solution(r, z, pressure_factor); };
    }

    /// Interpolated.
    [[nodiscard]] Vector known() const {
        Vector x = one.space.vector();
        for (unsigned int f = 0; f < n_fields; ++f)
            interpolate(
                one.space, f, [&](double r, double z) { return solution(r, z, pressures)[f][0]; }, x);
        finish_interpolation(one.space, x);
        return x;
    }

    /// From the interpolated one.
    Vector solve() {
        Vector x = known();
        one.solver.solve({one.space, one.energy, numbers, history}, x, 1e-9);
        return x;
    }

    double pressures;
    Parameters parameters;
    OneStep one;
    StepNumbers numbers;
    std::vector<Vector> past;
    StepPast history;
};

/// L2 errors of all fields.
std::array<double, n_fields> errors(KnownStep&& step) {
    const Vector x = step.solve();
    const Parameters& p = step.parameters;
    const Space& space = step.one.space;
    std::array<double, n_fields> out{};
    const dealii::QGauss<2> quadrature(gauss_points(p.phase_field));
    for (unsigned int f = 0; f < n_fields; ++f) {
        ComponentField field(space, f, quadrature);
        double square = 0;
        for (const auto& cell : space.dofs.active_cell_iterators()) {
            const CellBox box = cell_box(cell);
            const auto& found = field.on(cell, box, x);
            for (unsigned int q = 0; q < quadrature.size(); ++q) {
                const double r = box.r0 + box.hr * quadrature.point(q)[0], z = box.z0 + box.hz * quadrature.point(q)[1];
                const double psi = solution(r, z)[distance][0];
                const double delta = layer_profile(psi, p.phase_field.epsilon).delta;
                square += quadrature.weight(q) * box.hr * box.hz * r * delta *
                          std::pow(found.value[q] - solution(r, z, step.pressures)[f][0], 2);
            }
        }
        out[f] = std::sqrt(square);
    }
    return out;
}

}  // namespace

TEST_CASE("old factors that lead to what is no number are made anew", "[newton]") {
    KnownStep step(6);
    const Vector expected = step.solve();
    bool once = true;
    step.history.manufactured = [&once](double r, double z) {
        PointValues values = solution(r, z);
        if (std::exchange(once, false)) values[distance][0] = std::numeric_limits<double>::quiet_NaN();
        return values;
    };
    const unsigned int before = step.one.solver.factors().made();
    Vector found = step.solve();
    CHECK(step.one.solver.factors().made() == before + 1);
    found -= expected;
    CHECK(found.linfty_norm() < 1e-6 * expected.linfty_norm());  // changes of ψ below 1e-9 end Newton's method
}

TEST_CASE("the coupled equations converge to a manufactured solution", "[manufactured]") {
    // Degree + 1 for ψ, c, μ, s (degree 3) and p, q, λ (degree 2). G and b, from a fourth-order operator in mixed form,
    // lose up to two orders, as Ciarlet and Raviart's method does, and the velocity (degree 3), which G drives, one.
    // Measured from 24 to 48 cells of a side; from 12 to 24, where the layer is two cells wide, s has 2.8:
    //   u_r 2.98, u_z 3.59; p 4.5, q 3.9, λ 4.5; ψ 4.08; G 1.74, b 3.17; c 4.03, μ 3.98, s 4.14
    constexpr std::array<double, n_fields> least{2.8, 3.4, 3.5, 3.5, 3.5, 3.9, 1.6, 3.0, 3.8, 3.8, 3.8};
    const auto coarse = errors(KnownStep(24)), fine = errors(KnownStep(48));
    for (unsigned int f = 0; f < n_fields; ++f) {
        CAPTURE(f, coarse[f], fine[f]);
        CHECK(std::log2(coarse[f] / fine[f]) > least[f]);
    }
}

TEST_CASE("the penalty of ∇·u keeps what flow pressures drive within cells", "[manufactured]") {
    // Pressures of 40 pN/nm², as static forces of a membrane that hardly moves have them. For one like |p| h² the error
    // of u goes down as 1/√(1 + penalty), at best as 1/(1 + penalty).
    const auto velocity_error = [](double penalty) {
        KnownStep step(12, 1000);
        step.numbers.divergence_penalty = penalty;
        const auto all = errors(std::move(step));
        return std::hypot(all[velocity_r], all[velocity_z]);
    };
    const double without = velocity_error(0), with = velocity_error(30);
    CAPTURE(without, with);
    CHECK(with < without / 5);
}
