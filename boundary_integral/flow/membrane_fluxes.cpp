#include "boundary_integral/flow/membrane_fluxes.h"

#include <cmath>

namespace endoflow::boundary_integral {

MembraneFluxes membrane_fluxes(const MembraneSpace& space, const MembraneSamples& samples, const FlowSolution& flow) {
    MembraneFluxes fluxes;
    const Index radial = space.radial_count();
    const Eigen::VectorXd f_z = flow.force.tail(space.force().dimension());
    const Eigen::VectorXd u_r = flow.velocity.head(radial), u_z = flow.velocity.tail(space.axial_count());
    for (std::size_t i = 0; i < space.xi.size(); ++i) {
        const CurvePoint& p = samples.curve[i];
        const double area = space.weight[i] * p.r * p.g;
        const double force_z = space.force_rows[i].evaluate(f_z);
        const double speed_r = space.radial_rows[i].evaluate(u_r), speed_z = space.axial_rows[i].evaluate(u_z);
        const double normal_flux = area * (speed_r * p.normal_r + speed_z * p.normal_z);
        fluxes.force += area * force_z;
        fluxes.force_modulus += area * std::abs(force_z);
        fluxes.volume += normal_flux;
        fluxes.volume_modulus += std::abs(normal_flux);
        fluxes.area_modulus += std::abs(p.total_curvature() * normal_flux);
        fluxes.area_growth +=
            space.weight[i] *
            (speed_r * p.g +
             p.r / p.g * (p.r1 * space.radial_rows[i].evaluate(u_r, 1) + p.z1 * space.axial_rows[i].evaluate(u_z, 1)));
    }
    return fluxes;
}

}  // namespace endoflow::boundary_integral
