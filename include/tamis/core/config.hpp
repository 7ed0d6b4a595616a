#pragma once
// Objects that kernels get from a call are not const: GCC 12 keeps const ones in memory (a store to what is const keeps
// them from being taken apart into registers).
// Kernels are written with small Eigen matrices of lanes. GCC's inliner leaves some of Eigen's operators out of line,
// and sums then go through memory (1.4 times slower on AVX2), so Eigen's own switch is set before its first header.
// Include tamis before Eigen to have the effect; the other order is correct, only slower.
#if !defined(EIGEN_STRONG_INLINE) && defined(__GNUC__) && defined(__OPTIMIZE__)
#define EIGEN_STRONG_INLINE __attribute__((always_inline)) inline
#endif
#include <Eigen/Core>

#if defined(__FAST_MATH__) && !defined(TAMIS_ALLOW_FAST_MATH)
#error \
    "tamis: -ffast-math takes away the checks for values that are not numbers, and lets results depend on the compiler's mood; leave it out, or define TAMIS_ALLOW_FAST_MATH to go without them"
#endif

#if defined(__GNUC__) && defined(__OPTIMIZE__)
#define TAMIS_INLINE __attribute__((always_inline)) inline
#define TAMIS_INLINE_LAMBDA __attribute__((always_inline))
#else
#define TAMIS_INLINE inline
#define TAMIS_INLINE_LAMBDA
#endif
// What is called seldom is compiled quickly, and small.
#if defined(__GNUC__)
#define TAMIS_NOINLINE __attribute__((noinline))
#define TAMIS_SELDOM __attribute__((noinline, cold))
#else
#define TAMIS_NOINLINE
#define TAMIS_SELDOM
#endif
// A tile loop takes in all the kernels it calls.
#if defined(__GNUC__) && defined(__OPTIMIZE__)
#define TAMIS_FLATTEN __attribute__((flatten))
#else
#define TAMIS_FLATTEN
#endif

// A loop that is neither unrolled nor peeled.
#if defined(__clang__)
#define TAMIS_KEEP_LOOP _Pragma("clang loop unroll(disable)")
#elif defined(__GNUC__)
#define TAMIS_KEEP_LOOP _Pragma("GCC unroll 1")
#else
#define TAMIS_KEEP_LOOP
#endif
// Vector registers of the target: how many sums are kept at once.
#if defined(__AVX512F__) || defined(__aarch64__) || defined(__VSX__)
#define TAMIS_VECTOR_REGISTERS 32
#else
#define TAMIS_VECTOR_REGISTERS 16
#endif

// Bytes of the widest vectors of the target, 0 where lanes are one: the compiler has no vectors of its own, or
// -DTAMIS_VECTORS=0 says so.
#if !defined(__GNUC__) || (defined(TAMIS_VECTORS) && !TAMIS_VECTORS)
#define TAMIS_VECTOR_BYTES 0
#elif defined(__AVX512F__)
#define TAMIS_VECTOR_BYTES 64
#elif defined(__AVX__)
#define TAMIS_VECTOR_BYTES 32
#elif defined(__SSE2__) || defined(__aarch64__) || defined(__VSX__)
#define TAMIS_VECTOR_BYTES 16
#else
#define TAMIS_VECTOR_BYTES 0
#endif
