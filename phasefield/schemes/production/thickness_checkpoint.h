#pragma once

#include <memory>
#include <string>

#include "phasefield/schemes/production/layer_thickness.h"
#include "shared/output/checkpoint.h"

namespace endoflow::phasefield::production {

/// The curve of a step's thickness under `name`; empty where the layer is uniform.
inline void save_thickness(const std::shared_ptr<const CellThickness>& thickness, const std::string& name,
                           Checkpoint& checkpoint) {
    const ThicknessCurve curve = thickness ? thickness->curve() : ThicknessCurve();
    checkpoint.arrays[name + "_r"] = curve.r;
    checkpoint.arrays[name + "_z"] = curve.z;
    checkpoint.arrays[name + "_epsilon"] = curve.epsilon;
}

inline ThicknessCurve load_thickness(const Checkpoint& checkpoint, const std::string& name) {
    ThicknessCurve curve;
    curve.r = checkpoint.array(name + "_r");
    curve.z = checkpoint.array(name + "_z");
    curve.epsilon = checkpoint.array(name + "_epsilon");
    return curve;
}

}  // namespace endoflow::phasefield::production
