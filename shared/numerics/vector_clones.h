#pragma once

// Functions marked so are compiled for several instruction sets; the loader picks the widest one the processor has.
// Under sanitizers there is one only: the loader would call its instrumented choice before the sanitizer is ready.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_THREAD__) && \
    !defined(__SANITIZE_ADDRESS__)
#define ENDOFLOW_VECTOR_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define ENDOFLOW_VECTOR_CLONES
#endif
