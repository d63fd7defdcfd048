#include "laws.h"

#include <fmt/format.h>

#include <vector>

#include "shared/model/bending_model.h"
#include "shared/parameters/parameter_table.h"

namespace endoflow::cli {

namespace {

constexpr int concentration_steps = 100;  // of c, from 0 to 1

}  // namespace

std::string constitutive_laws_csv(const MembraneParameters& membrane) {
    const ParameterRow& law = *find_parameter("membrane.constitutive_law");
    std::string text = "c";
    std::vector<BendingModel> models;
    for (const std::string& name : law.choices) {
        Parameters parameters;
        parameters.membrane = membrane;
        parameters.membrane.curvature_convention = CurvatureConvention::consistent;  // its β, C are b, H0
        law.set(parameters, name);
        models.emplace_back(parameters.membrane);
        text += fmt::format(",{0}_b_pN_nm,{0}_H0_per_nm", name);
    }
    text += "\n";
    for (int i = 0; i <= concentration_steps; ++i) {
        const double c = static_cast<double>(i) / concentration_steps;
        text += fmt::format("{:.15g}", c);
        for (const BendingModel& model : models)
            text += fmt::format(",{:.15g},{:.15g}", model.stiffness(c).value, model.spontaneous_curvature(c).value);
        text += "\n";
    }
    return text;
}

}  // namespace endoflow::cli
