#pragma once
// What the tree is built over, and the four-float vectors the build works with (compiler vectors: SSE2 in baseline code).

#include "scene/scene_view.hpp"

#include <cstdint>
#include <cstring>

namespace lanecast {

/// A bounded primitive: its box, and what it is. 32 bytes, two vector loads; the bits of the fourth lanes are no numbers.
struct alignas(16) BuildRef {
    float lo[3];
    std::uint32_t item; ///< triangle of the object's mesh; index in Quadrics
    float hi[3];
    std::uint32_t source; ///< index of the object << 3 | PrimitiveKind
};

inline constexpr int source_object_shift = 3;
[[nodiscard]] inline std::uint32_t kind_of(const BuildRef& ref) noexcept { return ref.source & 7u; }
[[nodiscard]] inline std::uint32_t object_of(const BuildRef& ref) noexcept { return ref.source >> source_object_shift; }

using Float4 [[gnu::vector_size(16)]] = float;
using Int4 [[gnu::vector_size(16)]] = std::int32_t;

[[nodiscard]] inline Float4 min4(Float4 a, Float4 b) noexcept { return a < b ? a : b; }
[[nodiscard]] inline Float4 max4(Float4 a, Float4 b) noexcept { return a > b ? a : b; }
[[nodiscard]] inline Float4 splat4(float x) noexcept { return Float4{x, x, x, x}; }

/// x y z of four readable floats; the fourth lane is 0, so that no arithmetic meets the bits of an index.
[[nodiscard]] inline Float4 load_xyz(const float* p) noexcept {
    Int4 bits;
    std::memcpy(&bits, p, sizeof bits);
    return reinterpret_cast<Float4>(bits & Int4{-1, -1, -1, 0});
}
[[nodiscard]] inline Float4 lo_of(const BuildRef& ref) noexcept { return load_xyz(ref.lo); }
[[nodiscard]] inline Float4 hi_of(const BuildRef& ref) noexcept { return load_xyz(ref.hi); }

/// Half the surface of a box with these edges.
[[nodiscard]] inline float half_area(Float4 edges) noexcept { return edges[0] * (edges[1] + edges[2]) + edges[1] * edges[2]; }

/// Of four boxes at once.
[[nodiscard]] inline Float4 half_areas(const Float4 lo[4], const Float4 hi[4]) noexcept {
    const Float4 a = hi[0] - lo[0], b = hi[1] - lo[1], c = hi[2] - lo[2], d = hi[3] - lo[3];
    const Float4 ab = __builtin_shufflevector(a, b, 0, 4, 1, 5), cd = __builtin_shufflevector(c, d, 0, 4, 1, 5);
    const Float4 x = __builtin_shufflevector(ab, cd, 0, 1, 4, 5), y = __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
    const Float4 z =
        __builtin_shufflevector(__builtin_shufflevector(a, b, 2, 6, 3, 7), __builtin_shufflevector(c, d, 2, 6, 3, 7), 0, 1, 4, 5);
    return x * (y + z) + y * z;
}

inline constexpr float empty_lo = 1e30f; ///< lower corner of an empty box; the upper one is the negative

/// Primitives that lie together, with what a split needs to know of them.
struct BuildRange {
    std::uint32_t first = 0, count = 0;
    std::uint32_t capacity = 0;      ///< places from `first` on that are its own
    std::uint32_t kinds = 0;         ///< bit per PrimitiveKind
    Float4 lo{}, hi{};               ///< box of the primitives
    Float4 centre_lo{}, centre_hi{}; ///< box of lo + hi of each, twice its centre
};

[[nodiscard]] inline bool is_mixed(const BuildRange& range) noexcept { return (range.kinds & (range.kinds - 1)) != 0; }

} // namespace lanecast
