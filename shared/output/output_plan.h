#pragma once

#include "shared/parameters/parameters.h"

namespace endoflow {

/// Relative difference of times that is round-off.
inline constexpr double same_time = 1e-12;

/// Whether a time is after another one, by more than round-off.
[[nodiscard]] inline bool later(double time, double than) {
    return time > than * (1 + same_time);
}

/// The first multiple of an interval [µs] after a time; never when the interval is 0.
[[nodiscard]] double next_multiple(double interval, double time);

/// When membrane shapes are due, in all engines alike, at times that depend on these three numbers alone [µs].
struct ShapeTimes {
    double interval;  // output.shape_interval; 0: chosen
    double end;       // time.end
    double first;     // the first time step

    explicit ShapeTimes(const Parameters& parameters);

    /// The next one after a time. With an interval they are interval/2⁸, …, interval/4, interval/2, where the membrane
    /// is fastest, then its multiples. Chosen, some 400 of them, they are the multiples of an interval that grows with
    /// the square root of time, never longer than the time itself nor shorter than the first step. It is a power of two
    /// of a microsecond: all times of a long run that a shorter one reaches are times of the shorter one, too.
    [[nodiscard]] double after(double time) const;

  private:
    [[nodiscard]] double chosen_interval(double time) const;
    [[nodiscard]] double chosen_after(double time) const;
};

/// The time between checkpoints [s] where one costs `cost`: the wanted `interval`, less (but two seconds) while they
/// cost below 1 % of the time, so that a kill costs seconds, and more where they would cost above 2 % of it. With an
/// interval of 0 there is one after every step.
[[nodiscard]] double checkpoint_pause(double interval, double cost);

/// Which shapes and fields of a run are written, and which are due. After a restart those before its beginning are
/// past, whatever the intervals were.
class OutputPlan {
  public:
    /// `start`: of this part of the run, µs.
    OutputPlan(const Parameters& parameters, double start)
        : shapes_(parameters),
          field_interval_(parameters.output.field_interval),
          last_shape_(start),
          last_fields_(start) {}

    [[nodiscard]] double next_shape() const { return shapes_.after(last_shape_); }
    [[nodiscard]] double next_fields() const { return next_multiple(field_interval_, last_fields_); }

    /// Calls write(time) for all shapes due up to a time.
    template <class Write>
    void shapes_until(double end, const Write& write) {
        for (double time = next_shape(); !later(time, end); time = next_shape()) write(last_shape_ = time);
    }
    template <class Write>
    void fields_until(double end, const Write& write) {
        for (double time = next_fields(); !later(time, end); time = next_fields()) write(last_fields_ = time);
    }

    /// The same, and the one of this very time: of an event, of the end.
    template <class Write>
    void shape_at(double time, const Write& write) {
        shapes_until(time, write);
        if (later(time, last_shape_)) write(last_shape_ = time);
    }
    template <class Write>
    void fields_at(double time, const Write& write) {
        fields_until(time, write);
        if (later(time, last_fields_)) write(last_fields_ = time);
    }

  private:
    ShapeTimes shapes_;
    double field_interval_;            // µs
    double last_shape_, last_fields_;  // µs, written or past
};

}  // namespace endoflow
