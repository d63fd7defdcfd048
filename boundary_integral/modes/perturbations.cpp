#include "boundary_integral/modes/perturbations.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <functional>
#include <numbers>

#include "boundary_integral/evolution/observation.h"
#include "boundary_integral/flow/dense_solver.h"

namespace endoflow::boundary_integral {

PerturbationNorms perturbation_norms(const ModeSpace& space, const BasePoints& points) {
    const Eigen::MatrixXd mass = scalar_mass(space, points);
    const auto factor = [&mass](const Eigen::MatrixXd& expansion) -> Eigen::MatrixXd {
        return (expansion.transpose() * mass * expansion).llt().matrixU();
    };
    return {factor(space.displacement_expansion()), factor(space.scalar().expansion())};
}

double area_of(const MembraneSpace& space, const BasePoints& base) {
    double area = 0.0;
    for (std::size_t i = 0; i < base.points.size(); ++i) {
        area += 2.0 * std::numbers::pi * space.weight[i] * base.points[i].curve.r * base.points[i].curve.g;
    }
    return area;
}

LinearRate mesh_rate(const LinearisedMembrane& membrane, const ModeSpace& space, const ModeRates& rates,
                     const std::vector<double>& relative_velocity, double concentration_length) {
    std::vector<double> speed;
    for (const double v : relative_velocity) speed.push_back(-v);
    LinearRate rate;
    rate.matrix = rates.material + membrane.carrying(space.mode(), speed);
    const PerturbationNorms norms = perturbation_norms(space, membrane.points());
    rate.root = Eigen::MatrixXd::Zero(rate.matrix.rows(), rate.matrix.cols());
    rate.root.topLeftCorner(rates.displacements, rates.displacements) = norms.displacement;
    rate.root.bottomRightCorner(norms.concentration.rows(), norms.concentration.cols()) =
        concentration_length * norms.concentration;
    return rate;
}

Eigen::MatrixXd displacement_values(const ModeSpace& space, const std::vector<double>& xi) {
    return collocation_matrix(space.vertical(), xi) * space.displacement_expansion();
}

Eigen::MatrixXd concentration_values(const ModeSpace& space, const std::vector<double>& xi) {
    return collocation_matrix(space.vertical(), xi) * space.scalar().expansion();
}

std::vector<double> meridian_points(const MembraneSpace& space) {
    const Index count = shape_points_per_element * space.elements();
    std::vector<double> points;
    for (Index i = 0; i <= count; ++i) points.push_back(static_cast<double>(i) / static_cast<double>(count));
    return points;
}

namespace {

// Arc length from the axis.
class ArcLength {
  public:
    ArcLength(const MembraneSpace& membrane, const MembraneState& state)
        : membrane_(membrane), state_(state), rule_(gauss_legendre(8)) {
        for (Index e = 0; e < membrane.elements(); ++e) {
            const double begin = static_cast<double>(e) * membrane.element_width();
            before_.push_back(before_.back() + within(e, begin, begin + membrane.element_width()));
        }
    }

    [[nodiscard]] double operator()(double xi) const {
        const Index element = membrane_.radial().element_of(xi);
        return before_[static_cast<std::size_t>(element)] +
               within(element, static_cast<double>(element) * membrane_.element_width(), xi);
    }
    [[nodiscard]] double total() const { return before_.back(); }

  private:
    const MembraneSpace& membrane_;
    const MembraneState& state_;
    QuadratureRule rule_;
    std::vector<double> before_ = {0.0};

    [[nodiscard]] double within(Index element, double begin, double end) const {
        double length = 0.0;
        for (std::size_t i = 0; i < rule_.nodes.size(); ++i) {
            const double xi = 0.5 * (begin + end + (end - begin) * rule_.nodes[i]);
            const CurvePoint p =
                curve_point(membrane_.radial().basis(xi, element), membrane_.axial().basis(xi, element), state_);
            length += 0.5 * (end - begin) * rule_.weights[i] * p.g;
        }
        return length;
    }
};

// Free coefficients of the scalar space through values at its points.
Eigen::VectorXd interpolated(const ModeSpace& space, const std::function<double(double xi)>& function) {
    const std::vector<double>& points = space.scalar().points();
    Eigen::VectorXd values(static_cast<Index>(points.size()));
    for (std::size_t i = 0; i < points.size(); ++i) values[static_cast<Index>(i)] = function(points[i]);
    return LuFactors(concentration_values(space, points), "interpolation").solve(values);
}

}  // namespace

std::vector<InitialShape> initial_shapes(const ModeSpace& space, const MembraneState& state, double coat_radius,
                                         double amplitude) {
    const MembraneSpace& membrane = space.membrane();
    const ArcLength arc_length(membrane, state);
    const double length = arc_length.total();
    const Index displacements = space.displacement_count(), all = displacements + space.scalar().dimension();
    const Eigen::MatrixXd values = displacement_values(space, meridian_points(membrane));
    const auto power = [mode = space.mode()](double x) { return mode == 0 ? 1.0 : std::pow(x, mode); };
    const auto clamped = [&](double s) { return space.clamped() ? std::pow(1.0 - s * s / (length * length), 2) : 1.0; };
    const auto displaced = [&](const char* name, const std::function<double(double s)>& profile) {
        Eigen::VectorXd w = interpolated(space, [&](double xi) { return profile(arc_length(xi)); }).head(displacements);
        w *= amplitude / (values * w).cwiseAbs().maxCoeff();
        Eigen::VectorXd y = Eigen::VectorXd::Zero(all);
        y.head(displacements) = w;
        return InitialShape{name, y};
    };
    const auto hump = [&](double place) {
        return [&power, &clamped, place, width = std::max(1, space.mode())](double s) {
            return power(s / place) * std::exp(-0.5 * width * s * s / (place * place)) * clamped(s);
        };
    };
    const auto sheet = [&](double s) {
        return space.clamped() ? power(s / length) * clamped(s) : power(std::sin(std::numbers::pi * s / length));
    };
    InitialShape coat{"coat", Eigen::VectorXd::Zero(all)};
    coat.y.tail(space.scalar().dimension()) = interpolated(space, [&](double xi) {
        const BasisRow axial = membrane.axial().basis(xi);
        return -amplitude * axial.evaluate(state.c, 1) / curve_point(membrane.radial().basis(xi), axial, state).g;
    });
    return {displaced("dome", hump(0.5 * coat_radius)), displaced("edge", hump(coat_radius)), displaced("sheet", sheet),
            coat};
}

}  // namespace endoflow::boundary_integral
