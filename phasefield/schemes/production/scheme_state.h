#pragma once

#include <memory>
#include <vector>

#include "phasefield/contour/layer_thickness.h"
#include "phasefield/fem/space.h"
#include "phasefield/schemes/interface/diagnostics.h"
#include "phasefield/schemes/production/step_control.h"
#include "phasefield/schemes/production/step_numbers.h"
#include "shared/geometry/membrane_curve.h"

namespace endoflow::phasefield::production {

/// What a run has reached; a run that is continued goes on from it.
struct SchemeState {
    std::vector<Vector> solutions;                   // newest first, with ghost values
    std::vector<double> times;                       // of them [µs]
    std::vector<double> masses;                      // ∫ c dA of them [nm²]
    std::shared_ptr<const CellThickness> thickness;  // of the layer in the last step; none: uniform
    double next_step = 0;                            // [µs]
    double speed = 0;                                // of the membrane in the last step [nm/µs]
    double moved = 0;        // of the layer, since the mesh was made: in units of ε, times phase_field.epsilon [nm]
    unsigned int steps = 0;  // since the start or the last kink of the motion

    // Of the newest solution, measured again when it is loaded.
    LayerIntegrals integrals{};
    MembraneCurve membrane;

    /// All but the vectors; `curve` is what the thickness is made from.
    template <class Archive>
    void serialize(Archive&& archive, ThicknessCurve& curve) {
        archive("solution_times", times);
        archive("solution_masses", masses);
        archive("next_step", next_step);
        archive("speed", speed);
        archive("moved", moved);
        archive("steps_since_start", steps);
        curve.serialize(archive);
    }

    [[nodiscard]] std::size_t order() const { return std::min(highest_order, times.size()); }
};

/// A step that was tried.
struct Trial {
    StepNumbers numbers;
    std::vector<Vector> before;  // the solutions, with the molecules that they had at this step's thickness
    Vector solution;
    LayerIntegrals integrals{};
    double layer_motion = 0;  // [nm]
    TriedStep tried;
};

}  // namespace endoflow::phasefield::production
