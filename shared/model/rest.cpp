#include "shared/model/rest.h"

#include <algorithm>
#include <numbers>

#include "shared/model/time_scale.h"

namespace endoflow {

namespace {

constexpr double part_at_rest = 1e-7, part_of_largest = 1e-9;

}  // namespace

RestLevel rest_level(const Parameters& p) {
    RestLevel rest;
    const double rate = part_at_rest / structure_time(p);
    rest.energy = largest_stiffness(p.membrane);
    rest.length = length_of_structure(p);
    rest.power = rest.energy * rate;
    rest.force = part_at_rest * rest.energy / rest.length;
    rest.speed = rest.length * rate;
    rest.area = std::numbers::pi * p.molecules.interface_width * p.molecules.interface_width;
    return rest;
}

double rest_floor(double now, double largest_so_far, double level) {
    return std::max({now, part_of_largest * largest_so_far, level});
}

}  // namespace endoflow
