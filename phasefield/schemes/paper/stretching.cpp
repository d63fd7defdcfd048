#include <deal.II/base/quadrature_lib.h>

#include "phasefield/schemes/paper/conserved_terms.h"
#include "phasefield/schemes/paper/surface_transport.h"

namespace endoflow::phasefield::paper {

namespace {

/// (31): the flux through a wall, ∮ |∇φ| m·P u η, enters (38) as data: membrane from outside is unstretched.
/// m is the wall's outer normal; the state is evaluated on the wall by one-dimensional Gauss points.
class WallInflow {
  public:
    WallInflow(const Spaces& spaces, const Parameters& parameters)
        : spaces_(&spaces),
          epsilon_(parameters.phase_field.epsilon),
          rule_(quadrature_points(parameters.phase_field)),
          values_(spaces.flow.element.n_dofs_per_cell()) {}

    void add(const dealii::DoFHandler<2>::active_cell_iterator& flow_cell, const CellBox& box, const Vector& flow,
             dealii::Vector<double>& right_hand_side) {
        for (const unsigned int face : flow_cell->face_indices()) {
            if (!flow_cell->face(face)->at_boundary() || flow_cell->face(face)->boundary_id() == axis) continue;
            flow_cell->get_dof_values(flow, values_);
            add_face(face, box, right_hand_side);
        }
    }

  private:
    void add_face(unsigned int face, const CellBox& box, dealii::Vector<double>& right_hand_side) {
        const bool side_wall = face < 2;
        const double m_r = face == 1 ? 1 : 0, m_z = face == 2 ? -1 : face == 3 ? 1 : 0;
        std::vector<dealii::Point<2>> points;
        for (const auto& x : rule_.get_points())
            points.push_back(side_wall ? dealii::Point<2>(face, x[0]) : dealii::Point<2>(x[0], face - 2));
        const dealii::Quadrature<2> wall(points, rule_.get_weights());
        const Space &flow = spaces_->flow, &surface = spaces_->stretching;
        const ScalarBasis velocity(flow.degrees[u_r], wall), profile(flow.degrees[phi], wall),
            test(surface.degrees[0], wall);
        ScalarField ur, uz, p;
        std::vector<double> coefficients;
        const auto field = [&](const ScalarBasis& basis, unsigned int component, ScalarField& out) {
            component_values(flow, component, values_, coefficients);
            evaluate(basis, box, coefficients, Derivatives::first, out);
        };
        field(velocity, u_r, ur);
        field(velocity, u_z, uz);
        field(profile, phi, p);
        for (unsigned int q = 0; q < wall.size(); ++q) {
            const double r = box.r0 + box.hr * points[q][0];
            const auto layer = layer_geometry(p.r[q], p.z[q], epsilon_);
            const double flux = m_r * (layer.P_rr * ur.value[q] + layer.P_rz * uz.value[q]) +
                                m_z * (layer.P_rz * ur.value[q] + layer.P_zz * uz.value[q]);
            const double w = wall.weight(q) * (side_wall ? box.hz : box.hr) * r * layer.gradient * flux;
            for (unsigned int i = 0; i < test.n_dofs; ++i)
                right_hand_side(surface.local[0][i]) -= w * test.value[q * test.n_dofs + i];
        }
    }

    const Spaces* spaces_;
    double epsilon_;
    dealii::QGauss<1> rule_;
    dealii::Vector<double> values_;
};

}  // namespace

void advance_stretching(const Spaces& spaces, const Vector& flow_old, const Vector& flow_new,
                        const Parameters& parameters, double tau, LinearSystem& system, Vector& stretching) {
    const auto terms = [&](const std::vector<LayerPoint>& points, LocalSystem& local) {
        add_conserved_rate(points, tau, 0, 0, local);
        add_layer_diffusion(points, parameters.phase_field.stretching_diffusivity, 0, 0, local);
        add_normal_diffusion(points, parameters.molecules.normal_diffusivity, 0, 0, local);
    };
    WallInflow at_walls(spaces, parameters);
    const auto inflow = [&](const auto& flow_cell, const CellBox& box, dealii::Vector<double>& right_hand_side) {
        at_walls.add(flow_cell, box, flow_new, right_hand_side);
    };
    advance_on_layer(spaces, spaces.stretching, flow_old, flow_new, parameters, terms, inflow, system, stretching);
}

}  // namespace endoflow::phasefield::paper
