#pragma once
// Where light goes at a surface: mirror direction, Snell's law, Schlick's approximation.

#include "simd/vec3.hpp"

namespace lanecast::inline LANECAST_ISA {

/// d and n unit, n facing d.
template <FloatBatch F>
LANECAST_INLINE Vec3<F> mirror(const Vec3<F>& d, const Vec3<F>& n) {
    return d - n * (F(2) * dot(d, n));
}

template <FloatBatch F>
struct Transmission {
    Vec3<F> dir;   ///< unit; the mirror direction under total internal reflection
    Mask<F> total; ///< total internal reflection
    F fresnel;     ///< Schlick's term for the reflection; 1 where there is no index
};

/// From index n1 into n2 where `index` is not 0, straight on elsewhere. `inside`: the ray is leaving the material.
template <FloatBatch F>
LANECAST_INLINE Transmission<F> transmit(const Vec3<F>& d, const Vec3<F>& n, F index, Mask<F> inside) {
    const Mask<F> bends = index > F(0);
    const F n1 = select(bends & inside, index, F(1));
    const F n2 = select(bends & !inside, index, F(1));
    const F cos_in = -dot(d, n);
    // The sine from the part of d along the surface: 1 - cos^2 is rounding where d meets the surface head on, negative half of
    // the time, and a high index multiplies it.
    const Vec3<F> bent_tangent = (d + n * cos_in) * (n1 / n2);
    const F k = F(1) - dot(bent_tangent, bent_tangent);
    const Mask<F> total = bends & (k < F(0));
    const F cos_out = sqrt(max(k, F(0)));
    const Vec3<F> bent = normalize(bent_tangent - n * cos_out);
    const Vec3<F> dir = select(total, mirror(d, n), select(bends, bent, d));

    const F ratio = (n1 - n2) / (n1 + n2);
    const F r0 = ratio * ratio;
    const F c = F(1) - select(n1 > n2, cos_out, cos_in);
    const F c2 = c * c;
    const F schlick = select(total, F(1), r0 + (F(1) - r0) * (c2 * c2 * c));
    return {dir, total, select(bends, schlick, F(1))};
}

} // namespace lanecast::inline LANECAST_ISA
