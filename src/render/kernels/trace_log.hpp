#pragma once
// The ray tree of a pixel, written down while it is traced: the same kernels that render, so `pick` cannot disagree with the
// picture.

#include "render/kernels/wavefront.hpp"

namespace lanecast::inline LANECAST_ISA {

template <FloatBatch F>
LANECAST_INLINE void lane_of(const Vec3<F>& v, std::uint32_t lane, float (&out)[3]) {
    alignas(64) Scalar<F> lanes[width<F>];
    const F components[3] = {v.x, v.y, v.z};
    for (int c = 0; c < 3; ++c) {
        store(lanes, components[c]);
        out[c] = static_cast<float>(lanes[lane]);
    }
}

/// The record at `index`, or null when it did not fit.
LANECAST_INLINE TraceRecord* record_at(TraceLog& log, std::int32_t index) {
    return index >= 0 && index < log.ray_capacity ? log.rays + index : nullptr;
}

/// A light's share of every lane of `lit`.
template <FloatBatch F>
void log_light(TraceLog& log, const std::int32_t* records, std::uint32_t light, std::uint32_t lit, const Vec3<F>& visible,
               const Vec3<F>& color) {
    for_each_bit(lit, [&](std::uint32_t lane) {
        const std::int32_t place = log.light_count;
        if (place == std::numeric_limits<std::int32_t>::max()) return;
        ++log.light_count;
        if (place >= log.light_capacity) return;
        TraceLight& entry = log.lights[place];
        entry.ray = records[lane];
        entry.light = static_cast<std::int32_t>(light);
        lane_of(visible, lane, entry.visibility);
        lane_of(color, lane, entry.color);
    });
}

/// A record per ray of the queue, whose `record` entries, until now those of the parents, become the rays' own.
template <FloatBatch F>
void log_rays(const Wavefront<F>& w, RayQueue<F>& queue, RayKind kind, std::int32_t level) {
    TraceLog& log = *w.job->log;
    for (std::uint32_t i = 0; i < queue.count; ++i) {
        const std::int32_t parent = queue.record[i];
        queue.record[i] = log.ray_count;
        if (log.ray_count < std::numeric_limits<std::int32_t>::max()) ++log.ray_count;
        TraceRecord* const record = record_at(log, queue.record[i]);
        if (record == nullptr) continue;
        const std::uint32_t v = i / width<F>, lane = i % width<F>;
        record->parent = parent;
        record->level = level;
        record->kind = kind;
        record->slot = queue.rays.slot[i];
        record->t = static_cast<float>(queue.rays.t[i]);
        record->inside = static_cast<std::int32_t>((w.surface.inside[v] >> lane) & 1u);
        for (int c = 0; c < 3; ++c) {
            record->org[c] = static_cast<float>(queue.rays.org[c][i]);
            record->dir[c] = static_cast<float>(queue.rays.dir[c][i]);
            record->point[c] = static_cast<float>(w.surface.point[c][i]);
            record->normal[c] = static_cast<float>(w.surface.normal[c][i]);
            record->ambient[c] = static_cast<float>(queue.color[c][i]);
        }
    }
}

/// Fresnel's factor of the lanes of `mirrors`.
template <FloatBatch F>
void log_fresnel(TraceLog& log, const std::int32_t* records, std::uint32_t mirrors, F fresnel) {
    alignas(64) Scalar<F> lanes[width<F>];
    store(lanes, fresnel);
    for_each_bit(mirrors, [&](std::uint32_t lane) {
        if (TraceRecord* const record = record_at(log, records[lane])) record->fresnel = static_cast<float>(lanes[lane]);
    });
}

/// The colours of the rays, once they are complete.
template <FloatBatch F>
void log_colors(TraceLog& log, const RayQueue<F>& queue) {
    for (std::uint32_t i = 0; i < queue.count; ++i) {
        TraceRecord* const record = record_at(log, queue.record[i]);
        if (record == nullptr) continue;
        for (int c = 0; c < 3; ++c) record->color[c] = static_cast<float>(queue.color[c][i]);
    }
}

} // namespace lanecast::inline LANECAST_ISA
