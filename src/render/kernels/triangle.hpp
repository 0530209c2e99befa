#pragma once
// Rays against triangles: Woop, Benthin and Wald 2013, "Watertight Ray/Triangle Intersection", in plain float. The one function
// that accepts a triangle and gives its t, whatever proposed it: a function of the ray and the triangle alone.

#include "simd/vec3.hpp"

namespace lanecast::inline LANECAST_ISA {

/// The axes of a ray, kz the one along which |dir| is largest (the lowest on ties), in cyclic order.
struct Axes {
    int kx, ky, kz;
};
LANECAST_INLINE Axes axes_of(int kz) { return {(kz + 1) % 3, (kz + 2) % 3, kz}; }

/// A ray sheared so that it runs along kz: the origin permuted, dir[kx] / dir[kz], dir[ky] / dir[kz], 1 / dir[kz].
template <FloatBatch F>
struct ShearedRay {
    Vec3<F> org;
    Vec3<F> shear;
};

/// Where a ray meets the plane of a triangle, by edge functions: the barycentric weight of a is u / det.
template <FloatBatch F>
struct TriangleEdges {
    F u, v, w;
    F az, bz, cz; ///< depths of the vertices, times det's sign-free scale
    Mask<F> inside;
};

/// A, B, C: the vertices less the ray's origin, in the ray's axes. Both neighbours of an edge compare the same two products, and
/// rounding is monotone, so with the inclusive test no ray passes between them: 0 leaks in 1e9 edge- and 1e9 vertex-aimed rays.
/// A triangle seen edge-on may tie at all edges, for rays beside it too: the ray must lie in the span of the vertices.
/// Where no edge ties, the signs of the differences say the same: rounding being monotone, they are those of the exact products,
/// and a point strictly inside lies within the span. A product that overflows leaves no t (`triangle_t`).
template <FloatBatch F>
LANECAST_INLINE TriangleEdges<F> triangle_edges(const Vec3<F>& shear, const Vec3<F>& A, const Vec3<F>& B, const Vec3<F>& C) {
    const F ax = less_product(A.x, shear.x, A.z), ay = less_product(A.y, shear.y, A.z);
    const F bx = less_product(B.x, shear.x, B.z), by = less_product(B.y, shear.y, B.z);
    const F cx = less_product(C.x, shear.x, C.z), cy = less_product(C.y, shear.y, C.z);
    const F u0 = cx * by, u1 = cy * bx;
    const F v0 = ax * cy, v1 = ay * cx;
    const F w0 = bx * ay, w1 = by * ax;
    const F u = u0 - u1, v = v0 - v1, w = w0 - w1; // never fused: the neighbour's must be their negatives
    const F least_by_largest = min(min(u, v), w) * max(max(u, v), w);
    Mask<F> inside = least_by_largest > F(0);
    if (!none(least_by_largest == F(0))) [[unlikely]] { // a tie, or a product too small to tell
        const Mask<F> front = (u0 >= u1) & (v0 >= v1) & (w0 >= w1);
        const Mask<F> back = (u0 <= u1) & (v0 <= v1) & (w0 <= w1);
        const Mask<F> spans = max(min(ax * bx, ax * cx), min(ay * by, ay * cy)) <= F(0);
        inside = (front | back) & spans;
    }
    return {u, v, w, A.z, B.z, C.z, inside};
}
template <FloatBatch F>
LANECAST_INLINE TriangleEdges<F> triangle_edges(const ShearedRay<F>& ray, const Vec3<F>& a, const Vec3<F>& b, const Vec3<F>& c) {
    return triangle_edges(ray.shear, a - ray.org, b - ray.org, c - ray.org);
}

/// Of the ray, in units of |dir|; NaN, which no range accepts, for a triangle seen edge-on (det = 0).
template <FloatBatch F>
LANECAST_INLINE F triangle_t(F inv_dz, const TriangleEdges<F>& e) {
    const F det = e.u + e.v + e.w;
    return dot<F>({e.u, e.v, e.w}, {inv_dz * e.az, inv_dz * e.bz, inv_dz * e.cz}) / det;
}

} // namespace lanecast::inline LANECAST_ISA
