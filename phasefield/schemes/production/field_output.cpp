// What field files have of a state.

#include <deal.II/numerics/data_out.h>
#include <deal.II/numerics/data_postprocessor.h>

#include "phasefield/output/field_file.h"
#include "phasefield/schemes/production/production_scheme.h"

namespace endoflow::phasefield::production {

namespace {

/// φ and the pressure with the layer's part, which are not unknowns themselves.
class PhysicalFields : public dealii::DataPostprocessor<2> {
  public:
    explicit PhysicalFields(const StepNumbers& step) : step_(&step) {}
    [[nodiscard]] std::vector<std::string> get_names() const override { return {"phi", "pressure"}; }
    [[nodiscard]] std::vector<dealii::DataComponentInterpretation::DataComponentInterpretation>
    get_data_component_interpretation() const override {
        return std::vector<dealii::DataComponentInterpretation::DataComponentInterpretation>(
            2, dealii::DataComponentInterpretation::component_is_scalar);
    }
    [[nodiscard]] dealii::UpdateFlags get_needed_update_flags() const override {
        return dealii::update_values | dealii::update_quadrature_points;
    }
    void evaluate_vector_field(const dealii::DataPostprocessorInputs::Vector<2>& in,
                               std::vector<dealii::Vector<double>>& out) const override {
        const auto cell = in.get_cell<2>();
        const CellBox box = cell_box(cell);
        for (std::size_t q = 0; q < out.size(); ++q) {
            const auto& value = in.solution_values[q];
            const double x = (in.evaluation_points[q][0] - box.r0) / box.hr;
            const double y = (in.evaluation_points[q][1] - box.z0) / box.hz;
            const double epsilon = step_->thickness_at(cell->active_cell_index(), box, x, y).value;
            out[q](0) = equilibrium_profile(value(distance), epsilon);
            out[q](1) = value(Field::pressure) + layer_profile(value(distance), epsilon).delta * value(pressure_layer);
        }
    }

  private:
    const StepNumbers* step_;
};

/// c_b [1/nm³], which means something where the fluid is that has it.
class BulkConcentration : public dealii::DataPostprocessorScalar<2> {
  public:
    explicit BulkConcentration(const MoleculeParameters& molecules)
        : dealii::DataPostprocessorScalar<2>("bulk_concentration", dealii::update_values),
          initial_(molecules.bulk_concentration) {}
    void evaluate_vector_field(const dealii::DataPostprocessorInputs::Vector<2>& in,
                               std::vector<dealii::Vector<double>>& out) const override {
        for (std::size_t q = 0; q < out.size(); ++q) out[q](0) = initial_ * (1 - in.solution_values[q](depletion));
    }

  private:
    double initial_;
};

}  // namespace

void ProductionScheme::write_fields(const std::filesystem::path& run_directory, std::vector<double>& times,
                                    double time) const {
    using Interpretation = dealii::DataComponentInterpretation::DataComponentInterpretation;
    std::vector<Interpretation> meaning(n_fields, dealii::DataComponentInterpretation::component_is_scalar);
    meaning[velocity_r] = meaning[velocity_z] = dealii::DataComponentInterpretation::component_is_part_of_vector;
    std::vector<std::string> names;
    for (const auto& unknown : production::unknowns()) names.emplace_back(unknown.output_name);
    dealii::DataOut<2> data;
    const Vector solution = polynomial(state_.solutions, time, state_.times.size());
    const StepNumbers numbers = at_rest();
    const PhysicalFields physical(numbers);
    data.add_data_vector(space_.dofs, solution, names, meaning);
    data.add_data_vector(space_.dofs, solution, physical);
    Vector bulk;
    const BulkConcentration concentration(parameters_.molecules);
    if (bulk_) {
        bulk = combination(bulk_->space(), extrapolation_weights(time, state_.times, state_.times.size()),
                           bulk_->solutions());
        data.add_data_vector(bulk_->space().dofs, bulk, concentration);
    }
    data.build_patches(space_.degrees[distance]);
    write_field_file(run_directory, times, time, mesh_->get_communicator(), data);
}

}  // namespace endoflow::phasefield::production
