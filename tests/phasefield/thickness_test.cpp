// A layer whose thickness follows the membrane's curvature.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "one_step.h"
#include "phasefield/contour/layer_thickness.h"
#include "phasefield/schemes/production/point_equations.h"
#include "run_steps.h"
#include "shared/model/time_scale.h"
#include "small_case.h"

using namespace endoflow;
using namespace endoflow::phasefield;
using namespace endoflow::phasefield::production;

namespace {

constexpr double spacing = 0.3;  // of the points, as on a run's contour [nm]

/// A sphere of radius `bud` on a neck of radius `neck` that is bent with radius `bend` into a plane; the neck's
/// narrowest point is where the arc of the bend is vertical.
MembraneCurve bud_on_neck(double bud, double neck, double bend) {
    MembraneCurve curve;
    const auto add = [&](double r, double z) {
        curve.r.push_back(r);
        curve.z.push_back(z);
    };
    const auto arc = [&](double r0, double z0, double radius, double from, double to) {
        const int steps = static_cast<int>(std::ceil(radius * std::abs(to - from) / spacing));
        for (int i = 0; i < steps; ++i) {
            const double angle = from + (to - from) * i / steps;
            add(r0 + radius * std::sin(angle), z0 + radius * std::cos(angle));
        }
    };
    // The two circles touch: their centres are bud + bend apart.
    const double height = std::sqrt(std::pow(bud + bend, 2) - std::pow(neck + bend, 2));
    const double touch = std::numbers::pi - std::asin((neck + bend) / (bud + bend));
    arc(0, height, bud, 0, touch);
    arc(neck + bend, 0, bend, touch - std::numbers::pi, -std::numbers::pi);
    for (double r = neck + bend; r < 80; r += spacing) add(r, -bend);
    return curve;
}

}  // namespace

TEST_CASE("the layer is as thick as asked for where the membrane is flat, and nowhere without a radius",
          "[thickness]") {
    Parameters p;
    MembraneCurve flat;
    for (double r = 0; r <= 80; r += spacing) {
        flat.r.push_back(r);
        flat.z.push_back(80);
    }
    for (const double epsilon : thickness_along(flat, p))
        CHECK(epsilon == Approx(p.phase_field.epsilon).epsilon(1e-12));
    p.phase_field.production.thinning = 0;
    for (const double epsilon : thickness_along(bud_on_neck(20, 3, 4), p)) CHECK(epsilon == p.phase_field.epsilon);
}

TEST_CASE("far from the coat a flat layer is thicker, as far as the walls leave room", "[thickness]") {
    Parameters p;
    p.domain.radius = 400;
    p.domain.height = 800;
    p.domain.membrane_height = 400;
    MembraneCurve flat;
    for (double r = 0; r <= 400; r += 1) {
        flat.r.push_back(r);
        flat.z.push_back(400);
    }
    const double near = p.molecules.patch_radius + std::numbers::pi * length_of_structure(p),
                 slope = constant("thinning_slope");
    const auto thickness = thickness_along(flat, p);
    for (std::size_t i = 0; i < thickness.size(); ++i) {
        const double away = std::max(0.0, std::min(flat.r[i] - near, p.domain.radius - flat.r[i]));
        const double expected = p.phase_field.epsilon + slope * away;
        // The mean over 2 ε₀ of arc rounds the three bends, twice.
        CHECK(std::abs(thickness[i] - expected) <= slope * p.phase_field.epsilon);
    }
    CHECK(thickness.front() == Approx(p.phase_field.epsilon));
    CHECK(widest_layer(p, p.domain.radius) == p.phase_field.epsilon);
    const double middle = 0.5 * (near + p.domain.radius);
    CHECK(widest_layer(p, middle) == Approx(p.phase_field.epsilon + slope * (middle - near)));
    p.domain.membrane_height = 20;
    CHECK(widest_layer(p, middle) == Approx(20 / constant("room_needed")));
    p.domain.membrane_height = 400;
    p.molecules.exchange = Exchange::edge;
    CHECK(widest_layer(p, middle) == p.phase_field.epsilon);
}

TEST_CASE("the layer follows neck and bend", "[thickness]") {
    const Parameters p;
    const double widest = p.phase_field.epsilon, radius = p.phase_field.production.thinning * length_of_structure(p);
    const double bud = 20, neck = 3, bend = 6;
    const auto curve = bud_on_neck(bud, neck, bend);
    const auto thickness = thickness_along(curve, p);
    const auto narrowest =
        static_cast<std::size_t>(std::ranges::min_element(curve.r.begin() + 50, curve.r.end()) - curve.r.begin());
    // The mean over 2 ε₀ of arc, in which ε grows by the slope of 0.1 at most: 0.27 nm measured.
    CHECK(thickness[narrowest] >= widest * neck / radius);
    CHECK(thickness[narrowest] < widest * neck / radius + 0.5 * constant("thinning_slope") * widest);
    const ThicknessCurve along(curve, 0, p);
    const double at_tip = widest * std::pow(1 + 2 * std::pow(radius / bud, 8), -0.125);
    CHECK(along.at(0, curve.z.front()) == Approx(at_tip).epsilon(1e-3));  // chords for arcs: (ε/20)²/12
    // Half way round the bend, where the neck is (neck + bend − bend/√2) wide.
    const double half = bend / std::numbers::sqrt2, around = (neck + bend - half) * std::numbers::sqrt2;
    const double expected = std::pow(1 + std::pow(radius / bend, 8) + std::pow(radius / around, 8), -0.125);
    CHECK(along.at(neck + bend - half, -half) <= widest * expected * 1.1);  // the mean over 2 ε₀ of arc
    for (std::size_t i = 1; i < thickness.size(); ++i) {
        const double step = std::hypot(curve.r[i] - curve.r[i - 1], curve.z[i] - curve.z[i - 1]);
        CHECK(std::abs(thickness[i] - thickness[i - 1]) <= constant("thinning_slope") * step * (1 + 1e-12));
    }
    for (const double epsilon : thickness_along(bud_on_neck(20, 0.3, 4), p))
        CHECK(epsilon >= constant("thinnest") * widest);
}

TEST_CASE("the layer is thin where another part of the membrane is near", "[thickness]") {
    // Two planes at 4 nm, joined far out: circles of 2 nm fit between them.
    const Parameters p;
    MembraneCurve folded;
    const auto add = [&](double r, double z) {
        folded.r.push_back(r);
        folded.z.push_back(z);
    };
    for (double r = 0; r < 60; r += spacing) add(r, 84);
    for (double angle = 0; angle < std::numbers::pi; angle += spacing / 2)
        add(60 + 2 * std::sin(angle), 82 + 2 * std::cos(angle));
    for (double r = 60; r > 0; r -= spacing) add(r, 80);
    const double expected = 2 / constant("room_needed");
    CHECK(ThicknessCurve(folded, 0, p).at(20, 84) == Approx(expected).epsilon(0.02));  // (1.2/ε)⁻⁸/8 and spacing
}

TEST_CASE("a layer's thickness is that of the closest point of a smooth curve", "[thickness]") {
    // A half circle of radius 2 around (0, 5) that ends on the axis, with ε = 1 + cos(angle)/10. The normals of splines
    // through points h apart are off by h³, and what lies beside the curve finds another point: 1/8 with half the
    // spacing. The polyline sticks to its corners.
    const auto error = [](int points) {
        ThicknessCurve circle;
        for (int i = 0; i <= points; ++i) {
            const double angle = std::numbers::pi * i / points;
            circle.r.push_back(i == points ? 0 : 2 * std::sin(angle));
            circle.z.push_back(5 + 2 * std::cos(angle));
            circle.epsilon.push_back(1 + 0.1 * std::cos(angle));
        }
        double largest = 0;
        for (const double distance : {-0.7, 0.2, 1.5})
            for (double angle = 0.05; angle < 3.1; angle += 0.07) {
                const double radius = 2 + distance;
                const double there = circle.at(radius * std::sin(angle), 5 + radius * std::cos(angle));
                largest = std::max(largest, std::abs(there - 1 - 0.1 * std::cos(angle)));
            }
        return largest;
    };
    const double coarse = error(10), fine = error(20);
    CHECK(coarse < 1e-4);
    CHECK(std::log2(coarse / fine) > 2.8);  // measured 2.96
}

TEST_CASE("the layer's thickness is that of the membrane at a step's end", "[thickness][production]") {
    Parameters p = small_case();
    p.molecules.patch_radius = 10;             // bends more strongly
    p.phase_field.production.thinning = 1.42;  // 20 nm
    ProductionScheme scheme(p, MPI_COMM_SELF);
    MembraneCurve curve = scheme.start().contour.curve;
    double time = 0;
    for (int i = 0; i < 3; ++i) {
        const double tau = scheme.step(time, 1);
        const ThicknessCurve foreseen(curve, tau, p);
        curve = take_step(scheme, time, 1).contour.curve;
        for (std::size_t j = 0; j < curve.size(); ++j)
            CHECK(scheme.thickness_at(curve.r[j], curve.z[j]) == foreseen.at(curve.r[j], curve.z[j]));
    }
}

TEST_CASE("what flows along a layer that thins stays what it is", "[thickness]") {
    // A plane membrane at rest, the fluid moving along it: ∂(δ_Γ y)/∂t + ∇·(δ_Γ y v) of y = 1 vanishes though δ_Γ
    // changes along the flow. Central differences of terms of order one: measured 5e-6; along sheets of constant ψ
    // 0.05.
    const Parameters p;
    const StepNumbers step = step_numbers(p, 0, 0);
    const LayerEnergy energy(p);
    const double slope = 0.1, speed = 50, far = 100;
    const auto row = [&](double r, double z) {
        PointPast past;
        past.normal = past.molecules_normal = {0, -1};
        past.thickness = {0.8 + slope * (r - far), slope, 0};
        Fields<double> x;
        x[distance] = {-z, 0, -1};
        x[velocity_r].value = speed;
        x[membrane_stretch].value = 1;
        return point_equations(x, r, past, {}, step, energy)[membrane_stretch];
    };
    constexpr double h = 1e-4;
    for (const double z : {-1.5, -0.7, 0.2, 0.9, 1.6}) {
        const double along = (row(far + h, z).r - row(far - h, z).r) / (2 * h);
        const double across = (row(far, z + h).z - row(far, z - h).z) / (2 * h);
        CAPTURE(z, along, across);
        CHECK(along + across == Approx(0).margin(5e-5));
    }
    CHECK(std::abs((row(far + h, 0.2).r - row(far - h, 0.2).r) / (2 * h)) > 0.5);
}
