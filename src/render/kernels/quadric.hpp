#pragma once
// Rays against the unit sphere, world spheres and the capped unit cylinder, in forms whose error stays at a few ulp of t from
// close by to 1e7 radii away (docs/numerics.md).

#include "render/kernels/transform.hpp"
#include "simd/vec3.hpp"

namespace lanecast::inline LANECAST_ISA {

/// Both ends of a ray's way through a convex body, t0 <= t1, for the lanes of `hit`.
template <FloatBatch F>
struct Crossing {
    F t0, t1;
    Mask<F> hit;
};

/// What fl(a - b) = f lacks of a - b, exactly (Knuth's two-sum).
template <FloatBatch F>
LANECAST_INLINE F lost(F a, F b, F f) {
    const F b_of_f = f - a;
    return (a - (f - b_of_f)) - (b + b_of_f);
}

/// A sphere of radius r about `centre`, f = fl(org - centre). What that rounding lost, relative to the distance, is put back at
/// the closest approach: only where a ray comes near, and not for bodies in their own space. The closest approach is refined once
/// with the product exact (`fused`), so that the discriminant (r - l)(r + l) keeps its digits far away; Haines, Guenther and
/// Akenine-Moeller 2019, and docs/numerics.md.
template <bool centred, FloatBatch F>
LANECAST_INLINE Crossing<F> cross_sphere_at(const Vec3<F>& org, const Vec3<F>& centre, const Vec3<F>& f, const Vec3<F>& d, F r,
                                            Mask<F> active) {
    using S = Scalar<F>;
    const F inv_dd = F(1) / dot(d, d);
    const F tc = -dot(f, d) * inv_dd;

    // Cheap and conservative: most rays of a packet that reached this leaf still miss. 2^-18 covers the rounding of tc and rough.
    const Vec3<F> rough = f + d * tc;
    const F reach = r * F(S(1.000004)) + F(S(3.8e-6)) * abs(tc) * (abs(d.x) + abs(d.y) + abs(d.z));
    const Mask<F> close = active & (dot(rough, rough) <= reach * reach);
    if (none(close)) return {tc, tc, close};

    Vec3<F> low{};
    if constexpr (!centred) low = {lost(org.x, centre.x, f.x), lost(org.y, centre.y, f.y), lost(org.z, centre.z, f.z)};
    Vec3<F> l = fused(d, tc, f);
    if constexpr (!centred) l = l + low;
    const F k = -dot(l, d) * inv_dd;
    l = fused(d, k, l);
    const F l_length = length(l);
    const F disc = (r - l_length) * (r + l_length);
    const Mask<F> hit = close & (disc >= F(0));
    if (none(hit)) return {tc, tc, hit};

    const F h = sqrt(max(disc, F(0)) * inv_dd);
    const F tm = (tc + k) + F(0); // no -0, whose sign would choose the far root: fused negations differ in it
    const F far = tm + copysign(h, tm);
    F near = tm - copysign(h, tm);
    // close to the surface tm - h cancels: the product of the roots does not
    const Mask<F> cancels = hit & (abs(tm) <= F(2) * h);
    if (any(cancels)) {
        F product = sum_of_squares_less(f.x, f.y, f.z, r);
        if constexpr (!centred) product = product + F(S(2)) * dot(f, low);
        near = select(cancels, product * inv_dd / far, near);
    }
    return {min(near, far), max(near, far), hit};
}
template <FloatBatch F>
LANECAST_INLINE Crossing<F> cross_sphere(const Vec3<F>& org, const Vec3<F>& centre, const Vec3<F>& d, F r, Mask<F> active) {
    return cross_sphere_at<false>(org, centre, org - centre, d, r, active);
}
template <FloatBatch F>
LANECAST_INLINE Crossing<F> cross_sphere(const Vec3<F>& org, const Vec3<F>& d, F r, Mask<F> active) {
    return cross_sphere_at<true>(org, org, org, d, r, active);
}

/// Which surface of a cylinder or cone bounds each end of the crossing. Without its caps it is met at the other ends.
template <FloatBatch F>
struct CappedCrossing {
    Crossing<F> ends;
    Mask<F> cap0, cap1;
};

/// The interval inside an endless body met with the interval between the caps y = -1/2 and 1/2. No case list, so no cap can be
/// missed.
template <FloatBatch F>
LANECAST_INLINE CappedCrossing<F> clip_to_caps(const Vec3<F>& o, const Vec3<F>& d, F body0, F body1, Mask<F> body_hit) {
    using S = Scalar<F>;
    const F infinity(std::numeric_limits<S>::infinity());
    const Mask<F> level = d.y == F(0);
    const F a0 = (F(S(-0.5)) - o.y) / d.y, a1 = (F(S(0.5)) - o.y) / d.y;
    const F cap0 = select(level, -infinity, min(a0, a1));
    const F cap1 = select(level, infinity, max(a0, a1));
    const Mask<F> between = abs(o.y) <= F(S(0.5));
    const F t0 = max(body0, cap0), t1 = min(body1, cap1);
    const Mask<F> hit = body_hit & (t0 <= t1) & ((!level) | between);
    return {{t0, t1, hit}, cap0 > body0, cap1 < body1};
}

/// Radius 1, y in [-1/2, 1/2].
template <FloatBatch F>
LANECAST_INLINE CappedCrossing<F> cross_cylinder(const Vec3<F>& o, const Vec3<F>& d, Mask<F> active) {
    using S = Scalar<F>;
    const F infinity(std::numeric_limits<S>::infinity());
    const F a = d.x * d.x + d.z * d.z;
    // 2^-100: only where `a` could have lost digits to underflow. On a flat disc y counts in units of its height, so a ray may
    // well have 2^30 times more of it and still not run along the axis.
    const Mask<F> parallel = a <= d.y * d.y * F(S(7.9e-31));
    const Mask<F> within = (o.x * o.x + o.z * o.z) <= F(1);
    const Crossing<F> body = cross_sphere<F>({o.x, F(0), o.z}, {d.x, F(0), d.z}, F(1), active & (!parallel));
    const Mask<F> body_hit = body.hit | (active & parallel & within);
    if (none(body_hit)) return {{body.t0, body.t1, body_hit}, body_hit, body_hit};
    const F body0 = select(parallel, -infinity, body.t0);
    const F body1 = select(parallel, infinity, body.t1);
    return clip_to_caps(o, d, body0, body1, body_hit);
}

} // namespace lanecast::inline LANECAST_ISA
