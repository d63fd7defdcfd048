#pragma once

namespace endoflow {

/// The kernels that OpenBLAS should be told to use: those of the processor where it has chosen `chosen` because it does
/// not know the processor, nullptr where its choice is good.
[[nodiscard]] const char* better_blas_kernels(const char* chosen, bool avx2, bool avx512);

/// OpenBLAS takes a processor newer than itself for one of 2004 and computes with SSE3 alone: factorisations take
/// several times as long. It chooses when it is loaded, so the program starts itself anew with the variable
/// OPENBLAS_CORETYPE set; nothing happens where that is set already, with other BLAS libraries and on other
/// architectures. To be called first of all.
void require_fast_blas(char** argv);

}  // namespace endoflow
