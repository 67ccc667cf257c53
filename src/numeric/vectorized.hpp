#pragma once

/// @file
/// MEMS_STICTION_VECTORIZED marks a function that passes over the whole frame: it is compiled
/// twice, for every x86-64 processor and for those with AVX2, and the processor chooses at run
/// time. Both give the same bits: sums run in fixed packets, and AVX2 alone brings no fused
/// multiply-add. The CMake option MEMS_STICTION_PORTABLE leaves the second one out.

#if !defined(MEMS_STICTION_PORTABLE) && defined(__x86_64__) && defined(__GNUC__) && \
    !defined(__clang__) && defined(__linux__)
#define MEMS_STICTION_VECTORIZED __attribute__((target_clones("avx2", "default")))
#else
#define MEMS_STICTION_VECTORIZED
#endif

/// Marks a small function that becomes part of the vectorized functions that call it.
#if defined(__GNUC__)
#define MEMS_STICTION_INLINE inline __attribute__((always_inline))
#else
#define MEMS_STICTION_INLINE inline
#endif
