#include "statics/shape_record.h"

#include "statics/sampled_curve.h"
#include "statics/shape_integrals.h"
#include "statics/stationary_state.h"

namespace endoflow::statics {

namespace {

/// What one stationary shape says of itself.
struct ShapeRecord {
    const Parameters& named;  // the case the user sees
    const MembraneCurve& curve;
    const BranchPoint& point;
    const ShapeIntegrals& integrals;
    Loads loads;
    const PlaceOnBranch& place;

    [[nodiscard]] double apex_height() const { return curve.z.front() - curve.z.back(); }
};

const std::vector<OwnColumn<ShapeRecord>>& own_shape_columns() {
    using R = ShapeRecord;
    static const std::vector<OwnColumn<R>> columns{
        {"patch_radius_nm", "molecules.patch_radius of the case",
         [](const R& r) { return r.named.molecules.patch_radius; }},
        {"spontaneous_curvature_per_nm", "membrane.spontaneous_curvature of the case",
         [](const R& r) { return r.named.membrane.spontaneous_curvature; }},
        {"curve_length_nm", "arc length from the axis to the rim", [](const R& r) { return r.curve.s.back(); }},
        {"apex_height_nm", "height of the membrane on the axis above the rim",
         [](const R& r) { return r.apex_height(); }},
        {"tension_at_axis_pN_per_nm", "λ on the axis", [](const R& r) { return r.curve.lambda.front(); }},
        {"branch_length", "arc length along the branch, in units of the problem's scales",
         [](const R& r) { return r.point.arc_length; }},
        {"folds_passed", "folds of the branch before this shape",
         [](const R& r) { return static_cast<double>(r.point.folds_before); }},
        {"rim_tension_pN_per_nm", "σ", [](const R& r) { return r.loads.rim_tension; }},
        {"pressure_difference_pN_per_nm2", "p", [](const R& r) { return r.loads.pressure; }},
        {"pole_force_pN", "F", [](const R& r) { return r.loads.pole_force; }},
        {"pole_extension_nm", "z̄ − z(rim): how far the pole force has pulled",
         [](const R& r) { return r.integrals.extension; }},
        {"coat_force_pN", "F_a", [](const R& r) { return r.loads.coat_force; }},
        {"coat_extension_nm", "z̄_c − z̄_ring: how far the coat's force has pulled; without a ring over the rim",
         [](const R& r) { return r.integrals.coat_extension; }},
        {"collar_force_pN", "F_d", [](const R& r) { return r.loads.collar_force; }},
        {"collar_radius_nm", "r̄ of the membrane under the collar; empty without one",
         [](const R& r) { return r.loads.radial() ? std::optional(r.integrals.collar_radius) : std::nullopt; }},
        {"potential_pN_nm", "𝒢 = E + E_c + σ A − p V − F z̄ − F_a (z̄_c − z̄_ring) + F_d r̄",
         [](const R& r) { return r.integrals.potential(r.loads); }},
        {"line_energy_pN_nm", "E_c of the coat's edge, under energetic coupling",
         [](const R& r) { return r.integrals.edge; }},
        {followed_value.name, followed_value.meaning, [](const R& r) { return r.place.followed; }},
        {"neck_force_pN", "f = d𝒢/dR, the radial force that holds the neck, > 0 outwards; empty where none is held",
         [](const R& r) { return r.place.hold ? std::optional(r.place.hold->force) : std::nullopt; }},
        {"neck_work_pN_nm", "∫ f dR from the branch's first shape; empty where no neck is held",
         [](const R& r) { return r.place.hold ? std::optional(r.place.hold->work) : std::nullopt; }},
    };
    return columns;
}

}  // namespace

std::vector<ColumnText> shape_columns() {
    return texts_of(own_shape_columns());
}

Parameters resolved(const Parameters& parameters, const Request& request) {
    return request.disc_mass ? with_disc_mass(parameters) : parameters;
}

Json write_state(StateWriter& writer, const Parameters& named, const Parameters& solved, const BranchPoint& point,
                 const PlaceOnBranch& place) {
    const GaussRule rule(Resolution{}.points);
    const MembraneCurve curve = sampled_curve(solved, point.solution, rule, curve_points);
    const ShapeIntegrals integrals = shape_integrals(solved, point.solution, rule);
    const Loads loads = loads_of(solved);
    const ShapeRecord record{named, curve, point, integrals, loads, place};
    Json figures = writer.write(curve, bending_model(solved, 0), own_values(own_shape_columns(), record));
    figures["apex_height_nm"] = record.apex_height();
    figures["tension_at_axis_pN_per_nm"] = curve.lambda.front();
    const bool coupled = energetically_coupled(solved.molecules);
    if (coupled) figures["line_energy_pN_nm"] = integrals.edge;
    if (coupled || !loads.none() || place.hold) figures["potential_pN_nm"] = integrals.potential(loads);
    if (loads.pole_force != 0) figures["pole_extension_nm"] = integrals.extension;
    if (loads.coat_force != 0) figures["coat_extension_nm"] = integrals.coat_extension;
    if (loads.radial()) figures["collar_radius_nm"] = integrals.collar_radius;
    if (place.hold) figures["neck_force_pN"] = place.hold->force;
    return figures;
}

}  // namespace endoflow::statics
