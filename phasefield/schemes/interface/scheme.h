#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "phasefield/contour/contour.h"
#include "phasefield/schemes/interface/diagnostics.h"
#include "shared/output/checkpoint.h"

namespace endoflow::phasefield {

/// What a step led to.
struct StepOutcome {
    StepDiagnostics diagnostics;
    Contour contour;
    std::string rejection;  // why the step must be repeated with a smaller one; empty when it may be kept
};

/// A number with its name in run.json.
struct NamedNumber {
    std::string name;
    double value;
};

/// A discretisation in space and time with the state it has reached. The time loop drives it and knows nothing else.
/// All calls are collective.
class Scheme {
  public:
    Scheme() = default;
    Scheme(const Scheme&) = delete;
    Scheme& operator=(const Scheme&) = delete;
    virtual ~Scheme() = default;

    /// The flat membrane with its patch of molecules at rest.
    virtual StepOutcome start() = 0;
    /// The state that `save` wrote.
    virtual StepOutcome load(const std::filesystem::path& directory, const Checkpoint& checkpoint) = 0;
    virtual void save(const std::filesystem::path& directory, Checkpoint& checkpoint) = 0;

    /// The step to take now; it ends at `deadline` when that is near. [µs]
    [[nodiscard]] virtual double step(double time, double deadline) const = 0;
    /// Tries a step and leaves the state alone. Throws SolverError when a system cannot be solved, and Interrupted when
    /// the run was asked to stop; save() then writes what it would have written before the attempt.
    virtual StepOutcome attempt(double time, double tau) = 0;
    /// Makes the last attempt the state.
    virtual void keep(double time, double tau, const StepOutcome& outcome) = 0;
    /// Forgets the last attempt. Throws SolverError("step-size-underflow", …) when smaller steps make no sense.
    virtual void reject(double time, double tau) = 0;

    /// Whether a collar of the case waits for a neck; and from the kept time on it sits on the material with this area
    /// between it and the pole [nm²]. The motion has a kink there.
    [[nodiscard]] virtual bool collar_waits() const { return false; }
    virtual void place_collar(double /*area*/) {}

    /// Adapts the mesh to the membrane if it has moved far enough.
    virtual void follow(const MembraneCurve& curve) = 0;
    [[nodiscard]] virtual LayerIntegrals integrate() const = 0;
    /// The membrane at a time [µs] within the last step, interpolated; before follow() alone.
    [[nodiscard]] virtual Contour contour_at(double time) const = 0;
    /// The fields, at such a time.
    virtual void write_fields(const std::filesystem::path& run_directory, std::vector<double>& times,
                              double time) const = 0;
    /// Numbers of the scheme that are no parameters, for run.json.
    [[nodiscard]] virtual std::vector<NamedNumber> constants() const { return {}; }
    /// Counts of what its solver has done so far, restarts included, for run.json.
    [[nodiscard]] virtual std::vector<NamedNumber> solver_counts() const { return {}; }
    /// ε of the membrane's layer at a point of the membrane [nm].
    [[nodiscard]] virtual double thickness_at(double r, double z) const = 0;
    [[nodiscard]] virtual double unknowns() const = 0;
    [[nodiscard]] virtual double cells() const = 0;
};

}  // namespace endoflow::phasefield
