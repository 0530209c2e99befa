#pragma once
// The arithmetic in which the precisions differ, chosen when a table is compiled. Each function is one sequence of operations per
// table, written out: the compiler fuses nothing of its own accord (-ffp-contract=off), because what it fuses depends on the
// code around, and a packet and a single ray must compute the same.

#include "simd/batch.hpp"

namespace lanecast::inline LANECAST_ISA {

/// a * b + c, and c - a * b: rounded once by `fast` where the ISA has fused multiply-add, twice by the others.
template <FloatBatch F>
LANECAST_INLINE F multiply_add(F a, F b, F c) {
#if LANECAST_FAST
    return fused(a, b, c);
#else
    return a * b + c;
#endif
}
template <FloatBatch F>
LANECAST_INLINE F less_product(F c, F a, F b) {
#if LANECAST_FAST
    return fused_less(c, a, b);
#else
    return c - a * b;
#endif
}

} // namespace lanecast::inline LANECAST_ISA
