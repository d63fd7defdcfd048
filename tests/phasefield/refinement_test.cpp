// Where the production scheme's mesh is fine.

#include <catch2/catch.hpp>
#include <cmath>
#include <utility>

#include "phasefield/contour/layer_thickness.h"
#include "phasefield/schemes/production/refinement.h"

using namespace endoflow;
using namespace endoflow::phasefield;
using namespace endoflow::phasefield::production;

namespace {

constexpr double cell_size = 2;  // [nm]

/// A sphere's cap of 20 nm above a neck r = a cosh(z/a) that ends at r = 30 nm.
MembraneCurve bud_on_neck(double neck_radius) {
    MembraneCurve curve;
    for (double angle = 0; angle < 2; angle += 0.02) {
        curve.r.push_back(20 * std::sin(angle));
        curve.z.push_back(100 + 20 * std::cos(angle));
    }
    const double reach = std::acosh(30 / neck_radius);
    for (double s = 0.8 * reach; s > -reach; s -= 0.01) {
        curve.r.push_back(neck_radius * std::cosh(s));
        curve.z.push_back(60 + neck_radius * s);
    }
    curve.c.assign(curve.r.size(), 1);
    return curve;
}

Parameters with_cells() {
    Parameters p;
    p.phase_field.cell_size = cell_size;
    p.molecules.interface_width = 10;  // no finer cells for the patch's edge
    p.phase_field.production.thinning = 0;
    return p;
}

/// The size of the smallest cell that `bands` ask for at a point.
double wanted_size(const std::vector<RefinedBand>& bands, const Parameters& p, double r, double z) {
    unsigned int level = 0;
    for (const auto& band : bands)
        if (distance_from_band({r, z, 0, 0}, band) < 0) level = std::max(level, band.level);
    return cell_size * std::exp2(static_cast<double>(p.phase_field.far_refinements) - level);
}

}  // namespace

TEST_CASE("cells are a quarter of the neck's radius and no finer at the bud's tip", "[refinement]") {
    const Parameters p = with_cells();
    for (const double neck : {7.5, 5.0, 3.5, 2.1}) {
        const auto bands = refined_bands(bud_on_neck(neck), p);
        const double at_neck = wanted_size(bands, p, neck, 60);
        CHECK(at_neck <= 0.25 * neck);
        CHECK(at_neck > 0.125 * neck);  // halving stops there
        CHECK(wanted_size(bands, p, 0, 120) == cell_size);
        CHECK(wanted_size(bands, p, 20, 100) == cell_size);
    }
    CHECK(wanted_size(refined_bands(bud_on_neck(8.5), p), p, 8.5, 60) == cell_size);
    CHECK(wanted_size(refined_bands(bud_on_neck(1.0), p), p, 1, 60) == 0.25 * cell_size);
}

TEST_CASE("the pin band ends in cells of a tenth of its half width, unless nothing flows", "[refinement]") {
    Parameters p = with_cells();
    const double R = p.domain.radius, end = p.domain.membrane_height + p.domain.pin_half_width;
    CHECK(wanted_size(refined_bands(bud_on_neck(8), p), p, R, end) == cell_size / 4);  // 5/10 nm
    p.fluid.dynamics = Dynamics::geometric;
    CHECK(wanted_size(refined_bands(bud_on_neck(8), p), p, R, end) >= cell_size);
}

TEST_CASE("cells are finer where the layer is thinner", "[refinement]") {
    // ε is in proportion to the neck's radius, 14 nm for ε₀; a cell may be 1.05 times as many ε wide as elsewhere,
    // which a catenoid of 17 nm is for 2 (14/17)⁸ = 0.42.
    Parameters p = with_cells();
    p.phase_field.production.thinning = 1;
    for (const auto& [neck, halvings] : {std::pair{9.0, 1}, {6.0, 1}, {4.5, 2}, {3.0, 2}}) {
        CAPTURE(neck);
        CHECK(wanted_size(refined_bands(bud_on_neck(neck), p), p, neck, 60) <= cell_size * std::exp2(-halvings));
        CHECK(wanted_size(refined_bands(bud_on_neck(neck), p), p, 0, 120) == cell_size);
    }
    CHECK(wanted_size(refined_bands(bud_on_neck(18.0), p), p, 18, 60) == cell_size);
}

TEST_CASE("fine cells reach three thicknesses of the layer that is there", "[refinement]") {
    Parameters p = with_cells();
    p.phase_field.production.thinning = 1;
    const double neck = 3;
    auto curve = bud_on_neck(neck);
    curve.u_r.assign(curve.size(), 0);
    curve.u_z.assign(curve.size(), 0);
    const auto thickness = thickness_along(curve, p);
    std::size_t middle = 0;
    for (std::size_t i = 0; i < curve.size(); ++i)
        if (curve.z[i] < 100 && std::abs(curve.z[i] - 60) < std::abs(curve.z[middle] - 60)) middle = i;
    const double reach = 3 * thickness[middle];
    REQUIRE(reach < 0.5 * neck);
    const auto smallest_at = [&](double from_axis) { return wanted_size(refined_bands(curve, p), p, from_axis, 60); };
    const double here = smallest_at(neck);
    CHECK(smallest_at(neck - 0.99 * reach) == here);
    CHECK(smallest_at(neck - 1.3 * reach) > here);  // thicker parts of the layer reach on, they are farther away

    // What moves is fine 1.5 thicknesses of its own ahead, where it is the fastest in these units.
    for (std::size_t i = 0; i < curve.size(); ++i)
        if (std::abs(curve.z[i] - 60) < 0.1) curve.u_r[i] = -1;
    CHECK(smallest_at(neck - 0.99 * (reach + 1.5 * thickness[middle])) == here);
    CHECK(smallest_at(neck - 1.3 * (reach + 1.5 * thickness[middle])) > here);
}

TEST_CASE("cells are finer at the patch's edge alone", "[refinement]") {
    Parameters p = with_cells();
    p.molecules.interface_width = 1;
    auto curve = bud_on_neck(12);
    for (std::size_t i = 0; i < curve.size(); ++i) curve.c[i] = curve.z[i] > 100 ? 0.985 : curve.z[i] > 98 ? 0.5 : 0.01;
    const auto bands = refined_bands(curve, p);
    CHECK(wanted_size(bands, p, 20, 99) <= 0.75);
    CHECK(wanted_size(bands, p, 0, 120) == cell_size);  // c is not quite 1 in the patch
    CHECK(wanted_size(bands, p, 12, 60) == cell_size);
}

TEST_CASE("cells are fine where the membrane will be when the mesh follows", "[refinement]") {
    Parameters p = with_cells();
    const double band = p.phase_field.band_width = 4.5;
    auto curve = bud_on_neck(12);
    curve.u_r.assign(curve.size(), 0);
    curve.u_z.assign(curve.size(), 0);
    const auto far_from_tip = [&](const std::vector<RefinedBand>& bands) {  // the farthest fine point above the bud
        double height = 120;
        while (wanted_size(bands, p, 0, height) <= cell_size) height += 0.05;
        return height;
    };
    const double at_rest = far_from_tip(refined_bands(curve, p));
    for (std::size_t i = 0; i < curve.size(); ++i) curve.u_z[i] = curve.z[i] > 110 ? 200 : 0;
    const auto bands = refined_bands(curve, p);
    CHECK(far_from_tip(bands) == Approx(at_rest + follow_after_motion(p)).margin(0.11));
    // Not in front of what rests.
    const double beside = 20 + band * p.phase_field.epsilon;
    CHECK(wanted_size(bands, p, beside + 0.1, 100) > cell_size);
}
