#pragma once
// Lights as seen from surfaces.

#include "scene/scene_view.hpp"
#include "simd/vec3.hpp"

namespace lanecast::inline LANECAST_ISA {

/// A light from a point: `to_light` ends on the light (point, spot) or is a unit vector (directional).
template <FloatBatch F>
struct LightAt {
    Vec3<F> to_light;
    Vec3<F> wi; ///< to_light, unit
    F scale;    ///< attenuation
    Mask<F> lit; ///< inside the cone
};

template <FloatBatch F>
LANECAST_INLINE LightAt<F> light_at(const LightRecord& light, const Vec3<F>& point) {
    using S = Scalar<F>;
    if (light.kind == LightKind::directional) {
        const Vec3<F> wi = -splat<F>(light.direction);
        return {wi, wi, F(1), Mask<F>(true)};
    }
    const Vec3<F> to_light = splat<F>(light.position) - point;
    const F distance = length(to_light);
    const Vec3<F> wi = to_light * (F(1) / distance);
    F scale = F(S(1) / S(light.attenuation[0]));
    if (light.attenuation[1] != 0.0f || light.attenuation[2] != 0.0f)
        scale = F(1) / (F(S(light.attenuation[0])) + distance * (F(S(light.attenuation[1])) + distance * F(S(light.attenuation[2]))));
    const Mask<F> lit = light.kind == LightKind::spot ? -dot(wi, splat<F>(light.direction)) >= F(S(light.cos_cutoff)) : Mask<F>(true);
    return {to_light, wi, scale, lit};
}

/// Point `sample` of a low-discrepancy sequence (Roberts' R2) on the unit disc, rotated per ray by its seed and per light: the same
/// points at every width, thread and tile. Concentric map of Shirley and Chiu 1997.
template <FloatBatch F>
LANECAST_INLINE void disc_sample(Int<F> seed, std::uint32_t sample, std::uint32_t light, F& x, F& y) {
    using S = Scalar<F>;
    const auto phase = [&](std::uint32_t step, std::uint32_t light_step) {
        return static_cast<std::int32_t>((sample * step + light * light_step) >> 16);
    };
    const Int<F> low(0xffff);
    const Int<F> iu = ((seed & low) + Int<F>(phase(3242174889u, 2654435769u))) & low;
    const Int<F> iv = ((shift_right(seed, 16) & low) + Int<F>(phase(2447445414u, 2246822519u))) & low;
    // centred: (i + 1/2) / 2^15 - 1 in (-1, 1)
    const F a = (to_float(iu) + F(S(0.5))) * F(S(1.0 / 32768)) - F(1);
    const F b = (to_float(iv) + F(S(0.5))) * F(S(1.0 / 32768)) - F(1);
    const Mask<F> wide = abs(a) > abs(b);
    const F r = select(wide, a, b);
    const F angle = F(S(0.78539816339744831)) * select(wide, b / a, a / b); // |angle| <= pi / 4
    const F q = angle * angle;
    const F sine = angle * (F(1) + q * (F(S(-1.0 / 6)) + q * (F(S(1.0 / 120)) + q * F(S(-1.0 / 5040)))));
    const F cosine = F(1) + q * (F(S(-0.5)) + q * (F(S(1.0 / 24)) + q * (F(S(-1.0 / 720)) + q * F(S(1.0 / 40320)))));
    x = r * select(wide, cosine, sine);
    y = r * select(wide, sine, cosine);
}

/// Two unit vectors that make a right-handed frame with the unit vector n (Duff et al. 2017).
template <FloatBatch F>
LANECAST_INLINE void frame_around(const Vec3<F>& n, Vec3<F>& s, Vec3<F>& t) {
    const F sign = copysign(F(1), n.z);
    const F a = F(Scalar<F>(-1)) / (sign + n.z);
    const F b = n.x * n.y * a;
    s = {F(1) + sign * n.x * n.x * a, sign * b, -sign * n.x};
    t = {b, sign + n.y * n.y * a, -n.y};
}

/// As `to_light` of `at`, towards a sample of the light's disc (point, spot: radius, across the line of sight; directional: the
/// sine of its half angle).
template <FloatBatch F>
LANECAST_INLINE Vec3<F> sample_light(const LightRecord& light, const LightAt<F>& at, Int<F> seed, std::uint32_t sample,
                                     std::uint32_t light_index) {
    using S = Scalar<F>;
    F x, y;
    disc_sample<F>(seed, sample, light_index, x, y);
    Vec3<F> s, t;
    frame_around(at.wi, s, t);
    const Vec3<F> across = (s * x + t * y) * F(S(light.radius));
    if (light.kind != LightKind::directional) return at.to_light + across;
    return at.to_light * sqrt(max(F(1) - dot(across, across), F(0))) + across;
}

} // namespace lanecast::inline LANECAST_ISA
