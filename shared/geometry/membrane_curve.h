#pragma once

#include <vector>

namespace endoflow {

/// The membrane's meridian, sampled from the axis (r = 0) to the rim, or of a vesicle from its upper pole to the lower,
/// where r is 0 again; all vectors have the same length.
/// The normal n = (−z', r') points out of the extracellular fluid into the cell, κ = div n > 0 on a bud.
struct MembraneCurve {
    std::vector<double> s;       // arc length from the axis, nm
    std::vector<double> r;       // distance from the axis, nm
    std::vector<double> z;       // height, nm
    std::vector<double> c;       // concentration of molecules, 0…1
    std::vector<double> lambda;  // tension of the sharp model, pN/nm
    std::vector<double> kappa;   // total curvature, 1/nm
    std::vector<double> u_r;     // velocity of the material, nm/µs
    std::vector<double> u_z;

    [[nodiscard]] std::size_t size() const { return r.size(); }
    [[nodiscard]] bool closed() const { return !r.empty() && r.back() == 0; }
};

}  // namespace endoflow
