#pragma once
// Rays in memory: the arrays that a batch of rays lives in, and the allocator that lays them out in the scratch block.

#include "render/kernel_table.hpp"
#include "simd/vec3.hpp"

#include <cstdint>

namespace lanecast::inline LANECAST_ISA {

/// Hands out 64-byte aligned arrays of a block; over a null block it only measures.
class ScratchLayout {
public:
    explicit ScratchLayout(void* block) : base_(static_cast<unsigned char*>(block)) {}

    template <class T>
    T* take(std::uint64_t count) {
        T* const p = base_ == nullptr ? nullptr : reinterpret_cast<T*>(base_ + used_);
        used_ += (count * sizeof(T) + 63) / 64 * 64;
        return p;
    }
    template <class T>
    void take3(T* (&p)[3], std::uint64_t count) {
        for (T*& axis : p) axis = take<T>(count);
    }
    [[nodiscard]] std::uint64_t used() const { return used_; }

private:
    unsigned char* base_;
    std::uint64_t used_ = 0;
};

// A ray remembers the primitive it leaves, so that no epsilon is needed: planes and triangles are never hit by their own rays,
// a quadric not at all by a ray that leaves it outwards and only at its far side by one that goes in.
inline constexpr std::int32_t no_source = -1;
template <class I>
LANECAST_INLINE I source_outward(I slot) {
    return slot + slot;
}
template <class I>
LANECAST_INLINE I source_inward(I slot) {
    return slot + slot + I(1);
}

/// The tmax of a ray without one: finite, so that a ray along a plane, whose t is infinite, misses it.
template <class S>
inline constexpr S no_limit = std::numeric_limits<S>::max();

inline void remember(Occluders& occluders, std::uint64_t child) {
    std::uint32_t place = 0;
    while (place < occluders.count && occluders.leaf[place] != child) ++place;
    if (place == occluders.count && occluders.count < occluder_capacity) ++occluders.count;
    if (place == occluder_capacity) --place;
    for (; place > 0; --place) occluders.leaf[place] = occluders.leaf[place - 1];
    occluders.leaf[0] = child;
}
inline void forget(Occluders& occluders, std::uint32_t place) {
    --occluders.count;
    for (; place < occluders.count; ++place) occluders.leaf[place] = occluders.leaf[place + 1];
}

/// Up to `capacity` rays, dense, and what tracing them gave. Arrays have a vector of slack.
template <FloatBatch F>
struct RayBatch {
    using S = Scalar<F>;
    S* org[3];
    S* dir[3];
    std::int32_t* source;
    S* t;                      ///< out: of the hit, in units of |dir|
    std::int32_t* slot;        ///< out: -1 for a miss
    S tmin;                    ///< of every ray; a hit has t > tmin
    S tmax;                    ///< and t <= tmax, finite
    const S* tmins;            ///< per ray, or null
    const S* tmaxs;            ///< per ray, or null
    Occluders* occluders;      ///< or null; of the light that all rays go to
    const std::int32_t* after; ///< per ray, or null: hits at t == tmin count when their scene id is larger than this

    void allocate(ScratchLayout& layout, std::uint32_t capacity) {
        const std::uint64_t n = capacity + width<F>;
        layout.take3(org, n);
        layout.take3(dir, n);
        source = layout.take<std::int32_t>(n);
        t = layout.take<S>(n);
        slot = layout.take<std::int32_t>(n);
        tmin = 0;
        tmax = no_limit<S>;
        tmins = nullptr;
        tmaxs = nullptr;
        after = nullptr;
        occluders = nullptr;
    }
};

} // namespace lanecast::inline LANECAST_ISA
