#include <fmt/format.h>

#include <stdexcept>

#include "shared/output/accuracy.h"

namespace endoflow {

namespace {

bool keeps_its_area(const Parameters& p) {
    return p.membrane.inextensible && p.fluid.dynamics == Dynamics::flow;
}

bool moves_in_fluid(const Parameters& p) {
    return p.fluid.dynamics == Dynamics::flow;
}

bool keeps_its_molecules(const Parameters& p) {
    return p.molecules.exchange == Exchange::none;
}

constexpr const char* finer_elements =
    "leave boundary_integral.elements and time.tolerance at 0, and lower boundary_integral.accuracy";
constexpr const char* finer_layer = "lower phase_field.epsilon (and cell_size with it), or time.tolerance";
constexpr const char* finer_neck =
    "lower phase_field.epsilon (and cell_size with it), and leave phase_field.production.thinning at its default";
constexpr double never = 1e6;  // a limit that no run reaches

// Where the sharp engine's energy balance leaves its bound, necks and energies are off by some per mille, and by tens
// of per cents at the limit (docs/results/sharp-refinement.md has the runs). Without a fluid a neck closes
// in finite time, and no mesh follows its last nanometre: that raises the alarm, but the run ends when the neck has
// closed.
const std::vector<AccuracyBound>& boundary_integral_bounds() {
    using enum AccuracyMeasure;
    static const std::vector<AccuracyBound> bounds{
        {"energy-balance", "boundary-integral", "energy_balance_relative", rate, 1e-3, 0.5,
         "energy's rate against the power that the fluid and the molecules take", finer_elements, moves_in_fluid},
        {"energy-balance", "boundary-integral", "energy_balance_relative", rate, 1e-3, 2.0,
         "energy's rate against what the membrane's own mobility takes, without a fluid", finer_elements,
         [](const Parameters& p) { return !moves_in_fluid(p); }},
        {"mass-drift", "boundary-integral", "molecule_mass_nm2", drift, 1e-4, 0.1, "change of the molecules' mass",
         finer_elements, keeps_its_molecules},
        {"molecule-balance", "boundary-integral", "molecule_balance_relative", value, 1e-3, 0.1,
         "molecules on the membrane against those it had and those that came", finer_elements,
         [](const Parameters& p) { return !keeps_its_molecules(p); }},
        {"area-strain", "boundary-integral", "area_strain_max", value, 1e-2, 1.0,
         "largest change of area of an inextensible membrane's material", finer_elements, keeps_its_area},
        {"force-balance",
         "boundary-integral",
         "force_balance_relative",
         value,
         1e-3,
         0.5,
         "membrane's forces against the tractions on the walls",
         finer_elements,
         {}},
        {"flux-balance",
         "boundary-integral",
         "net_flux_relative",
         value,
         2e-2,
         0.5,
         "volume that a membrane, closed to fluid, lets through",
         finer_elements,
         {}},
        {"area-balance", "boundary-integral", "area_balance_relative", value, 1e-3, 0.5,
         "area's rate against the membrane that flows in", finer_elements, keeps_its_area},
        {"resolution",
         "boundary-integral",
         "resolution_error_relative",
         value,
         Parameters{}.boundary_integral.accuracy,
         never,
         "estimated error of neck radius and budding time",
         "leave boundary_integral.elements and time.tolerance at 0, or raise boundary_integral.accuracy",
         {},
         "boundary_integral.accuracy"},
    };
    return bounds;
}

// Of layer-at-neck: a layer leaves a neck errors of the order of (ε/ρ)²: with one in proportion, 0.086, necks are right
// to 1 %, at 0.125 by 2 to 5 % wrong, beyond by up to a fifth (docs/results/standard-case.md).
const std::vector<AccuracyBound>& phase_field_bounds() {
    using enum AccuracyMeasure;
    static const std::vector<AccuracyBound> bounds{
        {"energy-law",
         "phase-field",
         "energy_law_residual_pN_nm_per_us",
         accumulated,
         1e-2,
         0.5,
         "energy that the law (21) does not account for, of the largest one or the loads' work so far",
         finer_layer,
         {}},
        {"mass-drift", "phase-field", "molecule_mass_nm2", drift, 1e-3, 0.1, "change of the molecules' mass",
         finer_layer, keeps_its_molecules},
        {"molecule-balance", "phase-field", "molecule_balance_relative", value, 1e-3, 0.1,
         "molecules on the membrane against those it had and those that came", finer_layer,
         [](const Parameters& p) { return !keeps_its_molecules(p); }},
        {"area-strain", "phase-field", "area_strain_max", value, 1e-2, 0.1,
         "largest change of area of an inextensible membrane's material", finer_layer,
         [](const Parameters& p) { return keeps_its_area(p) && p.phase_field.scheme == PhaseFieldScheme::production; }},
        {"area-strain", "phase-field", "area_strain_max", value, 1e-2, 1.0,
         "the same in scheme `paper`, which reaches a tenth as it is printed", finer_layer,
         [](const Parameters& p) { return keeps_its_area(p) && p.phase_field.scheme == PhaseFieldScheme::paper; }},
        {"thickness",
         "phase-field",
         "thickness_error_max",
         value,
         5e-2,
         1.0,
         "largest relative error of the layer's thickness",
         finer_layer,
         {}},
        {"layer-at-neck", "phase-field", "layer_at_neck_relative", value, 0.125, never,
         "the layer's thickness at the neck over the neck's radius", finer_neck,
         [](const Parameters& p) { return p.phase_field.scheme == PhaseFieldScheme::production; }},
    };
    return bounds;
}

}  // namespace

const std::vector<AccuracyBound>& accuracy_bounds() {
    static const std::vector<AccuracyBound> all = [] {
        std::vector<AccuracyBound> bounds = boundary_integral_bounds();
        bounds.insert(bounds.end(), phase_field_bounds().begin(), phase_field_bounds().end());
        return bounds;
    }();
    return all;
}

const AccuracyBound& sharp_bound(const std::string& name, const Parameters& p) {
    for (const AccuracyBound& bound : boundary_integral_bounds())
        if (bound.name == name && (!bound.applies || bound.applies(p))) return bound;
    throw std::out_of_range("no bound named " + name);
}

std::string render_accuracy_markdown() {
    std::string text =
        "| engine | alarm | column | bound | limit | what it is | what to change |\n"
        "| --- | --- | --- | --- | --- | --- | --- |\n";
    for (const AccuracyBound& b : accuracy_bounds())
        text += fmt::format("| {} | `{}` | `{}` | {} | {} | {} | {} |\n", b.engine, b.name, b.column,
                            b.asked_for.empty() ? fmt::format("{}", b.bound) : fmt::format("`{}`", b.asked_for),
                            b.limit, b.meaning, b.remedy);
    return text;
}

}  // namespace endoflow
