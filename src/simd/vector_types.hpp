#pragma once
// The vector of this ISA: floats, doubles for `precise`, in an xsimd batch, and as many integers. Own types rather than xsimd's,
// because xsimd 8.1 lacks mask bits, compression and int/float selection, and so that no xsimd function is found by
// argument-dependent look-up.

#include "simd/scalar.hpp"

namespace lanecast::inline LANECAST_ISA {

#if LANECAST_PRECISE
using Real = double;
#else
using Real = float;
#endif

struct VectorFloat {
    using Batch = xsimd::batch<Real, Arch>;
    using Register = Batch::register_type;
    Register r;

    VectorFloat() = default;
    LANECAST_INLINE VectorFloat(Register register_) : r(register_) {}
    LANECAST_INLINE VectorFloat(Real s) : r(Batch(s)) {}
    LANECAST_INLINE friend VectorFloat operator+(VectorFloat a, VectorFloat b) { return Register(Batch(a.r) + Batch(b.r)); }
    LANECAST_INLINE friend VectorFloat operator-(VectorFloat a, VectorFloat b) { return Register(Batch(a.r) - Batch(b.r)); }
    LANECAST_INLINE friend VectorFloat operator*(VectorFloat a, VectorFloat b) { return Register(Batch(a.r) * Batch(b.r)); }
    LANECAST_INLINE friend VectorFloat operator/(VectorFloat a, VectorFloat b) { return Register(Batch(a.r) / Batch(b.r)); }
    LANECAST_INLINE friend VectorFloat operator-(VectorFloat a) { return Register(Batch(a.r) ^ Batch(Real(-0.0))); }
    LANECAST_INLINE VectorFloat& operator+=(VectorFloat b) { return *this = *this + b; }
};

#if defined(__AVX512F__) && !LANECAST_PRECISE
using IntRegister = __m512i;
#elif defined(__AVX512F__) || (defined(__AVX2__) && !LANECAST_PRECISE)
using IntRegister = __m256i;
#else
using IntRegister = __m128i;
#endif

/// As many 32-bit integers as there are lanes; of the four for two doubles the first two count. The compiler's vectors: xsimd's
/// of half the size belong to another instruction set, whose functions this one must not compile.
struct VectorInt {
    using Lanes __attribute__((vector_size(sizeof(IntRegister)))) = std::uint32_t;
    IntRegister r;
    VectorInt() = default;
    LANECAST_INLINE VectorInt(IntRegister register_) : r(register_) {}
    LANECAST_INLINE VectorInt(std::int32_t s) : r(IntRegister(Lanes{} + static_cast<std::uint32_t>(s))) {}
    LANECAST_INLINE friend VectorInt operator+(VectorInt a, VectorInt b) { return IntRegister(Lanes(a.r) + Lanes(b.r)); }
    LANECAST_INLINE friend VectorInt operator-(VectorInt a, VectorInt b) { return IntRegister(Lanes(a.r) - Lanes(b.r)); }
    LANECAST_INLINE friend VectorInt operator&(VectorInt a, VectorInt b) { return IntRegister(Lanes(a.r) & Lanes(b.r)); }
    LANECAST_INLINE friend VectorInt operator|(VectorInt a, VectorInt b) { return IntRegister(Lanes(a.r) | Lanes(b.r)); }
};

} // namespace lanecast::inline LANECAST_ISA
