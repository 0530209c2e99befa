#pragma once
// What a ray hit, recomputed once from t and slot when shading: a point on the surface, how far it may be off, the normal.

#include "render/kernels/cone.hpp"
#include "render/kernels/quadric.hpp"
#include "render/kernels/slots.hpp"
#include "render/kernels/triangle.hpp"

namespace lanecast::inline LANECAST_ISA {

template <FloatBatch F>
struct Surface {
    Vec3<F> point;
    Vec3<F> normal; ///< unit, faces the ray
    F offset;       ///< along the normal: beyond the error of the point (pbrt 4ed, 6.8.6)
    Mask<F> inside; ///< the ray came from where the geometric normal does not point
};

namespace detail {

// Bounds of |delta p| per component are these times magnitudes; u = 2^-24 (float), 2^-53 (double).
template <FloatBatch F>
inline constexpr Scalar<F> gamma_7 = sizeof(Scalar<F>) == 4 ? Scalar<F>(4.2e-7) : Scalar<F>(7.8e-16);
template <FloatBatch F>
inline constexpr Scalar<F> two_u = sizeof(Scalar<F>) == 4 ? Scalar<F>(1.2e-7) : Scalar<F>(2.3e-16);

template <FloatBatch F>
struct Point {
    Vec3<F> position, normal, error; ///< the normal points outside
    Mask<F> inside;                  ///< the ray came from there
};

template <FloatBatch F>
LANECAST_INLINE void merge(Point<F>& into, Mask<F> lanes, const Point<F>& from) {
    into.position = select(lanes, from.position, into.position);
    into.normal = select(lanes, from.normal, into.normal);
    into.error = select(lanes, from.error, into.error);
    into.inside = (into.inside & !lanes) | (from.inside & lanes);
}

/// The triangles of a packet's hits, and where on them the rays meet their planes.
template <FloatBatch F>
struct TriangleHit {
    Vec3<F> a, b, c, normal;
    F weight_b, weight_c; ///< both and their sum in [0, 1]
};

/// The weights of b and c by Moeller and Trumbore 1997, in double: a path of many mirrors goes astray by what its points are off
/// (selftest N17: in float, by the edges that the triangle was hit with, four times as far). Both are on the triangle, also
/// where it is seen edge-on and the determinant is nothing.
template <FloatBatch F>
LANECAST_INLINE void weigh(const Vec3<F>& org, const Vec3<F>& dir, TriangleHit<F>& hit) {
    using D = InDouble<F>;
    using Vector = DoubleVec3<F>;
    const Vector a = Vector::from(hit.a), d = Vector::from(dir), from_a = Vector::from(org) - a;
    const Vector to_b = Vector::from(hit.b) - a, to_c = Vector::from(hit.c) - a, across = cross(d, to_c);
    const F inv_det = F(1) / D::rounded(dot(to_b, across));
    const F zero(0), one(1);
    hit.weight_b = max(min(D::rounded(dot(from_a, across)) * inv_det, one), zero); // NaN: 1
    hit.weight_c = max(min(D::rounded(dot(d, cross(from_a, to_b))) * inv_det, one - hit.weight_b), zero);
}

template <FloatBatch F>
LANECAST_INLINE TriangleHit<F> triangle_hit(const SceneView& scene, const Vec3<F>& org, const Vec3<F>& dir, Int<F> slot,
                                            Mask<F> lanes) {
    using S = Scalar<F>;
    const Vec3<F> zero{F(0), F(0), F(0)};
    TriangleHit<F> hit{zero, zero, zero, zero, F(0), F(0)};
    for_each_unique<F>(slot, lanes, [&](std::int32_t s, Mask<F> same) {
        const TriangleRecord& triangle = scene.triangles[s];
        const std::uint32_t count = ((triangle.block >> 3) & 7u) + 1u;
        const float* const v =
            reinterpret_cast<const float*>(scene.arena + std::uint64_t{triangle.block >> 6} * 64u) + (triangle.block & 7u);
        const auto vertex = [&](std::uint32_t k) {
            return Vec3<F>{F(S(v[3 * k * count])), F(S(v[(3 * k + 1) * count])), F(S(v[(3 * k + 2) * count]))};
        };
        hit.a = select(same, vertex(0), hit.a);
        hit.b = select(same, vertex(1), hit.b);
        hit.c = select(same, vertex(2), hit.c);
        hit.normal = select(same, splat<F>(triangle.normal), hit.normal);
    });
    weigh(org, dir, hit);
    return hit;
}

/// By barycentric weights: on the triangle to within the bound, however far the ray came (docs/numerics.md).
template <FloatBatch F>
LANECAST_INLINE Point<F> triangle_point(const SceneView& scene, const Vec3<F>& org, const Vec3<F>& dir, Int<F> slot,
                                        Mask<F> lanes) {
    const TriangleHit<F> hit = triangle_hit(scene, org, dir, slot, lanes);
    const Vec3<F> along_b = (hit.b - hit.a) * hit.weight_b, along_c = (hit.c - hit.a) * hit.weight_c;
    return {hit.a + (along_b + along_c), hit.normal, (abs(hit.a) + abs(along_b) + abs(along_c)) * F(gamma_7<F>),
            dot(dir, hit.normal) > F(0)};
}

/// That a ray enters a body is known from its crossing, in the same numbers as when it was hit: where it grazes, the normal at
/// the rounded t may say otherwise.
template <FloatBatch F>
LANECAST_INLINE Point<F> sphere_point(const SceneView& scene, const Vec3<F>& org, const Vec3<F>& dir, F t, Int<F> slot,
                                      Mask<F> lanes) {
    using S = Scalar<F>;
    Vec3<F> centre{F(0), F(0), F(0)};
    F radius(1);
    for_each_unique<F>(slot, lanes, [&](std::int32_t s, Mask<F> same) {
        const SphereRecord& sphere = sphere_at(scene, static_cast<std::uint32_t>(s));
        centre = select(same, splat<F>(sphere.centre), centre);
        radius = select(same, F(S(sphere.radius)), radius);
    });
    const Vec3<F> n = normalize((org - centre) + dir * t);
    const F slack = radius * F(gamma_7<F>);
    const Crossing<F> ends = cross_sphere(org, centre, dir, radius, lanes);
    return {centre + n * radius, n, Vec3<F>{slack, slack, slack} + abs(centre) * F(two_u<F>), t != ends.t0};
}

/// A body's point from its point and normal in object space.
template <FloatBatch F>
LANECAST_INLINE Point<F> affine_point(const SceneView& scene, std::uint32_t record, const Vec3<F>& p, const Vec3<F>& n,
                                      Mask<F> enters) {
    const AffineRecord& affine = scene.affines[record];
    const AffineShadingRecord& forward = scene.affine_shading[record];
    const Vec3<F> translation = splat<F>(affine.translation);
    Vec3<F> position = multiply<F>(forward.world_from_object, p) + translation;
    if constexpr (sizeof(Scalar<F>) == 8) { // the two matrices are inverse to within a float only: Newton's steps to the surface
        for (int step = 0; step < 2; ++step)
            position = position + multiply<F>(forward.world_from_object, p - point_to_object(affine, position));
    }
    return {position, normalize(multiply_transposed<F>(affine.object_from_world, n)),
            multiply_absolute<F>(forward.world_from_object, abs(p)) * F(gamma_7<F> + gamma_7<F>) + abs(translation) * F(two_u<F>),
            !enters};
}

template <FloatBatch F>
LANECAST_INLINE Point<F> ellipsoid_point(const SceneView& scene, const Vec3<F>& org, const Vec3<F>& dir, F t, std::int32_t slot) {
    const std::uint32_t record = affine_index(scene, static_cast<std::uint32_t>(slot));
    const ObjectRay<F> ray(scene.affines[record], org, dir);
    const Vec3<F> p = normalize(ray.at(t));
    return affine_point(scene, record, p, p, t == cross_ellipsoid(ray, Mask<F>(true)).t0);
}

template <FloatBatch F>
LANECAST_INLINE Point<F> cylinder_point(const SceneView& scene, const Vec3<F>& org, const Vec3<F>& dir, F t, std::int32_t slot) {
    using S = Scalar<F>;
    const std::uint32_t record = affine_index(scene, static_cast<std::uint32_t>(slot));
    const ObjectRay<F> ray(scene.affines[record], org, dir);
    const CappedCrossing<F> crossing = cross_cylinder(ray, Mask<F>(true));
    const Mask<F> enters = t == crossing.ends.t0;
    const Mask<F> cap = (enters & crossing.cap0) | ((!enters) & crossing.cap1);
    const Vec3<F> q = ray.at(t);
    const F zero(0), half(S(0.5)), inv_radius = F(1) / sqrt(q.x * q.x + q.z * q.z);
    const F side = copysign(half, select(enters, -ray.dir.y, ray.dir.y)); // q.y is noise on a disc far thinner than it is far
    const Vec3<F> on_side{q.x * inv_radius, max(min(q.y, half), -half), q.z * inv_radius};
    const Vec3<F> p = select(cap, Vec3<F>{q.x, side, q.z}, on_side);
    const Vec3<F> n = select(cap, Vec3<F>{zero, side, zero}, Vec3<F>{on_side.x, zero, on_side.z});
    return affine_point(scene, record, p, n, enters);
}

/// As a cylinder's, with or without caps.
template <FloatBatch F>
LANECAST_INLINE Point<F> cone_point(const SceneView& scene, const Vec3<F>& org, const Vec3<F>& dir, F t, std::int32_t slot) {
    using S = Scalar<F>;
    const std::uint32_t record = affine_index(scene, static_cast<std::uint32_t>(slot));
    const ObjectRay<F> ray(scene.affines[record], org, dir);
    const Vec3<F>&o = ray.org, &d = ray.dir;
    const F taper(S(ray.affine.taper)), zero(0), half(S(0.5));
    const CappedCrossing<F> crossing = cross_cone(ray, Mask<F>(true));
    const Mask<F> enters = t == crossing.ends.t0;
    const Mask<F> cap = (enters & crossing.cap0) | ((!enters) & crossing.cap1);
    const Vec3<F> q = ray.at(t);
    // Onto the side along the likely error of q, which is that of the larger coordinates: on a flat cone far away that is y's.
    const F distance = sqrt(q.x * q.x + q.z * q.z);
    const F reach = abs(o.x) + abs(o.z) + F(1), rise = (abs(o.y) + half) * taper;
    const F share = rise * (abs(o.y) + half) / (reach * reach + rise * rise);
    const F y = max(min(q.y + (distance - fused(taper, q.y, F(1))) * share, half), -half);
    const F radius = max(fused(taper, y, F(1)), zero);
    const F inv_distance = select(distance > zero, F(1) / distance, zero); // 0: the apex, whose normal is the axis
    const Vec3<F> away{q.x * inv_distance, zero, q.z * inv_distance};
    const F side = copysign(half, select(enters, -d.y, d.y)); // as on a cylinder
    const Vec3<F> p = select(cap, Vec3<F>{q.x, side, q.z}, Vec3<F>{away.x * radius, y, away.z * radius});
    return affine_point(scene, record, p, select(cap, Vec3<F>{zero, side, zero}, Vec3<F>{away.x, -taper, away.z}), enters);
}

template <FloatBatch F>
LANECAST_INLINE Point<F> plane_point(const SceneView& scene, const Vec3<F>& org, const Vec3<F>& dir, F t, std::int32_t slot) {
    const PlaneRecord& plane = plane_at(scene, static_cast<std::uint32_t>(slot));
    using D = InDouble<F>;
    using Vector = DoubleVec3<F>;
    const Vec3<F> n = splat<F>(plane.normal);
    const Vector normal = Vector::splat(plane.normal), d = Vector::from(dir), p = Vector::from(org) + d * D::from(t);
    const F height = D::rounded(dot(normal, p) - D::splat(double{plane.distance})); // what the rounding of t left
    const F more = height / D::rounded(dot(normal, d)); // along the ray, so that it stays on its way, unless it grazes
    const Vec3<F> back = select(abs(more) < abs(t) * F(Scalar<F>(0.001)), dir * more, n * height);
    const Vec3<F> point = (p - Vector::from(back)).rounded();
    return {point, n, abs(point) * F(gamma_7<F>), dot(dir, n) > F(0)};
}

/// Where the rays of a packet meet primitives of any kinds.
template <FloatBatch F>
[[gnu::noinline]] Point<F> point_of_any_kind(const SceneView& scene, const Vec3<F>& org, const Vec3<F>& dir, F t, Int<F> slot,
                                             Mask<F> found) {
    const auto kind_lanes = [&](PrimitiveKind kind) {
        return found & slot_between<F>(slot, first_slot(scene, kind), end_slot(scene, kind));
    };
    const Vec3<F> zero{F(0), F(0), F(0)};
    Point<F> point{zero, {F(1), F(0), F(0)}, zero, Mask<F>(false)};
    if (const Mask<F> lanes = kind_lanes(PrimitiveKind::triangle); any(lanes))
        merge(point, lanes, triangle_point(scene, org, dir, slot, lanes));
    if (const Mask<F> lanes = kind_lanes(PrimitiveKind::sphere); any(lanes))
        merge(point, lanes, sphere_point(scene, org, dir, t, slot, lanes));
    if (const Mask<F> lanes = kind_lanes(PrimitiveKind::ellipsoid); any(lanes))
        for_each_unique<F>(slot, lanes,
                           [&](std::int32_t s, Mask<F> same) { merge(point, same, ellipsoid_point(scene, org, dir, t, s)); });
    if (const Mask<F> lanes = kind_lanes(PrimitiveKind::cylinder); any(lanes))
        for_each_unique<F>(slot, lanes,
                           [&](std::int32_t s, Mask<F> same) { merge(point, same, cylinder_point(scene, org, dir, t, s)); });
    if (const Mask<F> lanes = kind_lanes(PrimitiveKind::cone) | kind_lanes(PrimitiveKind::open_cone); any(lanes))
        for_each_unique<F>(slot, lanes,
                           [&](std::int32_t s, Mask<F> same) { merge(point, same, cone_point(scene, org, dir, t, s)); });
    if (const Mask<F> lanes = kind_lanes(PrimitiveKind::plane); any(lanes))
        for_each_unique<F>(slot, lanes,
                           [&](std::int32_t s, Mask<F> same) { merge(point, same, plane_point(scene, org, dir, t, s)); });
    return point;
}

} // namespace detail

/// Of the lanes of `found`, which is not empty.
template <FloatBatch F>
Surface<F> surface_at(const SceneView& scene, const Vec3<F>& org, const Vec3<F>& dir, F t, Int<F> slot, Mask<F> found) {
    // Where a packet met nothing but triangles there is nothing to merge; the rest is a call, so that its registers are not held
    // here. Frames of few triangles 1.04 times as fast, of meshes 1.02, of other bodies 1.00.
    const Mask<F> others = found & (slot > Int<F>(static_cast<std::int32_t>(end_slot(scene, PrimitiveKind::triangle)) - 1));
    const detail::Point<F> point = none(others) ? detail::triangle_point(scene, org, dir, slot, found)
                                                : detail::point_of_any_kind(scene, org, dir, t, slot, found);
    const Mask<F> inside = found & point.inside;
    // the offset is added to a rounded position: 2 u |p| keeps it outside whatever that rounds to
    const F offset = dot(abs(point.normal), point.error + abs(point.position) * F(detail::two_u<F>));
    return {point.position, select(inside, -point.normal, point.normal), offset, inside};
}

} // namespace lanecast::inline LANECAST_ISA
