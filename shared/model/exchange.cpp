#include "shared/model/exchange.h"

#include <cmath>
#include <numbers>

#include "shared/support/error.h"

namespace endoflow {

namespace {

/// What attaches is taken from a pool: 1 − m/m_pool of it is left.
struct Pool {
    double inverse;  // 1/m_pool, 1/nm²; 0: unlimited

    template <class Number>
    [[nodiscard]] Number left(const Number& mass) const {
        return 1.0 - inverse * mass;
    }
};

/// Langmuir: j = k_on (c_b/c_∞) (1 − m/m_pool) (1 − c) − k_off c exp(s a₀ (∂e/∂c)/(k_B T)).
struct ReservoirExchange {
    double on_rate, off_rate;  // 1/µs
    double sensing;            // s a₀/(k_B T), nm/pN
    Pool pool;

    template <class Number>
    [[nodiscard]] Number rate(const ExchangePoint<Number>& x) const {
        const double boost = std::exp(sensing * value_of(x.by_concentration));
        const Number leaving = chain(x.by_concentration, boost, sensing * boost, sensing * sensing * boost);
        return on_rate * (x.bulk * pool.left(x.mass) * (1.0 - x.concentration)) -
               off_rate * (x.concentration * leaving);
    }
};

/// j = v (c_b/c_∞) (1 − m/m_pool) √2 c (1 − c)/ε_c, which is v |∂_s c| on the equilibrium profile of (24), so that a
/// flat coat's radius grows at v; 0 where c < 0: where there are no molecules none are made, and c = 0 is unstable
/// under the law.
struct EdgeExchange {
    double speed_per_width;  // √2 v/ε_c, 1/µs
    Pool pool;

    template <class Number>
    [[nodiscard]] Number rate(const ExchangePoint<Number>& x) const {
        if (value_of(x.concentration) < 0) return Number(0.0);
        return speed_per_width * (x.bulk * pool.left(x.mass) * (x.concentration * (1.0 - x.concentration)));
    }
};

double sensing(const MoleculeParameters& molecules) {
    return molecules.curvature_sensing * molecules.molecule_area / molecules.thermal_energy;
}

}  // namespace

ExchangeLaw exchange_law(const MoleculeParameters& m) {
    const Pool pool{m.pool_area > 0 ? 1 / m.pool_area : 0};
    switch (m.exchange) {
        case Exchange::none:
            return {};
        case Exchange::reservoir:
            return ExchangeLaw(ReservoirExchange{m.on_rate, m.off_rate, sensing(m), pool});
        case Exchange::edge:
            return ExchangeLaw(EdgeExchange{std::numbers::sqrt2 * m.edge_speed / m.interface_width, pool});
    }
    throw InputError("molecules.exchange: not a law");
}

double detachment_exponent(const MoleculeParameters& molecules, double by_concentration) {
    return sensing(molecules) * by_concentration;
}

void require_no_exchange(const Parameters& parameters, const std::string& engine) {
    if (parameters.molecules.exchange == Exchange::none) return;
    throw InputError("molecules.exchange must be none: the " + engine + " engine does not have another one");
}

void require_no_bulk(const Parameters& parameters, const std::string& engine) {
    if (parameters.molecules.bulk == Bulk::none) return;
    throw InputError("molecules.bulk must be none: the " + engine + " engine does not have another one");
}

}  // namespace endoflow
