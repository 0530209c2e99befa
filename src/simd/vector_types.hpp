#pragma once
// The vector of this ISA: floats and 32-bit integers in xsimd batches. Own types rather than xsimd's, because xsimd 8.1 lacks
// mask bits, compression and int/float selection, and so that no xsimd function is found by argument-dependent look-up.

#include "simd/scalar.hpp"

namespace lanecast::inline LANECAST_ISA {

struct VectorFloat {
    using Batch = xsimd::batch<float, Arch>;
    using Register = Batch::register_type;
    Register r;

    VectorFloat() = default;
    LANECAST_INLINE VectorFloat(Register register_) : r(register_) {}
    LANECAST_INLINE VectorFloat(float s) : r(Batch(s)) {}
    LANECAST_INLINE friend VectorFloat operator+(VectorFloat a, VectorFloat b) { return Register(Batch(a.r) + Batch(b.r)); }
    LANECAST_INLINE friend VectorFloat operator-(VectorFloat a, VectorFloat b) { return Register(Batch(a.r) - Batch(b.r)); }
    LANECAST_INLINE friend VectorFloat operator*(VectorFloat a, VectorFloat b) { return Register(Batch(a.r) * Batch(b.r)); }
    LANECAST_INLINE friend VectorFloat operator/(VectorFloat a, VectorFloat b) { return Register(Batch(a.r) / Batch(b.r)); }
    LANECAST_INLINE friend VectorFloat operator-(VectorFloat a) { return Register(Batch(a.r) ^ Batch(-0.0f)); }
    LANECAST_INLINE VectorFloat& operator+=(VectorFloat b) { return *this = *this + b; }
};

#if defined(__AVX512F__)
using IntRegister = __m512i;
#elif defined(__AVX2__)
using IntRegister = __m256i;
#else
using IntRegister = __m128i;
#endif

struct VectorInt {
    using Batch = xsimd::batch<std::int32_t, Arch>;
    IntRegister r;
    VectorInt() = default;
    LANECAST_INLINE VectorInt(IntRegister register_) : r(register_) {}
    LANECAST_INLINE VectorInt(std::int32_t s) : r(Batch(s)) {}
    LANECAST_INLINE friend VectorInt operator+(VectorInt a, VectorInt b) { return IntRegister(Batch(a.r) + Batch(b.r)); }
    LANECAST_INLINE friend VectorInt operator-(VectorInt a, VectorInt b) { return IntRegister(Batch(a.r) - Batch(b.r)); }
    LANECAST_INLINE friend VectorInt operator&(VectorInt a, VectorInt b) { return IntRegister(Batch(a.r) & Batch(b.r)); }
    LANECAST_INLINE friend VectorInt operator|(VectorInt a, VectorInt b) { return IntRegister(Batch(a.r) | Batch(b.r)); }
};

} // namespace lanecast::inline LANECAST_ISA
