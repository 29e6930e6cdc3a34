#pragma once

/// Before a function whose loops over pixels deserve wider registers than the oldest x86-64 has: it is
/// compiled for AVX2 as well, and the processor at hand decides at the start of the program. Results are the
/// same bit by bit, since neither sums nor products are contracted or regrouped. Without effect elsewhere,
/// and under sanitizers that are not up yet when that is decided.
#if defined(__x86_64__) && defined(__linux__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define GOALMOUTH_VECTORISED __attribute__((target_clones("avx2", "default")))
#else
#define GOALMOUTH_VECTORISED
#endif
