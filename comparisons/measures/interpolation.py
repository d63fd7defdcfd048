"""How far a shape interpolated in time lies from the membrane, estimated from the shapes of the run itself."""

from bisect import bisect_right

from comparisons.measures.distances import curve_distance
from endoflow.shapes import between


class InterpolationError:
    """Estimates for an endoflow.Run; at(time) gives the Hausdorff distance in nm.

    Linear interpolation between times t₁ and t₂ errs by (t − t₁)(t₂ − t) |ẍ|/2. Leaving out an inner shape and
    interpolating it between its neighbours gives |ẍ|/2 there; the larger one of both ends of an interval counts.
    """

    def __init__(self, run):
        self.run, self.times, self.known = run, [float(time) for time in run.shape_times], {}

    def written_at(self, time):
        """Whether the run wrote a shape at a time (µs), to round-off."""
        after = bisect_right(self.times, time)
        return any(abs(time - own) <= 1e-9 * max(1.0, abs(own)) for own in self.times[max(0, after - 1) : after + 1])

    def at(self, time):
        """The estimate at a time (µs) that the shapes cover: 0 at an output time, None for fewer than three shapes."""
        if self.written_at(time):
            return 0.0
        if len(self.times) < 3:
            return None
        after = bisect_right(self.times, time)
        span = (time - self.times[after - 1]) * (self.times[after] - time)
        return span * max(self._half_acceleration(index) for index in (after - 1, after))

    def _half_acceleration(self, index):
        """|ẍ|/2 in nm/µs² at a shape; the outermost shapes take their neighbour's."""
        index = min(max(index, 1), len(self.times) - 2)
        if index not in self.known:
            before, own, after = self.run.shapes[index - 1 : index + 2]
            left_out = between(before, after, own.time)
            distance = curve_distance((own.r, own.z), (left_out.r, left_out.z)).hausdorff
            self.known[index] = distance / ((own.time - before.time) * (after.time - own.time))
        return self.known[index]
