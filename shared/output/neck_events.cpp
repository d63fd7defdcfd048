#include "shared/output/neck_events.h"

#include "shared/geometry/meridian.h"
#include "shared/numerics/level_crossing.h"

namespace endoflow {

std::vector<NeckEvent> NeckEvents::within(double begin, double end, const std::function<double(double time)>& radius) {
    std::vector<NeckEvent> events;
    if (!budded_) {
        if (const auto time = falls_below(radius, begin, end, budding_neck_radius)) {
            budded_ = true;
            events.push_back({"budding", *time, {}});
            if (stop_at_budding_) {
                events.back().ends_run = ExitReason::budded;
                return events;
            }
        }
    }
    if (const auto time = falls_below(radius, begin, end, closed_radius_))
        events.push_back({"neck_closed", *time, ExitReason::neck_closed});
    return events;
}

}  // namespace endoflow
