#pragma once
// The memory of the integrator. A batch of rays is traced, shaded, and its children queued and traced before its own colours are
// complete: one Frame per level, so the stack of levels is explicit and its size known before the first ray.

#include "render/kernel_table.hpp"
#include "render/kernels/rays.hpp"
#include "render/kernels/trace.hpp"

namespace lanecast::inline LANECAST_ISA {

/// Rays shaded together. Measured: docs/performance.md.
inline constexpr std::uint32_t batch_rays = 512;
template <FloatBatch F>
inline constexpr std::uint32_t batch_vectors = batch_rays / width<F>;

/// Rays of one kind and level, and the colours they came back with.
template <FloatBatch F>
struct RayQueue {
    using S = Scalar<F>;
    RayBatch<F> rays;
    S* color[3];
    S* weight;            ///< what a unit of the ray's colour adds to its pixel at most; null unless the job has a cut-off
    std::int32_t* seed;   ///< of its soft shadows; null unless the job has any
    std::int32_t* record; ///< its TraceRecord; null unless the job has a log
    std::uint32_t count;

    void allocate(ScratchLayout& layout, const RenderJob& job) {
        const std::uint64_t n = batch_rays + width<F>;
        rays.allocate(layout, batch_rays);
        layout.take3(color, n);
        weight = job.cutoff > 0 ? layout.take<S>(n) : nullptr;
        seed = job.soft_samples > 0 ? layout.take<std::int32_t>(n) : nullptr;
        record = job.log != nullptr ? layout.take<std::int32_t>(n) : nullptr;
        count = 0;
    }
};

/// The children of a batch. Those of vector v are consecutive in their queue, from first[v], one per bit of lanes[v] that was
/// traced.
template <FloatBatch F>
struct Children {
    RayQueue<F> queue;
    Scalar<F>* factor[3];  ///< by which a child's colour enters its parent's
    std::uint32_t* wanted; ///< lanes whose material asks for the child
    std::uint32_t* traced; ///< of those, the ones in the queue: the others see the background
    std::uint32_t* first;

    void allocate(ScratchLayout& layout, const RenderJob& job) {
        queue.allocate(layout, job);
        layout.take3(factor, batch_rays + width<F>);
        wanted = layout.take<std::uint32_t>(batch_vectors<F>);
        traced = layout.take<std::uint32_t>(batch_vectors<F>);
        first = layout.take<std::uint32_t>(batch_vectors<F>);
    }
};

template <FloatBatch F>
struct Frame {
    Children<F> reflected, transmitted;
};

/// The surfaces of the batch in hand.
template <FloatBatch F>
struct SurfaceBatch {
    using S = Scalar<F>;
    S* point[3];
    S* normal[3];
    S* view[3]; ///< unit, back along the ray
    S* offset;
    std::int32_t* material;
    S* diffuse[3];
    S* specular[3];
    S* shininess;
    std::uint32_t* found;     ///< lanes
    std::uint32_t* lightable; ///< of those, the ones whose material is diffuse or specular: no light reaches the others
    std::uint32_t* inside;

    void allocate(ScratchLayout& layout) {
        const std::uint64_t n = batch_rays + width<F>;
        layout.take3(point, n);
        layout.take3(normal, n);
        layout.take3(view, n);
        offset = layout.take<S>(n);
        material = layout.take<std::int32_t>(n);
        layout.take3(diffuse, n);
        layout.take3(specular, n);
        shininess = layout.take<S>(n);
        found = layout.take<std::uint32_t>(batch_vectors<F>);
        lightable = layout.take<std::uint32_t>(batch_vectors<F>);
        inside = layout.take<std::uint32_t>(batch_vectors<F>);
    }
};

/// One light at all surfaces of the batch.
template <FloatBatch F>
struct LightBatch {
    using S = Scalar<F>;
    S* wi[3];
    S* to_light[3];
    S* scale;
    S* visible[3];        ///< sum over samples of what reaches the surface, 0 to 1 per channel
    std::uint32_t* lit;   ///< lanes that face the light and lie in its cone
    std::uint32_t* asked; ///< lanes with a shadow ray, of the sample in hand
    RayBatch<F> shadow;
    Occluders* occluders; ///< of each light
    // shadow rays on their way through transmissive objects
    S* through[3];
    S* after_t;
    std::int32_t* after_id;
    std::int32_t* origin; ///< place in `through` of each ray still on its way

    void allocate(ScratchLayout& layout, const RenderJob& job) {
        const std::uint64_t n = batch_rays + width<F>;
        layout.take3(wi, n);
        layout.take3(to_light, n);
        scale = layout.take<S>(n);
        layout.take3(visible, n);
        lit = layout.take<std::uint32_t>(batch_vectors<F>);
        asked = layout.take<std::uint32_t>(batch_vectors<F>);
        shadow.allocate(layout, batch_rays);
        occluders = layout.take<Occluders>(job.scene.light_count);
        for (std::uint32_t i = 0; occluders != nullptr && i < job.scene.light_count; ++i) occluders[i].count = 0;
        if (job.transmissive_shadows == 0) return;
        layout.take3(through, n);
        after_t = layout.take<S>(n);
        after_id = layout.take<std::int32_t>(n);
        origin = layout.take<std::int32_t>(n);
    }
};

template <FloatBatch F>
struct Wavefront {
    const RenderJob* job;
    TileStats* stats;
    Frame<F>* frames; ///< of levels 0 to depth
    SurfaceBatch<F> surface;
    LightBatch<F> light;
    TraceScratch<F>* trace;

    /// Of a block of scratch memory, or measured over a null one.
    void allocate(ScratchLayout& layout, const RenderJob& job_) {
        job = &job_;
        surface.allocate(layout);
        if (job_.scene.light_count > 0) light.allocate(layout, job_);
        trace = layout.take<TraceScratch<F>>(1);
        const auto levels = static_cast<std::uint64_t>(job_.depth) + 1;
        const bool recursive = (job_.scene.features & (feature_reflective | feature_transmissive)) != 0;
        frames = recursive ? layout.take<Frame<F>>(levels) : nullptr;
        if (!recursive) return;
        Frame<F> measured;
        for (std::uint64_t level = 0; level < levels; ++level) {
            Frame<F>& frame = frames == nullptr ? measured : frames[level];
            if ((job_.scene.features & feature_reflective) != 0) frame.reflected.allocate(layout, job_);
            if ((job_.scene.features & feature_transmissive) != 0) frame.transmitted.allocate(layout, job_);
        }
    }
};

} // namespace lanecast::inline LANECAST_ISA
