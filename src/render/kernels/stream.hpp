#pragma once
// The library's entry points: rays of any number and alignment, in batches through the same `trace` as the renderer's. What
// has units is converted in a copy; a short stream pays for its own length only.

#include "render/kernels/stream_attributes.hpp"
#include "render/kernels/trace.hpp"

namespace lanecast::inline LANECAST_ISA {

inline constexpr std::uint32_t coherent_chunk = 512; ///< rays per batch; others find more of their octant in 1024

template <FloatBatch F>
struct StreamBatch {
    static constexpr std::uint32_t stride = max_batch_rays + width<F>;
    alignas(64) Scalar<F> floats[9][stride];
    alignas(64) std::int32_t integers[2][stride];

    [[nodiscard]] RayBatch<F> rays(const RayStream& stream) {
        using S = Scalar<F>;
        RayBatch<F> batch{};
        for (int axis = 0; axis < 3; ++axis) {
            batch.org[axis] = floats[axis];
            batch.dir[axis] = floats[3 + axis];
        }
        batch.source = integers[0];
        batch.t = floats[6];
        batch.slot = integers[1];
        batch.tmin = S(0);
        batch.tmax = no_limit<S>;
        batch.tmins = stream.tmin != nullptr ? floats[7] : nullptr;
        batch.tmaxs = stream.tmax != nullptr ? floats[8] : nullptr;
        return batch;
    }
};

namespace detail {

// The loops below are for the compiler's vectoriser; nothing in them crosses from one element to another.

/// (org - centre) * scale, rounded once: a centre that is a float is subtracted in float.
template <class S>
LANECAST_INLINE void normalise(S* to, const float* from, std::uint32_t n, double centre, double scale) {
    if (centre == 0) {
#pragma GCC ivdep
        for (std::uint32_t i = 0; i < n; ++i) to[i] = static_cast<S>(from[i]) * static_cast<S>(scale);
    } else if (static_cast<double>(static_cast<S>(centre)) == centre) {
        const S c = static_cast<S>(centre), s = static_cast<S>(scale);
#pragma GCC ivdep
        for (std::uint32_t i = 0; i < n; ++i) to[i] = (static_cast<S>(from[i]) - c) * s;
    } else {
#pragma GCC ivdep
        for (std::uint32_t i = 0; i < n; ++i) to[i] = static_cast<S>((static_cast<double>(from[i]) - centre) * scale);
    }
}

/// Directions are read in place, where they are floats and so many that no vector of them reaches beyond the caller's array.
template <FloatBatch F>
LANECAST_INLINE void read_rays(const RayStream& stream, std::uint32_t begin, std::uint32_t n, const StreamUnits& units,
                               StreamBatch<F>& batch, RayBatch<F>& rays) {
    using S = Scalar<F>;
    const S scale = static_cast<S>(units.scale);
    for (int axis = 0; axis < 3; ++axis) {
        if (stream.common_origin == 0) normalise(rays.org[axis], stream.org[axis] + begin, n, units.centre[axis], units.scale);
        const float* const from = stream.dir[axis] + begin;
        if constexpr (sizeof(S) == sizeof(float)) {
            if (n % width<F> == 0) {
                rays.dir[axis] = const_cast<float*>(from);
                continue;
            }
        }
        S* const to = rays.dir[axis] = batch.floats[3 + axis];
#pragma GCC ivdep
        for (std::uint32_t i = 0; i < n; ++i) to[i] = static_cast<S>(from[i]);
    }
    if (stream.tmin != nullptr) {
        S* const to = const_cast<S*>(rays.tmins);
        const float* const from = stream.tmin + begin;
#pragma GCC ivdep
        for (std::uint32_t i = 0; i < n; ++i) to[i] = max(S(0), static_cast<S>(from[i]) * scale); // a NaN stays
    }
    if (stream.tmax != nullptr) {
        S* const to = const_cast<S*>(rays.tmaxs);
        const float* const from = stream.tmax + begin;
#pragma GCC ivdep
        for (std::uint32_t i = 0; i < n; ++i) to[i] = min(no_limit<S>, static_cast<S>(from[i]) * scale); // a NaN stays
    }
}

template <FloatBatch F>
LANECAST_INLINE void write_distances(const RayStream& stream, std::uint32_t begin, std::uint32_t n, const StreamUnits& units,
                                     const RayBatch<F>& rays) {
    using S = Scalar<F>;
    const S inverse = static_cast<S>(1 / units.scale);
    const S* const from = rays.t;
    const std::int32_t* const slot = rays.slot;
    float* const to = stream.t + begin;
    if (stream.tmax != nullptr) {
        const float* const tmax = stream.tmax + begin; // may be `to`
#pragma GCC ivdep
        for (std::uint32_t i = 0; i < n; ++i) {
            const auto t = static_cast<float>(from[i] * inverse);
            to[i] = slot[i] < 0 ? tmax[i] : t;
        }
    } else {
#pragma GCC ivdep
        for (std::uint32_t i = 0; i < n; ++i) {
            const auto t = static_cast<float>(from[i] * inverse); // outside of the condition, or g++ 12 waits for it in memory
            to[i] = slot[i] < 0 ? std::numeric_limits<float>::infinity() : t;
        }
    }
}

template <Query query, FloatBatch F>
LANECAST_INLINE void write_hits(const SceneView& scene, const RayStream& stream, std::uint32_t begin, std::uint32_t n,
                                const StreamUnits& units, const RayBatch<F>& rays) {
    const std::int32_t* const slot = rays.slot;
    if (stream.slot != nullptr) {
        std::int32_t* const to = stream.slot + begin;
#pragma GCC ivdep
        for (std::uint32_t i = 0; i < n; ++i) to[i] = slot[i];
    }
    if (query == Query::any) {
        if (stream.occluded == nullptr) return;
        std::uint8_t* const to = stream.occluded + begin;
#pragma GCC ivdep
        for (std::uint32_t i = 0; i < n; ++i) to[i] = static_cast<std::uint8_t>(slot[i] >= 0 ? 1 : 0);
        return;
    }
    if (stream.t != nullptr) write_distances(stream, begin, n, units, rays);
    if (stream.object != nullptr || stream.primitive != nullptr) write_names<F>(scene, stream, begin, n, slot);
    if (stream.normal[0] != nullptr || stream.u != nullptr) write_attributes(scene, stream, begin, n, rays);
}

} // namespace detail

template <Query query, FloatBatch F>
void trace_stream(const SceneView& scene, const RayStream& stream) {
    const FlushDenormals flush;
    constexpr StreamUnits normalised{{0, 0, 0}, 1};
    const StreamUnits& units = stream.units != nullptr ? *stream.units : normalised;
    StreamBatch<F> batch; // uninitialised, like the scratch: filled as far as the rays go
    TraceScratch<F> scratch;
    RayKindStats stats{};
    RayBatch<F> rays = batch.rays(stream);
    Occluders first{}; // should the rays go to one light; otherwise it is left empty or soon forgotten
    rays.occluders = stream.occluders != nullptr ? stream.occluders : &first;
    const std::uint32_t chunk = stream.coherent != 0 ? coherent_chunk : max_batch_rays;
    const std::uint32_t filled = stream.count < chunk ? stream.count : chunk;
    for (std::uint32_t i = 0; i < filled + static_cast<std::uint32_t>(width<F>); ++i) rays.source[i] = no_source;
    if (stream.common_origin != 0 && filled > 0) {
        for (int axis = 0; axis < 3; ++axis) {
            Scalar<F> org;
            detail::normalise(&org, stream.org[axis], 1, units.centre[axis], units.scale);
            Scalar<F>* const to = rays.org[axis];
            for (std::uint32_t i = 0; i < filled; ++i) to[i] = org;
        }
    }
    for (std::uint32_t begin = 0; begin < stream.count; begin += chunk) {
        const std::uint32_t n = stream.count - begin < chunk ? stream.count - begin : chunk;
        detail::read_rays(stream, begin, n, units, batch, rays);
        trace<query>(scene, rays, n, stream.brute_force != 0, scratch, stats);
        detail::write_hits<query>(scene, stream, begin, n, units, rays);
    }
}

} // namespace lanecast::inline LANECAST_ISA
