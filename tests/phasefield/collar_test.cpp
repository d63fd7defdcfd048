// A collar that waits for its neck: the time loop ends a step there, and says where it sits.

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <numbers>

#include "../shared/temporary_directory.h"

#include "phasefield/driver/time_loop.h"
#include "phasefield/simulation.h"
#include "shared/output/run_files.h"

using namespace endoflow;
using namespace endoflow::phasefield;

namespace {

using std::numbers::pi;

constexpr double bud_radius = 20, rim_radius = 40;  // of bud and membrane, nm

/// A bud with a neck of this radius.
Contour bud(double neck) {
    Contour contour{{}, 1};
    constexpr int points = 600;
    for (int i = 0; i <= points; ++i) {
        const double t = 3.0 * i / points;
        const double r = t < 1   ? bud_radius * std::sin(pi * t / 2)
                         : t < 2 ? neck + (bud_radius - neck) * (1 + std::cos(pi * (t - 1))) / 2
                                 : neck + (rim_radius - neck) * (1 - std::cos(pi * (t - 2) / 2));
        contour.curve.r.push_back(r);
        contour.curve.z.push_back(100 - 20 * t);
    }
    for (auto* values : {&contour.curve.c, &contour.curve.lambda, &contour.curve.kappa, &contour.curve.u_r,
                         &contour.curve.u_z, &contour.curve.s})
        values->assign(contour.curve.r.size(), 0);
    return contour;
}

/// Steps of 0.1 µs with a neck that narrows as time says, faster with a collar.
class NarrowingNeck : public Scheme {
  public:
    explicit NarrowingNeck(double& place) : place_(&place) {}

    static double radius(double time) { return 15 - 4 * time * time; }
    static constexpr double due = 1.118033988749895;  // radius(due) = 10

    StepOutcome start() override { return at(0); }
    StepOutcome load(const std::filesystem::path&, const Checkpoint&) override { return at(0); }
    /// An empty mesh.
    void save(const std::filesystem::path& directory, Checkpoint&) override {
        std::filesystem::create_directories(directory);
        std::ofstream(directory / "mesh.info") << "version nproc n_attached_fixed_size_objs\n4 1 0\n";
        std::ofstream(directory / "mesh_fixed.data", std::ios::binary).write("\0\0\0", 4);
    }
    [[nodiscard]] double step(double time, double deadline) const override { return std::min(0.1, deadline - time); }
    StepOutcome attempt(double time, double tau) override { return at(time + tau); }
    void keep(double, double, const StepOutcome&) override {}
    void reject(double, double) override {}
    [[nodiscard]] bool collar_waits() const override { return *place_ == 0; }
    void place_collar(double area) override { *place_ = area; }
    void follow(const MembraneCurve&) override {}
    [[nodiscard]] LayerIntegrals integrate() const override { return {1, 1, 1}; }
    [[nodiscard]] Contour contour_at(double time) const override { return bud(radius(time)); }
    void write_fields(const std::filesystem::path&, std::vector<double>&, double) const override {}
    [[nodiscard]] double thickness_at(double, double) const override { return 1.2; }
    [[nodiscard]] double unknowns() const override { return 0; }
    [[nodiscard]] double cells() const override { return 0; }

  private:
    double* place_;

    [[nodiscard]] static StepOutcome at(double time) { return {{}, bud(radius(time)), {}}; }
};

}  // namespace

TEST_CASE("a step ends where a collar's neck is due, and the collar knows its place", "[collar]") {
    Parameters p;
    p.domain.radius = rim_radius;
    p.domain.height = 200;
    p.domain.membrane_height = 40;
    p.membrane.collar_force = 20;
    p.time.end = 1.3;
    p.output.field_interval = 0;
    const TemporaryDirectory directory;
    RunFiles output(p, identity(1), directory.path() / "run", StartMode::fresh);
    double place = 0;
    TimeLoop loop(p, output, MPI_COMM_SELF, std::make_unique<NarrowingNeck>(place));
    CHECK(loop.run() == ExitReason::done);

    // As near as the loop's miss of 0.01 nm lets it come, the neck being narrowed by 8.9 nm/µs.
    output.finish(ExitReason::done);
    const auto event = read_record({directory.path() / "run"})["events"]["collar"];
    CHECK(event["time_us"].get<double>() == Approx(NarrowingNeck::due).margin(0.01 / 8.9));
    CHECK(event["neck_radius_nm"].get<double>() == Approx(10).margin(0.01));
    // The area above the neck, by Simpson's rule of the shape; the contour's polygon leaves 1e-5 of it.
    double area = 0;
    const auto density = [](double t) {
        const double r =
            t < 1 ? bud_radius * std::sin(pi * t / 2) : 10 + (bud_radius - 10) * (1 + std::cos(pi * (t - 1))) / 2;
        const double slope =
            t < 1 ? bud_radius * pi / 2 * std::cos(pi * t / 2) : -(bud_radius - 10) * pi / 2 * std::sin(pi * (t - 1));
        return 2 * pi * r * std::hypot(slope, 20);
    };
    constexpr int intervals = 1000;
    for (int i = 0; i < intervals; ++i) {
        const double a = 2.0 * i / intervals, b = 2.0 * (i + 1) / intervals;
        area += (b - a) / 6 * (density(a) + 4 * density((a + b) / 2) + density(b));
    }
    CHECK(place == Approx(area).epsilon(1e-3));
}
