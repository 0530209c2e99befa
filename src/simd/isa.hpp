#pragma once
// The instruction set of this translation unit, from the compiler's flags. CMake passes LANECAST_ISA, the name of the inline
// namespace that keeps the symbols of the ISAs apart (docs/building.md); everything compiled per ISA lives in it.

#if defined(__AVX512F__) || defined(__AVX2__) || defined(__SSE4_2__)
#define LANECAST_VECTOR 1
#include <immintrin.h>
#include <xsimd/xsimd.hpp>
#else
#define LANECAST_VECTOR 0
#include <emmintrin.h>
#include <x86intrin.h>
#endif

#ifndef LANECAST_ISA
#error "compile kernels with -DLANECAST_ISA=<namespace>"
#endif

// The functions of a kernel are small and always wanted inline; g++ 12 stops early in translation units this large.
#define LANECAST_INLINE inline __attribute__((always_inline))

namespace lanecast::inline LANECAST_ISA {

#if defined(__AVX512F__)
using Arch = xsimd::avx512bw;
inline constexpr char isa_name[] = "avx512";
#elif defined(__AVX2__)
using Arch = xsimd::avx2;
inline constexpr char isa_name[] = "avx2";
#elif defined(__SSE4_2__)
using Arch = xsimd::sse4_2;
inline constexpr char isa_name[] = "sse4.2";
#else
inline constexpr char isa_name[] = "scalar";
#endif

} // namespace lanecast::inline LANECAST_ISA
