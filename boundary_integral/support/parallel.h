#pragma once

#include <algorithm>
#include <exception>
#include <thread>
#include <vector>

#include "boundary_integral/splines/spline_space.h"

namespace endoflow::boundary_integral {

/// boundary_integral.threads: 0 means one for each core that this process may use, at most OMP_NUM_THREADS.
[[nodiscard]] int thread_count(int wanted);

/// Calls body(begin, end) on `threads` contiguous parts of [0, count), each in its own thread; rethrows the first
/// exception. The parts must not write to the same places. Starting a thread costs some 20 µs: for work of a
/// millisecond and more.
template <class Body>
void parallel_parts(Index count, int threads, const Body& body) {
    const Index parts = std::clamp<Index>(threads, 1, std::max<Index>(count, 1));
    std::vector<std::exception_ptr> failures(static_cast<std::size_t>(parts));
    const auto part = [&](Index k) {
        try {
            body(count * k / parts, count * (k + 1) / parts);
        } catch (...) {
            failures[static_cast<std::size_t>(k)] = std::current_exception();
        }
    };
    {
        std::vector<std::jthread> workers;
        for (Index k = 1; k < parts; ++k) workers.emplace_back(part, k);
        part(0);
    }
    for (const std::exception_ptr& failure : failures) {
        if (failure) std::rethrow_exception(failure);
    }
}

}  // namespace endoflow::boundary_integral
