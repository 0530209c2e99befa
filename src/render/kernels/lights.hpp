#pragma once
// Lights as seen from surfaces.

#include "scene/scene_view.hpp"
#include "simd/vec3.hpp"

namespace lanecast::inline LANECAST_ISA {

/// A light from a point: `to_light` ends on the light (point, spot) or is a unit vector (directional).
template <FloatBatch F>
struct LightAt {
    Vec3<F> to_light;
    Vec3<F> wi;  ///< to_light, unit
    F scale;     ///< attenuation
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
        scale =
            F(1) / (F(S(light.attenuation[0])) + distance * (F(S(light.attenuation[1])) + distance * F(S(light.attenuation[2]))));
    const Mask<F> lit =
        light.kind == LightKind::spot ? -dot(wi, splat<F>(light.direction)) >= F(S(light.cos_cutoff)) : Mask<F>(true);
    return {to_light, wi, scale, lit};
}

/// Point `sample` of `samples` on the unit disc: rings of equal area, each point a golden angle on from the last (Vogel 1979). A
/// seed turns them all and moves the rings, by light another way, so that the mean over seeds is the disc's, and the points are
/// the same at every width, thread and tile. A shadow's edge parts them better than points spread over a square and bent.
template <FloatBatch F>
LANECAST_INLINE void disc_sample(Int<F> seed, std::uint32_t sample, std::uint32_t samples, std::uint32_t light, F& x, F& y) {
    using S = Scalar<F>;
    const Int<F> moved = multiply_add(seed, 1u, light * 2246822519u);
    const F ring = (to_float(moved & Int<F>(0xffff)) + F(S(0.5))) * F(S(1.0 / 65536)); // in (0, 1)
    const F r = sqrt((F(static_cast<S>(sample)) + ring) * F(S(1) / static_cast<S>(samples)));
    // the golden angle times 2^32 / 2 pi; a quarter of the angle, |.| <= pi / 4
    const F angle = to_float(multiply_add(moved, 1u, sample * 2654435769u)) * F(S(0.78539816339744831 / 2147483648.0));
    const F q = angle * angle;
    const F sine = angle * (F(1) + q * (F(S(-1.0 / 6)) + q * (F(S(1.0 / 120)) + q * F(S(-1.0 / 5040)))));
    const F cosine = F(1) + q * (F(S(-0.5)) + q * (F(S(1.0 / 24)) + q * (F(S(-1.0 / 720)) + q * F(S(1.0 / 40320)))));
    const F sine2 = F(2) * sine * cosine, cosine2 = F(1) - F(2) * sine * sine;
    x = r * (F(1) - F(2) * sine2 * sine2);
    y = r * (F(2) * sine2 * cosine2);
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
                                     std::uint32_t samples, std::uint32_t light_index) {
    using S = Scalar<F>;
    F x, y;
    disc_sample<F>(seed, sample, samples, light_index, x, y);
    Vec3<F> s, t;
    frame_around(at.wi, s, t);
    const Vec3<F> across = (s * x + t * y) * F(S(light.radius));
    if (light.kind != LightKind::directional) return at.to_light + across;
    return at.to_light * sqrt(max(F(1) - dot(across, across), F(0))) + across;
}

} // namespace lanecast::inline LANECAST_ISA
