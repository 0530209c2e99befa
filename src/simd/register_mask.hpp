#pragma once
// Masks of the ISAs without mask registers: all bits of a lane set or clear. And the shuffles that compress and expand by one.

#include "simd/vector_types.hpp"

namespace lanecast::inline LANECAST_ISA {

struct VectorMask {
    using Register = VectorFloat::Register;
    Register r;
    VectorMask() = default;
    LANECAST_INLINE VectorMask(Register register_) : r(register_) {}
    LANECAST_INLINE explicit VectorMask(bool b) : r(xsimd::batch_bool<Real, Arch>(b)) {}
    LANECAST_INLINE friend VectorMask operator&(VectorMask a, VectorMask b) {
        return Register(VectorFloat::Batch(a.r) & VectorFloat::Batch(b.r));
    }
    LANECAST_INLINE friend VectorMask operator|(VectorMask a, VectorMask b) {
        return Register(VectorFloat::Batch(a.r) | VectorFloat::Batch(b.r));
    }
    LANECAST_INLINE friend VectorMask operator!(VectorMask a) { return Register(~VectorFloat::Batch(a.r)); }
};
LANECAST_INLINE VectorMask operator<(VectorFloat a, VectorFloat b) {
    return VectorFloat::Register(VectorFloat::Batch(a.r) < VectorFloat::Batch(b.r));
}
LANECAST_INLINE VectorMask operator<=(VectorFloat a, VectorFloat b) {
    return VectorFloat::Register(VectorFloat::Batch(a.r) <= VectorFloat::Batch(b.r));
}
LANECAST_INLINE VectorMask operator>(VectorFloat a, VectorFloat b) { return b < a; }
LANECAST_INLINE VectorMask operator>=(VectorFloat a, VectorFloat b) { return b <= a; }
LANECAST_INLINE VectorMask operator==(VectorFloat a, VectorFloat b) {
    return VectorFloat::Register(VectorFloat::Batch(a.r) == VectorFloat::Batch(b.r));
}
LANECAST_INLINE VectorMask operator!=(VectorFloat a, VectorFloat b) { return !(a == b); }

// Byte shuffles that move the lanes of a mask to the front, and back. Built by the compiler: no code runs for them.
template <int Lanes>
struct LaneTables {
    std::uint8_t compress[1 << Lanes][Lanes]{};
    std::uint8_t expand[1 << Lanes][Lanes]{};
    constexpr LaneTables() {
        for (int m = 0; m < (1 << Lanes); ++m) {
            int n = 0;
            for (int lane = 0; lane < Lanes; ++lane) {
                if (((m >> lane) & 1) == 0) continue;
                compress[m][n] = static_cast<std::uint8_t>(lane);
                expand[m][lane] = static_cast<std::uint8_t>(n);
                ++n;
            }
        }
    }
};

} // namespace lanecast::inline LANECAST_ISA
