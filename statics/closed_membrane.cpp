#include "statics/closed_membrane.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace endoflow::statics {

using std::numbers::pi;

ClosedMembrane::ClosedMembrane(MembraneEnergy energy, double concentration, double membrane_area,
                               double enclosed_volume)
    : area(membrane_area), volume(enclosed_volume), energy_(std::move(energy)), concentration_(concentration) {
    const LocalJet at_rest = energy_.conjugate(0, concentration, 0);
    spontaneous_curvature = natural_curvature_ = at_rest.partial[local::moment];
    stiffness_ = 1 / at_rest.second[local::moment][local::moment];
}

double ClosedMembrane::sphere_radius() const {
    return std::sqrt(area / (4 * pi));
}

double ClosedMembrane::reduced_volume() const {
    return volume / (4 * pi / 3 * std::pow(sphere_radius(), 3));
}

ClosedMembrane with_reduced_volume(ClosedMembrane membrane, double reduced_volume) {
    membrane.volume = reduced_volume * 4 * pi / 3 * std::pow(membrane.sphere_radius(), 3);
    return membrane;
}

}  // namespace endoflow::statics
