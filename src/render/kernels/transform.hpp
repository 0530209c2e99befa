#pragma once
// Points and directions of the world in the space of an object, whose matrix is the same for all lanes.

#include "scene/scene_view.hpp"
#include "simd/double_vec3.hpp"

namespace lanecast::inline LANECAST_ISA {

/// m * v, m row-major.
template <FloatBatch F>
LANECAST_INLINE Vec3<F> multiply(const float (&m)[9], const Vec3<F>& v) {
    using S = Scalar<F>;
    const auto row = [&](int i) { return dot<F>({F(S(m[i])), F(S(m[i + 1])), F(S(m[i + 2]))}, v); };
    return {row(0), row(3), row(6)};
}
/// transpose(m) * v: with m = object_from_world, a normal's way back to the world (the inverse transpose).
template <FloatBatch F>
LANECAST_INLINE Vec3<F> multiply_transposed(const float (&m)[9], const Vec3<F>& v) {
    using S = Scalar<F>;
    const auto column = [&](int i) { return dot<F>({F(S(m[i])), F(S(m[i + 3])), F(S(m[i + 6]))}, v); };
    return {column(0), column(1), column(2)};
}
/// |m| * v for v >= 0: how far errors of v can reach.
template <FloatBatch F>
LANECAST_INLINE Vec3<F> multiply_absolute(const float (&m)[9], const Vec3<F>& v) {
    using S = Scalar<F>;
    const auto row = [&](int i) { return abs(F(S(m[i]))) * v.x + abs(F(S(m[i + 1]))) * v.y + abs(F(S(m[i + 2]))) * v.z; };
    return {row(0), row(3), row(6)};
}

/// Translated first, then the 3x3 inverse: the error stays at 5e-7 of the object for any translation, where the usual 3x4 inverse
/// gives 1e-3 at 1e4 (docs/numerics.md).
template <FloatBatch F>
LANECAST_INLINE Vec3<F> point_to_object(const AffineRecord& affine, const Vec3<F>& p_world) {
    return multiply<F>(affine.object_from_world, p_world - splat<F>(affine.translation));
}

namespace detail {

/// A row of object_from_world.
template <FloatBatch F>
LANECAST_INLINE DoubleVec3<F> row_of(const AffineRecord& affine, int row) {
    const float* const m = affine.object_from_world + 3 * row;
    return DoubleVec3<F>::splat({m[0], m[1], m[2]});
}
/// object_from_world * v, each component rounded once.
template <FloatBatch F>
LANECAST_INLINE Vec3<F> multiply_exactly(const AffineRecord& affine, const DoubleVec3<F>& v) {
    return DoubleVec3<F>{dot(row_of<F>(affine, 0), v), dot(row_of<F>(affine, 1), v), dot(row_of<F>(affine, 2), v)}.rounded();
}

} // namespace detail

/// A ray in the space of an object. `org` and `dir` are off by some u times their lengths, in units of the thinnest part of the
/// object. Where that matters, `at` computes a point anew, in double, and `refine` the direction, so that a ray nearly along a
/// thin body stays on its way.
template <FloatBatch F>
struct ObjectRay {
    const AffineRecord& affine;
    const Vec3<F>&org_world, &dir_world;
    Vec3<F> org, dir;

    LANECAST_INLINE ObjectRay(const AffineRecord& affine_, const Vec3<F>& org_, const Vec3<F>& dir_)
        : affine(affine_), org_world(org_), dir_world(dir_), org(point_to_object(affine_, org_)),
          dir(multiply<F>(affine_.object_from_world, dir_)) {}

    LANECAST_INLINE void refine() { dir = detail::multiply_exactly(affine, DoubleVec3<F>::from(dir_world)); }
    /// The point at t, rounded once.
    [[nodiscard]] LANECAST_INLINE Vec3<F> at(F t) const { return detail::multiply_exactly(affine, from_centre(t)); }
    /// The t at height y, from the exact height of the origin: of a ray that is nearly level org.y alone tells little. Where
    /// dir.y is no more than rounding, t is huge, and its sign still tells whether the origin is above or below.
    [[nodiscard]] LANECAST_INLINE F meet_height(double y) const {
        const DoubleVec3<F> org_centre = DoubleVec3<F>::from(org_world) - DoubleVec3<F>::splat(affine.translation);
        return D::rounded(D::splat(y) - dot(detail::row_of<F>(affine, 1), org_centre)) / dir.y;
    }
    /// Where the true ray meets the body, this ray is at most so far from it. There |t dir_world| is at most the distance and
    /// `radius`; rounding may reach 18 u of all these, so that 170 u leave room for that of whoever asks.
    [[nodiscard]] LANECAST_INLINE F slack() const {
        const Vec3<F> f = abs(org_world - splat<F>(affine.translation));
        return F(Scalar<F>(affine.stretch) * Scalar<F>(1e-5)) * (f.x + f.y + f.z + F(Scalar<F>(affine.radius)));
    }

private:
    using D = InDouble<F>;

    [[nodiscard]] LANECAST_INLINE DoubleVec3<F> from_centre(F t) const {
        return DoubleVec3<F>::from(org_world) - DoubleVec3<F>::splat(affine.translation) +
               DoubleVec3<F>::from(dir_world) * D::from(t);
    }
};

} // namespace lanecast::inline LANECAST_ISA
