#pragma once

/// @file
/// MEMS_STICTION_VECTORIZED marks a function that passes over the whole frame: it is compiled
/// twice, for every x86-64 processor and for those with AVX2, and the processor chooses at run
/// time. Both give the same bits: sums run in fixed packets, and AVX2 alone brings no fused
/// multiply-add. MEMS_STICTION_WIDELY_VECTORIZED, for packets of 64 bytes, is compiled for AVX-512
/// as well, of which -ffp-contract=off keeps the fused ones away. The CMake option
/// MEMS_STICTION_PORTABLE leaves all but the first one out.

#if !defined(MEMS_STICTION_PORTABLE) && defined(__x86_64__) && defined(__GNUC__) && \
    !defined(__clang__) && defined(__linux__)
#define MEMS_STICTION_VECTORIZED __attribute__((target_clones("avx2", "default")))
#define MEMS_STICTION_WIDELY_VECTORIZED __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define MEMS_STICTION_VECTORIZED
#define MEMS_STICTION_WIDELY_VECTORIZED
#endif

/// Marks a small function that becomes part of the vectorized functions that call it.
#if defined(__GNUC__)
#define MEMS_STICTION_INLINE inline __attribute__((always_inline))
#else
#define MEMS_STICTION_INLINE inline
#endif
