#pragma once
// Rays against truncated cones: the unit cylinder with radius 1 + taper * y at height y, |taper| <= 2, so that both tips are in
// reach. With taper 0 this is the cylinder; with or without caps, one function serves both.

#include "render/kernels/quadric.hpp"

namespace lanecast::inline LANECAST_ISA {

/// In (x, z, rho), rho = 1 + taper * y, every such cone is x^2 + z^2 = rho^2 with its apex at the origin. The quadratic is solved
/// from the ray's closest approach to it, found once in double, and there it is decided what is hit: the errors are
/// a few ulp of the radius, however far the ray came. Compared as t, a side and a cap that a far ray meets within an ulp of t
/// would count as meeting each other, outside the body's box. The solid is the nappe rho >= 0, which is convex: the ray's way
/// through it, an interval that may be endless, is met with that between the caps.
template <FloatBatch F>
LANECAST_INLINE CappedCrossing<F> cross_cone(ObjectRay<F> ray, Mask<F> active) {
    using S = Scalar<F>;
    active = active & comes_near(ray, F(S(2.0616))); // both tips: radius 2 at y = 1/2
    const F zero(0), infinity(std::numeric_limits<S>::infinity());
    if (none(active)) return {{infinity, infinity, active}, active, active};
    ray.refine();
    const Vec3<F>&o = ray.org, &d = ray.dir;
    const F taper(S(ray.affine.taper));
    const Vec3<F> f{o.x, o.z, fused(taper, o.y, F(1))}, v{d.x, d.z, taper * d.y};
    const F vv = dot(v, v);
    const Mask<F> parallel = vv <= d.y * d.y * F(S(7.9e-31)); // 2^-100: as cross_cylinder; along the axis of a cylinder
    const Mask<F> within = (f.z > zero) & (f.x * f.x + f.y * f.y <= f.z * f.z);

    // From the closest approach on, along the unit direction e: a s^2 + 2 b s + c = 0 in units of |v|.
    const F inv_length = F(1) / sqrt(select(parallel, F(1), vv));
    const Vec3<F> e = v * inv_length;
    const F tm = select(parallel, zero, -dot(f, e) * inv_length);
    const Vec3<F> closest = ray.at(tm), l{closest.x, closest.z, fused(taper, closest.y, F(1))};
    const F a = e.x * e.x + e.y * e.y - e.z * e.z;
    const Mask<F> shallow = a > zero; // than the side: both ends, if any, are on one nappe, else one is on each
    // b^2 - a c as Gram's determinant, a difference of two lengths that do not cancel
    const F wx = l.z * e.x - e.z * l.x, wy = l.z * e.y - e.z * l.y;
    const F w = sqrt(wx * wx + wy * wy), n = abs(l.x * e.y - l.y * e.x);
    const F disc = (w - n) * (w + n);
    const Mask<F> meets = active & (!parallel) & ((disc >= zero) | !shallow);
    const Mask<F> runs_within = active & parallel & within;
    if (none(meets | runs_within)) return {{tm, tm, meets}, meets, meets};

    const F root = sqrt(max(disc, zero));
    const F b = l.x * e.x + l.y * e.y - l.z * e.z, c = l.x * l.x + l.y * l.y - l.z * l.z;
    const F q = -(b + copysign(root, b));
    const F sb = select(q == zero, zero, c / q);
    const F sa = select(a == zero, copysign(infinity, b), q / a); // a ray along the side meets it once
    const Mask<F> widens = e.z > zero; // a steep ray that goes where the cone widens enters at the later end and never leaves
    const Mask<F> enters = (!parallel) & (shallow | widens), leaves = (!parallel) & (shallow | !widens);
    const F lo = min(sa, sb) * inv_length, hi = max(sa, sb) * inv_length;
    const F body0 = select(enters, select(shallow, lo, hi), -infinity);
    const F body1 = select(leaves, select(shallow, hi, lo), infinity);
    const F below = (F(S(-0.5)) - closest.y) / d.y, above = (F(S(0.5)) - closest.y) / d.y;
    const CappedCrossing<F> local = clip_to_caps(closest, d, below, above, body0, body1, meets | runs_within);
    if (none(local.ends.hit)) return local;

    // Told as t, where a sum that cancels may not lead past the caps.
    const F cap_a = ray.meet_height(-0.5), cap_b = ray.meet_height(0.5);
    const Mask<F> level = d.y == zero;
    const F cap0 = select(level, -infinity, min(cap_a, cap_b)), cap1 = select(level, infinity, max(cap_a, cap_b));
    const F t0 = max(cap0, tm + body0), t1 = min(cap1, tm + body1);
    return {{t0, t1, local.ends.hit}, local.cap0, local.cap1};
}

} // namespace lanecast::inline LANECAST_ISA
