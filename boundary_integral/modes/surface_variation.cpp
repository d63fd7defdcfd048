#include "boundary_integral/modes/surface_variation.h"

namespace endoflow::boundary_integral {

namespace {

using Vector = std::array<SurfaceJet, 3>;

Vector vector_at(std::size_t first, double r, double phi, double z) {
    return {SurfaceJet::variable(r, first), SurfaceJet::variable(phi, first + 1), SurfaceJet::variable(z, first + 2)};
}

SurfaceJet inner(const Vector& a, const Vector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// (cos, sin, cos) amplitudes from (sin, cos, sin) ones by d/dphi, and back.
struct Turned {
    double r, phi, z;
};

Turned derivative_of_even(double m, double r, double phi, double z) {
    return {-(m * r + phi), m * phi + r, -m * z};
}

Turned derivative_of_odd(double m, const Turned& v) {
    return {m * v.r - v.phi, v.r - m * v.phi, m * v.z};
}

}  // namespace

SurfaceAmplitudes surface_amplitudes(int mode, const Derivatives2& v_r, const Derivatives2& v_phi,
                                     const Derivatives2& v_z) {
    const double m = mode;
    const Turned turned = derivative_of_even(m, v_r.value, v_phi.value, v_z.value);
    const Turned slope = derivative_of_even(m, v_r.first, v_phi.first, v_z.first);
    const Turned twice = derivative_of_odd(m, turned);
    return {v_r.first,  v_phi.first, v_z.first, turned.r, turned.phi, turned.z,  v_r.second, v_phi.second,
            v_z.second, slope.r,     slope.phi, slope.z,  twice.r,    twice.phi, twice.z};
}

SurfaceAmplitudes concentration_amplitudes(int mode, const Derivatives2& c) {
    SurfaceAmplitudes result{};
    result[surface_concentration] = c.value;
    result[surface_concentration + 1] = c.first;
    result[surface_concentration + 2] = -mode * c.value;
    return result;
}

SurfaceDensities surface_densities(const CurvePoint& p, double c, double c_xi, const MembraneEnergy& energy) {
    const Vector x1 = vector_at(0, p.r1, 0.0, p.z1), x2 = vector_at(3, 0.0, p.r, 0.0);
    const Vector x11 = vector_at(6, p.r2, 0.0, p.z2), x12 = vector_at(9, 0.0, p.r1, 0.0);
    const Vector x22 = vector_at(12, -p.r, 0.0, 0.0);
    const SurfaceJet c0 = SurfaceJet::variable(c, surface_concentration);
    const SurfaceJet c1 = SurfaceJet::variable(c_xi, surface_concentration + 1);
    const SurfaceJet c2 = SurfaceJet::variable(0.0, surface_concentration + 2);
    const Vector normal = cross(x1, x2);
    const SurfaceJet square = inner(normal, normal), inverse = 1.0 / square;
    const SurfaceJet e = inner(x1, x1), f = inner(x1, x2), g = inner(x2, x2);
    SurfaceDensities result;
    result.area = sqrt(square);
    const SurfaceJet bend = g * inner(x11, normal) - 2.0 * (f * inner(x12, normal)) + e * inner(x22, normal);
    const SurfaceJet curvature = -(bend * inverse) / result.area;
    const SurfaceJet gradient = (g * c1 * c1 - 2.0 * (f * c1 * c2) + e * c2 * c2) * inverse;
    const LocalJet density = energy.density(curvature.value, c, gradient.value);
    result.per_area = compose(density, std::array<SurfaceJet, local::count>{curvature, c0, gradient});
    result.energy = result.per_area * result.area;
    result.curvature = curvature.partial;
    return result;
}

SurfaceAmplitudes hessian_times(const SurfaceJet& jet, const SurfaceAmplitudes& b) {
    SurfaceAmplitudes result{};
    for (std::size_t i = 0; i < surface_variables; ++i) result[i] = dot(jet.second[i], b);
    return result;
}

}  // namespace endoflow::boundary_integral
