#pragma once
// Points and directions of the world in the space of an object, whose matrix is the same for all lanes.

#include "scene/scene_view.hpp"
#include "simd/vec3.hpp"

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
template <FloatBatch F>
LANECAST_INLINE Vec3<F> direction_to_object(const AffineRecord& affine, const Vec3<F>& d_world) {
    return multiply<F>(affine.object_from_world, d_world);
}

} // namespace lanecast::inline LANECAST_ISA
