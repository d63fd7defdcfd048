#include "boundary_integral/support/parallel.h"

#include <cstdlib>

#ifdef __linux__
#include <sched.h>
#endif

namespace endoflow::boundary_integral {

namespace {

/// What taskset, a container or a queue leaves of the machine.
int usable_cores() {
#ifdef __linux__
    cpu_set_t cores;
    if (sched_getaffinity(0, sizeof cores, &cores) == 0) return CPU_COUNT(&cores);
#endif
    return static_cast<int>(std::thread::hardware_concurrency());  // 0 where it is not known
}

}  // namespace

int thread_count(int wanted) {
    if (wanted > 0) return wanted;
    const int cores = std::max(1, usable_cores());
    const char* const asked = std::getenv("OMP_NUM_THREADS");
    const long limit = asked == nullptr ? 0 : std::strtol(asked, nullptr, 10);  // of a list, the outermost level's
    return limit > 0 ? static_cast<int>(std::min<long>(cores, limit)) : cores;
}

}  // namespace endoflow::boundary_integral
