#include "boundary_integral/modes/perturbation_growth.h"

#include <Eigen/SVD>
#include <cmath>
#include <numbers>
#include <utility>

#include "boundary_integral/support/parallel.h"

namespace endoflow::boundary_integral {

PerturbationGrowth::PerturbationGrowth(const AlongRun& run, double tolerance)
    : run_(run),
      moment_(run.moment(0.0, run.first_mode())),
      points_(meridian_points(run.dynamics().space())),
      propagation_([this](double time) { return rates(time); }, 0.0, starts(), first_propagation_step, tolerance,
                   thread_count(run.parameters().boundary_integral.threads)) {}

std::vector<LinearRate> PerturbationGrowth::rates(double time) {
    if (time != moment_.time) moment_ = run_.moment(time, run_.first_mode());
    return run_.mesh_rates(moment_);
}

std::vector<Eigen::MatrixXd> PerturbationGrowth::starts() {
    const BasePoints& points = moment_.membrane->points();
    std::vector<Eigen::MatrixXd> result;
    for (int mode = run_.first_mode(); mode <= run_.last_mode(); ++mode) {
        const ModeSpace& space = run_.surroundings().space(mode);
        Start start{perturbation_norms(space, points),
                    area_of(run_.dynamics().space(), points),
                    initial_shapes(space, moment_.evaluation.state, run_.parameters().molecules.patch_radius,
                                   initial_amplitude),
                    {}};
        const Index w = start.norms.displacement.rows(), c = start.norms.concentration.rows();
        start.basis = Eigen::MatrixXd::Zero(w + c, w + c);
        start.basis.topLeftCorner(w, w) =
            start.norms.displacement.triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(w, w));
        start.basis.bottomRightCorner(c, c) =
            start.norms.concentration.triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(c, c));
        result.push_back(start.basis);
        start_.push_back(std::move(start));
    }
    return result;
}

Perturbation PerturbationGrowth::measured(int mode, std::string name, Eigen::VectorXd y, const PerturbationNorms& norms,
                                          double area) const {
    const Eigen::VectorXd w = y.head(norms.displacement.rows());
    Perturbation result;
    result.initial = std::move(name);
    result.peak = (displacement_values(run_.surroundings().space(mode), points_) * w).cwiseAbs().maxCoeff();
    result.rms = (norms.displacement * w).norm() * std::sqrt(std::numbers::pi / area);
    result.y = std::move(y);
    return result;
}

// The right singular vector of the displacements' block of the propagator: unit components along the basis.
Eigen::VectorXd PerturbationGrowth::worst_direction(int mode, const PerturbationNorms& now) const {
    const Eigen::MatrixXd& value = propagation_.values()[index(mode)];
    const Index w = now.displacement.rows();
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(now.displacement * value.topLeftCorner(w, w), Eigen::ComputeFullV);
    Eigen::VectorXd direction = Eigen::VectorXd::Zero(value.cols());
    direction.head(w) = svd.matrixV().col(0);
    return direction;
}

Perturbation PerturbationGrowth::worst_at_start(int mode) const {
    const Start& start = start_[index(mode)];
    const PerturbationNorms now = perturbation_norms(run_.surroundings().space(mode), moment_.membrane->points());
    Perturbation worst = measured(mode, "worst", start.basis * worst_direction(mode, now), start.norms, start.area);
    const Eigen::VectorXd values =
        displacement_values(run_.surroundings().space(mode), points_) * worst.y.head(start.norms.displacement.rows());
    const double highest = values.maxCoeff(), lowest = values.minCoeff();
    const double scale = (highest > -lowest ? initial_amplitude : -initial_amplitude) / worst.peak;
    worst.y *= scale;
    worst.peak = initial_amplitude;
    worst.rms *= std::abs(scale);
    worst.gain = 1.0;
    return worst;
}

std::vector<Perturbation> PerturbationGrowth::perturbations(int mode) const {
    const Start& start = start_[index(mode)];
    const BasePoints& points = moment_.membrane->points();
    const PerturbationNorms now = perturbation_norms(run_.surroundings().space(mode), points);
    const double area = area_of(run_.dynamics().space(), points);
    std::vector<InitialShape> shapes = start.shapes;
    shapes.push_back({"worst", worst_at_start(mode).y});
    std::vector<Perturbation> result;
    for (const InitialShape& shape : shapes) {
        const Perturbation before = measured(mode, shape.name, shape.y, start.norms, start.area);
        Eigen::VectorXd along(shape.y.size());  // the basis is the inverse of the norms
        along << start.norms.displacement * shape.y.head(start.norms.displacement.rows()),
            start.norms.concentration * shape.y.tail(start.norms.concentration.rows());
        Perturbation after = measured(mode, shape.name, propagation_.values()[index(mode)] * along, now, area);
        if (before.rms > 0.0) {
            after.gain = after.rms / before.rms * std::sqrt(area / start.area);
        }
        result.push_back(std::move(after));
    }
    return result;
}

}  // namespace endoflow::boundary_integral
