// bench-ring-kernels [REPEATS]: rates of the ring kernels on one core, as one JSON object on stdout. CPU time, so that
// other processes do not count; the median of the repeats.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <numbers>
#include <vector>

#include "boundary_integral/kernels/ring_kernels.h"

namespace {

using namespace endoflow::boundary_integral;

// The sources of one target in the standard case: 80 elements of 8 points, on a sphere of 20 nm.
constexpr std::size_t points = 640;
constexpr double radius = 20;             // nm
constexpr double seconds_per_rate = 0.2;  // CPU time that one repeat takes

double cpu_seconds() {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

struct Ring {
    double r, z;
};

Ring ring_at(double fraction) {
    const double angle = std::numbers::pi * fraction;
    return {radius * std::sin(angle), radius * std::cos(angle)};
}

// Sources seen from one of the targets, which lie between the sources.
RingSources sources_seen_from(const Ring& target) {
    RingSources sources;
    sources.resize(points);
    for (std::size_t i = 0; i < points; ++i) {
        const Ring at = ring_at((static_cast<double>(i) + 0.5) / points);
        sources.radius[i] = at.r;
        sources.delta_r[i] = at.r - target.r;
        sources.delta_z[i] = at.z - target.z;
        sources.normal_r[i] = at.r / radius;
        sources.normal_offset[i] = (at.r * sources.delta_r[i] + at.z * sources.delta_z[i]) / radius;
    }
    return sources;
}

// Source-target pairs per second of CPU time.
template <class Evaluate>
double rate(const Evaluate& evaluate) {
    std::size_t calls = 0;
    const double begin = cpu_seconds();
    double now = begin;
    while (now - begin < seconds_per_rate) {
        for (int i = 0; i < 200; ++i) evaluate();
        calls += 200;
        now = cpu_seconds();
    }
    return static_cast<double>(calls * points) / (now - begin);
}

template <class Evaluate>
double median_rate(int repeats, const Evaluate& evaluate) {
    std::vector<double> rates;
    for (int i = 0; i < repeats; ++i) rates.push_back(rate(evaluate));
    const auto middle = rates.begin() + static_cast<std::ptrdiff_t>(rates.size() / 2);
    std::nth_element(rates.begin(), middle, rates.end());
    return *middle;
}

}  // namespace

int main(int argc, char** argv) {
    const int repeats = argc > 1 ? std::max(1, std::atoi(argv[1])) : 5;
    const Ring target = ring_at(0.3);
    const RingSources sources = sources_seen_from(target);
    RingKernels kernels;
    RingDensities densities;
    densities.resize(sources.size());
    RingContributions contributions;
    const double single = median_rate(repeats, [&] { evaluate_ring_stokeslets(target.r, sources, kernels); });
    const double both = median_rate(repeats, [&] { evaluate_ring_kernels(target.r, sources, kernels); });
    const double layers = median_rate(
        repeats, [&] { evaluate_ring_layers(target.r, sources.size(), sources, densities, contributions); });
    std::printf(
        "{\"stokeslet_4_components\": %.4g, \"stokeslet_and_stresslet_8_components\": %.4g, "
        "\"layers_of_velocity_and_pressure\": %.4g}\n",
        single, both, layers);
    return 0;
}
