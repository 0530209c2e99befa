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

/// A ray about to meet a sphere of the world. What the rounding of `org` = fl(org - centre) lost, relative to the distance, is
/// put back where it counts.
template <FloatBatch F>
struct SphereRay {
    Vec3<F> org_world, centre, dir, org;

    LANECAST_INLINE SphereRay(const Vec3<F>& org_, const Vec3<F>& centre_, const Vec3<F>& dir_)
        : org_world(org_), centre(centre_), dir(dir_), org(org_ - centre_) {}
    [[nodiscard]] LANECAST_INLINE Vec3<F> low() const {
        return {lost(org_world.x, centre.x, org.x), lost(org_world.y, centre.y, org.y), lost(org_world.z, centre.z, org.z)};
    }
    [[nodiscard]] LANECAST_INLINE Vec3<F> at(F t) const { return fused(dir, t, org) + low(); }
    /// At most how far rounding moves the closest approach: 2^-18 of the distance.
    [[nodiscard]] LANECAST_INLINE F slack() const { return F(Scalar<F>(3.8e-6)) * (abs(org.x) + abs(org.y) + abs(org.z)); }
    /// |org|^2 - r^2
    [[nodiscard]] LANECAST_INLINE F power(F r) const {
        return sum_of_squares_less(org.x, org.y, org.z, r) + F(Scalar<F>(2)) * dot(org, low());
    }
};
/// One in the space of an ellipsoid.
template <FloatBatch F>
struct EllipsoidRay : ObjectRay<F> {
    [[nodiscard]] LANECAST_INLINE F power(F r) const { return sum_of_squares_less(this->org.x, this->org.y, this->org.z, r); }
};
/// One in the space of a cylinder, seen along its axis.
template <FloatBatch F>
struct CylinderRay {
    const ObjectRay<F>& ray;
    Vec3<F> org, dir;

    LANECAST_INLINE explicit CylinderRay(const ObjectRay<F>& ray_)
        : ray(ray_), org{ray_.org.x, F(0), ray_.org.z}, dir{ray_.dir.x, F(0), ray_.dir.z} {}
    [[nodiscard]] LANECAST_INLINE Vec3<F> at(F t) const {
        const Vec3<F> p = ray.at(t);
        return {p.x, F(0), p.z};
    }
    [[nodiscard]] LANECAST_INLINE F slack() const { return ray.slack(); }
    [[nodiscard]] LANECAST_INLINE F power(F r) const { return sum_of_squares_less(org.x, org.y, org.z, r); }
};

/// Whether a ray of one of the kinds above may meet the sphere of radius r about the origin: cheap and conservative, for most
/// rays of a packet that reached this leaf still miss. A ray without direction may.
template <FloatBatch F, class Ray>
LANECAST_INLINE Mask<F> comes_near(const Ray& ray, F r) {
    const F tc = -dot(ray.org, ray.dir) * (F(1) / dot(ray.dir, ray.dir));
    const Vec3<F> rough = ray.org + ray.dir * tc;
    const F reach = r * F(Scalar<F>(1.000004)) + ray.slack();
    return !(dot(rough, rough) > reach * reach);
}

/// Where it does. The closest approach is found once more from its exact place (`at`), so that the discriminant (r - l)(r + l)
/// keeps its digits far away; Haines, Guenther and Akenine-Moeller 2019, and docs/numerics.md.
template <FloatBatch F, class Ray>
LANECAST_INLINE Crossing<F> cross_round(const Ray& ray, F r, Mask<F> active) {
    const F inv_dd = F(1) / dot(ray.dir, ray.dir);
    const F tc = -dot(ray.org, ray.dir) * inv_dd;
    Vec3<F> l = ray.at(tc);
    const F k = -dot(l, ray.dir) * inv_dd;
    l = fused(ray.dir, k, l);
    const F l_length = length(l);
    const F disc = (r - l_length) * (r + l_length);
    const Mask<F> hit = active & (disc >= F(0));
    if (none(hit)) return {tc, tc, hit};

    const F h = sqrt(max(disc, F(0)) * inv_dd);
    const F tm = (tc + k) + F(0); // no -0, whose sign would choose the far root: fused negations differ in it
    const F far = tm + copysign(h, tm);
    F near = tm - copysign(h, tm);
    // close to the surface tm - h cancels: the product of the roots does not
    const Mask<F> cancels = hit & (abs(tm) <= F(2) * h);
    if (any(cancels)) near = select(cancels, ray.power(r) * inv_dd / far, near);
    return {min(near, far), max(near, far), hit};
}
template <FloatBatch F>
LANECAST_INLINE Crossing<F> cross_sphere(const Vec3<F>& org, const Vec3<F>& centre, const Vec3<F>& dir, F r, Mask<F> active) {
    const SphereRay<F> ray(org, centre, dir);
    const Mask<F> near = active & comes_near(ray, r);
    if (none(near)) return {r, r, near};
    return cross_round(ray, r, near);
}
template <FloatBatch F>
LANECAST_INLINE Crossing<F> cross_ellipsoid(ObjectRay<F> ray, Mask<F> active) {
    const Mask<F> near = active & comes_near(ray, F(1));
    if (none(near)) return {ray.org.x, ray.org.x, near};
    ray.refine();
    return cross_round(EllipsoidRay<F>{ray}, F(1), near);
}

/// Which surface of a cylinder or cone bounds each end of the crossing. Without its caps it is met at the other ends.
template <FloatBatch F>
struct CappedCrossing {
    Crossing<F> ends;
    Mask<F> cap0, cap1;
};

/// The interval inside an endless body met with that between the caps y = -1/2 and 1/2, met at a0 and a1 or the other way round.
/// No case list, so no cap can be missed.
template <FloatBatch F>
LANECAST_INLINE CappedCrossing<F> clip_to_caps(const Vec3<F>& o, const Vec3<F>& d, F a0, F a1, F body0, F body1,
                                               Mask<F> body_hit) {
    using S = Scalar<F>;
    const F infinity(std::numeric_limits<S>::infinity());
    const Mask<F> level = d.y == F(0);
    const F cap0 = select(level, -infinity, min(a0, a1));
    const F cap1 = select(level, infinity, max(a0, a1));
    const Mask<F> between = abs(o.y) <= F(S(0.5));
    const F t0 = max(body0, cap0), t1 = min(body1, cap1);
    const Mask<F> hit = body_hit & (t0 <= t1) & ((!level) | between);
    return {{t0, t1, hit}, cap0 > body0, cap1 < body1};
}

/// Radius 1, y in [-1/2, 1/2].
template <FloatBatch F>
LANECAST_INLINE CappedCrossing<F> cross_cylinder(ObjectRay<F> ray, Mask<F> active) {
    using S = Scalar<F>;
    const F infinity(std::numeric_limits<S>::infinity());
    active = active & comes_near(CylinderRay<F>(ray), F(1));
    if (none(active)) return {{infinity, infinity, active}, active, active};
    ray.refine();
    const Vec3<F>&o = ray.org, &d = ray.dir;
    const F a = d.x * d.x + d.z * d.z;
    // 2^-100: only where `a` could have lost digits to underflow. On a flat disc y counts in units of its height, so a ray may
    // well have 2^30 times more of it and still not run along the axis.
    const Mask<F> parallel = a <= d.y * d.y * F(S(7.9e-31));
    const Mask<F> within = (o.x * o.x + o.z * o.z) <= F(1);
    const Crossing<F> body = cross_round(CylinderRay<F>(ray), F(1), active & (!parallel));
    const Mask<F> body_hit = body.hit | (active & parallel & within);
    if (none(body_hit)) return {{body.t0, body.t1, body_hit}, body_hit, body_hit};
    const F body0 = select(parallel, -infinity, body.t0);
    const F body1 = select(parallel, infinity, body.t1);
    return clip_to_caps(o, d, ray.meet_height(-0.5), ray.meet_height(0.5), body0, body1, body_hit);
}

} // namespace lanecast::inline LANECAST_ISA
