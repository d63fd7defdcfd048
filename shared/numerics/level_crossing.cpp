#include "shared/numerics/level_crossing.h"

#include <cmath>

#include "shared/numerics/root.h"

namespace endoflow {

std::optional<double> falls_below(const std::function<double(double time)>& quantity, double begin, double end,
                                  double level) {
    constexpr int halvings = 60, bits = 50;
    const auto excess = [&](double time) { return quantity(time) - level; };
    double above = begin, below = end;
    double excess_below = excess(below);
    if (excess_below > 0.0) return std::nullopt;
    double excess_above = excess(above);
    if (!(excess_above > 0.0)) return above;
    // Until both values are numbers; a quantity that is infinite down to the level has its jump bracketed.
    for (int i = 0; i < halvings && std::isinf(excess_above); ++i) {
        const double middle = 0.5 * (above + below), value = excess(middle);
        (value > 0.0 ? above : below) = middle;
        (value > 0.0 ? excess_above : excess_below) = value;
    }
    if (std::isinf(excess_above) || excess_below == 0.0) return below;
    return bracketed_root(excess, above, below, excess_above, excess_below, bits).second;
}

}  // namespace endoflow
