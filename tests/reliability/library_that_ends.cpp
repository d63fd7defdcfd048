// A library that ends its process in the middle of a run, as MUMPS' ordering PORD does. Loaded first (LD_PRELOAD), it
// stands for LAPACK's and MUMPS' factorisations, passes them on, and at a call that the environment names does what it
// names.

#include <dlfcn.h>

#include <csignal>
#include <cstdlib>
#include <cstring>

namespace {

int from_environment(const char* name, int otherwise) {
    const char* text = std::getenv(name);
    return text == nullptr ? otherwise : std::atoi(text);
}

void end_when_it_is_time() {
    static int calls = 0;
    const char* how = std::getenv("LIBRARY_ENDS_BY");
    if (how == nullptr || ++calls < from_environment("LIBRARY_ENDS_AT", 1)) return;
    if (from_environment("OMPI_COMM_WORLD_RANK", 0) != from_environment("LIBRARY_ENDS_ON", 0)) return;
    if (std::strcmp(how, "exit") == 0) std::exit(255);
    if (std::strcmp(how, "exit as if all were well") == 0) std::exit(0);
    if (std::strcmp(how, "abort") == 0) std::abort();
    if (std::strcmp(how, "segmentation fault") == 0) std::raise(SIGSEGV);
    if (std::strcmp(how, "kill") == 0) std::raise(SIGKILL);
    if (std::strcmp(how, "MPI_Abort") == 0)  // of Open MPI: MPI_COMM_WORLD is this object's address
        reinterpret_cast<int (*)(void*, int)>(dlsym(RTLD_DEFAULT, "MPI_Abort"))(
            dlsym(RTLD_DEFAULT, "ompi_mpi_comm_world"), 7);
    if (std::strcmp(how, "MPI error") == 0)  // 5 is no process
        reinterpret_cast<int (*)(const void*, int, void*, int, int, void*)>(dlsym(RTLD_DEFAULT, "MPI_Send"))(
            nullptr, 0, dlsym(RTLD_DEFAULT, "ompi_mpi_byte"), 500, 0, dlsym(RTLD_DEFAULT, "ompi_mpi_comm_world"));
}

template <class Function>
Function* next(const char* name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" int LAPACKE_dgetrf_work(int layout, int m, int n, double* a, int lda, int* pivots) {
    end_when_it_is_time();
    static const auto factorise = next<int(int, int, int, double*, int, int*)>("LAPACKE_dgetrf_work");
    return factorise(layout, m, n, a, lda, pivots);
}

extern "C" void smumps_c(void* data) {
    end_when_it_is_time();
    static const auto call = next<void(void*)>("smumps_c");
    call(data);
}
