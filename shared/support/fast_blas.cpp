#include "shared/support/fast_blas.h"

#include <dlfcn.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <system_error>

namespace endoflow {

namespace {

constexpr const char* variable = "OPENBLAS_CORETYPE";

/// nullptr with another BLAS library.
const char* chosen_kernels() {
    using Name = char* (*)();
    void* symbol = dlsym(RTLD_DEFAULT, "openblas_get_corename");
    return symbol == nullptr ? nullptr : reinterpret_cast<Name>(symbol)();
}

}  // namespace

const char* better_blas_kernels(const char* chosen, bool avx2, bool avx512) {
    if (chosen == nullptr || std::string_view(chosen) != "Prescott") return nullptr;
    return avx512 ? "SKYLAKEX" : avx2 ? "HASWELL" : nullptr;
}

void require_fast_blas([[maybe_unused]] char** argv) {
#ifdef __x86_64__
    if (getenv(variable) != nullptr) return;
    const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    const bool avx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                        __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
    const char* better = better_blas_kernels(chosen_kernels(), avx2, avx512);
    std::error_code failure;
    const auto program = std::filesystem::read_symlink("/proc/self/exe", failure);
    if (better == nullptr || failure) return;
    setenv(variable, better, 1);
    execv(program.c_str(), argv);  // returns only when it fails: then the slow kernels serve
#endif
}

}  // namespace endoflow
