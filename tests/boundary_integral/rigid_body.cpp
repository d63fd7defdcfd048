#include "rigid_body.h"

#include <cmath>
#include <numbers>

#include "boundary_integral/flow/dense_solver.h"
#include "curves.h"

namespace endoflow::boundary_integral::testing {

namespace {

using std::numbers::pi;

struct Cap {
    MembraneState state;
    MembraneSamples samples;
    double outward;  // sign of the outward normal relative to the membrane's own
};

Cap cap_of(const MembraneSpace& space, const SpheroidalBody& body, double direction) {
    Cap cap;
    cap.state = state_of(
        space, [&](double x) { return body.equatorial_radius * std::sin(0.5 * pi * x); },
        [&](double x) { return body.centre + direction * body.polar_radius * std::cos(0.5 * pi * x); },
        [](double) { return 0.0; });
    cap.samples = sample(space, cap.state);
    cap.outward = direction;
    return cap;
}

// One ring where one component of the velocity is prescribed.
struct Condition {
    std::size_t cap;
    double xi;
    CurvePoint point;
    TargetRows rows;  // exactly one of the two is set
};

std::vector<Condition> conditions(const MembraneSpace& space, const std::vector<Cap>& caps) {
    std::vector<Condition> list;
    Index row = 0;
    for (std::size_t k = 0; k < caps.size(); ++k) {
        const auto add = [&](double xi, bool radial) {
            const CurvePoint p = curve_point(space.radial().basis(xi), space.axial().basis(xi), caps[k].state);
            list.push_back({k, xi, p, radial ? TargetRows{row, -1} : TargetRows{-1, row}});
            ++row;
        };
        for (const double xi : space.radial_targets) add(xi, true);
        for (const double xi : space.axial_targets) add(xi, false);
    }
    return list;
}

// Adds weight(row kind) times the single layer of one cap, seen from the given places.
void add_layer(const MembraneSpace& space, const std::vector<Cap>& caps, std::size_t source,
               const std::vector<Condition>& targets, bool mirrored, double radial_sign, double axial_sign,
               Eigen::MatrixXd& matrix) {
    std::vector<LayerTarget> places;
    for (const Condition& target : targets) {
        const double z = mirrored ? -target.point.z : target.point.z;
        places.push_back({{target.point.r, z}, target.rows, !mirrored && target.cap == source ? target.xi : -1});
    }
    const MembraneLayers layers =
        membrane_layers(space, caps[source].state, caps[source].samples, places, matrix.rows(), {});
    const Index first = static_cast<Index>(source) * space.force_count();
    for (const Condition& target : targets) {
        const bool radial = target.rows.radial >= 0;
        const Index row = radial ? target.rows.radial : target.rows.axial;
        matrix.row(row).segment(first, space.force_count()) +=
            (radial ? radial_sign : axial_sign) * layers.single.row(row);
    }
}

// The images' part of the layer, by the trapezoidal rule in the angle: the integrand is analytic in it, and 96 points
// reach round-off for gaps above a tenth of the radius.
void add_wall_images(const MembraneSpace& space, const std::vector<Cap>& caps, std::size_t source,
                     const std::vector<Condition>& targets, Eigen::MatrixXd& matrix) {
    constexpr int angles = 96;
    const Index first = static_cast<Index>(source) * space.force_count();
    for (const Condition& target : targets) {
        const bool radial = target.rows.radial >= 0;
        const Index row = radial ? target.rows.radial : target.rows.axial;
        const Vector x = {target.point.r, 0, target.point.z};
        const std::size_t component = radial ? 0 : 2;
        for (std::size_t i = 0; i < space.xi.size(); ++i) {
            const CurvePoint& p = caps[source].samples.curve[i];
            double by_r = 0, by_z = 0;
            for (int k = 0; k < angles; ++k) {
                const double phi = 2 * pi * k / angles;
                const auto image = image_stokeslet(x, {p.r * std::cos(phi), p.r * std::sin(phi), p.z});
                by_r += image[component][0] * std::cos(phi) + image[component][1] * std::sin(phi);
                by_z += image[component][2];
            }
            const double measure = space.weight[i] * p.r * p.g * 2 * pi / angles;
            for (std::size_t j = 0; j < 6; ++j) {
                matrix(row, first + space.radial_rows[i].index[j]) += measure * by_r * space.radial_rows[i].value[0][j];
                matrix(row, first + space.radial_count() + space.force_rows[i].index[j]) +=
                    measure * by_z * space.force_rows[i].value[0][j];
            }
        }
    }
}

// int w.f dS/(2 pi) over one cap as a row vector acting on f, for a vector field w given through the curve's point.
Eigen::RowVectorXd moment(const MembraneSpace& space, const Cap& cap,
                          const std::function<std::pair<double, double>(const CurvePoint&)>& field) {
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(space.force_count());
    for (std::size_t i = 0; i < space.xi.size(); ++i) {
        const CurvePoint& p = cap.samples.curve[i];
        const auto [w_r, w_z] = field(p);
        const double measure = space.weight[i] * p.r * p.g;
        for (std::size_t j = 0; j < 6; ++j) {
            row[space.radial_rows[i].index[j]] += measure * w_r * space.radial_rows[i].value[0][j];
            row[space.radial_count() + space.force_rows[i].index[j]] += measure * w_z * space.force_rows[i].value[0][j];
        }
    }
    return row;
}

}  // namespace

std::array<Vector, 3> image_stokeslet(const Vector& x, const Vector& y) {
    const double h = y[2];
    const Vector d = {x[0] - y[0], x[1] - y[1], x[2] + h};
    const double inverse = 1 / std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    const double cubed = inverse * inverse * inverse, fifth = cubed * inverse * inverse;
    const auto delta = [](std::size_t i, std::size_t j) { return i == j ? 1.0 : 0.0; };
    std::array<Vector, 3> image{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            const double dipole = delta(i, j) * cubed - 3 * d[i] * d[j] * fifth;  // d/dR_j of R_i/R^3
            const double doublet = (delta(i, j) * d[2] + d[i] * delta(j, 2) - delta(i, 2) * d[j]) * cubed -
                                   3 * d[i] * d[2] * d[j] * fifth;  // d/dR_j of the Stokeslet's column 3
            image[i][j] =
                -(delta(i, j) * inverse + d[i] * d[j] * cubed) + (j == 2 ? -1 : 1) * 2 * h * (h * dipole - doublet);
        }
    }
    return image;
}

double drag_factor(const SpheroidalBody& body, Surroundings surroundings, Index elements) {
    const MembraneSpace space(elements, 8);
    const std::vector<Cap> caps = {cap_of(space, body, 1), cap_of(space, body, -1)};
    const std::vector<Condition> targets = conditions(space, caps);
    const Index unknowns = 2 * space.force_count();
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(unknowns, unknowns);
    Eigen::RowVectorXd total_force(unknowns), normal_moment(unknowns);
    for (std::size_t k = 0; k < caps.size(); ++k) {
        add_layer(space, caps, k, targets, false, 1, 1, matrix);
        // f(Mx) = s M f(x) with M the reflection: s = -1 for equal velocities, +1 for opposite ones.
        if (surroundings == Surroundings::twin_moving_along) add_layer(space, caps, k, targets, true, -1, 1, matrix);
        if (surroundings == Surroundings::twin_moving_opposite) add_layer(space, caps, k, targets, true, 1, -1, matrix);
        if (surroundings == Surroundings::wall) add_wall_images(space, caps, k, targets, matrix);
        const Index first = static_cast<Index>(k) * space.force_count();
        total_force.segment(first, space.force_count()) =
            moment(space, caps[k], [](const CurvePoint&) { return std::pair(0.0, 1.0); });
        normal_moment.segment(first, space.force_count()) = moment(space, caps[k], [&](const CurvePoint& p) {
            return std::pair(caps[k].outward * p.normal_r, caps[k].outward * p.normal_z);
        });
    }
    // f = n causes no flow. Adding n int f.n dS selects the solution without it and changes nothing else, because S is
    // symmetric and n carries no net flux of U.
    Eigen::VectorXd velocity = Eigen::VectorXd::Zero(unknowns);
    for (const Condition& target : targets) {
        const double outward = caps[target.cap].outward;
        if (target.rows.radial >= 0) {
            matrix.row(target.rows.radial) += outward * target.point.normal_r * normal_moment;
        } else {
            matrix.row(target.rows.axial) += outward * target.point.normal_z * normal_moment;
            velocity[target.rows.axial] = 8 * pi;  // mu = U = 1
        }
    }
    const Eigen::VectorXd force = LuFactors(matrix, "rigid body").solve(velocity);
    return 2 * pi * total_force.dot(force) / (6 * pi * body.equatorial_radius);
}

}  // namespace endoflow::boundary_integral::testing
