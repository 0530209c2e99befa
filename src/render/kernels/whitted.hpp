#pragma once
// Whitted 1980, on batches: closest hit, local light, children, and the sum on the way back. A ray's colour is complete only when
// its children's are, so each sum is made in one order, whatever the batch, width, tile or thread.

#include "render/kernels/direct_light.hpp"
#include "render/kernels/optics.hpp"
#include "render/kernels/surface.hpp"

namespace lanecast::inline LANECAST_ISA {

namespace detail {

template <FloatBatch F>
LANECAST_INLINE F largest(const Vec3<F>& v) {
    return max(max(v.x, v.y), v.z);
}
template <FloatBatch F>
LANECAST_INLINE Mask<F> not_zero(const Vec3<F>& v) {
    return (v.x != F(0)) | (v.y != F(0)) | (v.z != F(0));
}

/// Surfaces of the rays that hit something; the others take the background. The local light starts with the ambient term.
template <FloatBatch F>
void begin_shading(Wavefront<F>& w, RayQueue<F>& queue) {
    using S = Scalar<F>;
    const SceneView& scene = w.job->scene;
    SurfaceBatch<F>& surface = w.surface;
    const Vec3<F> background = splat<F>(scene.background), ambient_light = splat<F>(scene.ambient);
    const auto* const materials = reinterpret_cast<const std::int32_t*>(scene.material);
    for (std::uint32_t v = 0; v * width<F> < queue.count; ++v) {
        const std::uint32_t i = v * width<F>;
        const Int<F> slot = load_int<F>(queue.rays.slot + i);
        const Mask<F> found = (slot > Int<F>(-1)) & first_lanes<F>(queue.count - i);
        surface.found[v] = bits(found);
        surface.lightable[v] = 0;
        surface.inside[v] = 0;
        Vec3<F> color = background;
        if (any(found)) {
            const Vec3<F> dir = load<F>(queue.rays.dir, i);
            const Surface<F> s = surface_at<F>(scene, load<F>(queue.rays.org, i), dir, load<F>(queue.rays.t + i), slot, found);
            store<F>(surface.point, i, s.point);
            store<F>(surface.normal, i, s.normal);
            store<F>(surface.view, i, -normalize(dir));
            store(surface.offset + i, s.offset);
            surface.inside[v] = bits(s.inside);
            const Vec3<F> zero{F(0), F(0), F(0)};
            Vec3<F> ambient = zero, diffuse = zero, specular = zero;
            F shininess(1);
            const Int<F> material = gather(materials, select(found, slot, Int<F>(0)));
            store(surface.material + i, material);
            for_each_unique<F>(material, found, [&](std::int32_t index, Mask<F> same) {
                const MaterialRecord& m = scene.materials[index];
                ambient = select(same, splat<F>(m.ambient), ambient);
                diffuse = select(same, splat<F>(m.diffuse), diffuse);
                specular = select(same, splat<F>(m.specular), specular);
                shininess = select(same, F(S(m.shininess)), shininess);
            });
            store<F>(surface.diffuse, i, diffuse);
            store<F>(surface.specular, i, specular);
            store(surface.shininess + i, shininess);
            // pick lists every light
            surface.lightable[v] = w.job->log != nullptr ? bits(found) : bits(found & (not_zero(diffuse) | not_zero(specular)));
            color = select(found, ambient_light * ambient, background);
        }
        store<F>(queue.color, i, color);
    }
}

/// Where the children of vector v of a batch start from, and what they inherit.
template <FloatBatch F>
struct Spawn {
    const RenderJob& job;
    const RayQueue<F>& parents;
    std::uint32_t v;

    /// Queues the lanes of `wanted` that are worth tracing. `weight`: of the child relative to its parent.
    void operator()(Children<F>& children, const Vec3<F>& org, const Vec3<F>& dir, Int<F> source, F weight, const Vec3<F>& factor,
                    Mask<F> wanted, bool deeper, std::uint32_t seed_step) const {
        const std::uint32_t i = v * width<F>;
        RayQueue<F>& queue = children.queue;
        store<F>(children.factor, i, factor);
        children.wanted[v] = bits(wanted);
        children.first[v] = queue.count;
        Mask<F> traced = deeper ? wanted : Mask<F>(false);
        F path_weight(1);
        if (queue.weight != nullptr) {
            path_weight = load<F>(parents.weight + i) * weight;
            traced = traced & (path_weight >= F(Scalar<F>(job.cutoff)));
        }
        children.traced[v] = bits(traced);
        if (none(traced)) return;
        const std::uint32_t n = queue.count;
        for (int axis = 0; axis < 3; ++axis) {
            compress_store<F>(queue.rays.org[axis] + n, axis == 0 ? org.x : axis == 1 ? org.y : org.z, traced);
            compress_store<F>(queue.rays.dir[axis] + n, axis == 0 ? dir.x : axis == 1 ? dir.y : dir.z, traced);
        }
        compress_store_int<F>(queue.rays.source + n, source, traced);
        if (queue.weight != nullptr) compress_store<F>(queue.weight + n, path_weight, traced);
        if (queue.seed != nullptr)
            compress_store_int<F>(queue.seed + n, multiply_add(load_int<F>(parents.seed + i), 747796405u, seed_step), traced);
        if (queue.record != nullptr) compress_store_int<F>(queue.record + n, load_int<F>(parents.record + i), traced);
        queue.count += count_bits(children.traced[v]);
    }
};

/// Fills the queues of the next level.
template <FloatBatch F>
void spawn_children(Wavefront<F>& w, const RayQueue<F>& queue, Frame<F>& frame, bool deeper) {
    using S = Scalar<F>;
    const RenderJob& job = *w.job;
    const SceneView& scene = job.scene;
    const SurfaceBatch<F>& surface = w.surface;
    const bool reflects = (scene.features & feature_reflective) != 0, transmits = (scene.features & feature_transmissive) != 0;
    frame.reflected.queue.count = 0;
    frame.transmitted.queue.count = 0;
    for (std::uint32_t v = 0; v * width<F> < queue.count; ++v) {
        const std::uint32_t i = v * width<F>;
        const Mask<F> found = mask_from_bits<F>(surface.found[v]);
        const Vec3<F> zero{F(0), F(0), F(0)};
        Vec3<F> reflective = zero, transmissive = zero;
        F index(0);
        for_each_unique<F>(load_int<F>(surface.material + i), found, [&](std::int32_t material, Mask<F> same) {
            const MaterialRecord& m = scene.materials[material];
            reflective = select(same, splat<F>(m.reflective), reflective);
            transmissive = select(same, splat<F>(m.transmissive), transmissive);
            index = select(same, F(S(m.refraction)), index);
        });
        const Mask<F> mirrors = found & not_zero(reflective), glassy = found & not_zero(transmissive);
        if (reflects) frame.reflected.wanted[v] = 0;
        if (transmits) frame.transmitted.wanted[v] = 0;
        if (none(mirrors | glassy)) continue;

        const Vec3<F> d = -load<F>(surface.view, i), n = load<F>(surface.normal, i), point = load<F>(surface.point, i);
        const Vec3<F> away = n * load<F>(surface.offset + i);
        const Int<F> slot = load_int<F>(queue.rays.slot + i);
        const Mask<F> inside = mask_from_bits<F>(surface.inside[v]);
        const Mask<F> quadric = is_quadric<F>(scene, slot);
        const Int<F> outward = source_outward(slot), inward = select(quadric, source_inward(slot), outward);
        const Int<F> back = select(inside, inward, outward), onward = select(inside, outward, inward);
        const Spawn<F> spawn{job, queue, v};
        Transmission<F> through{d, Mask<F>(false), F(1)};
        if (transmits || job.schlick != 0) through = transmit(d, n, index, inside);
        if (job.log != nullptr) log_fresnel(*job.log, queue.record + i, bits(mirrors), job.schlick != 0 ? through.fresnel : F(1));
        if (reflects) {
            const Vec3<F> factor = job.schlick != 0 ? reflective * through.fresnel : reflective;
            const Vec3<F> opaque{F(1) - transmissive.x, F(1) - transmissive.y, F(1) - transmissive.z};
            spawn(frame.reflected, point + away, mirror(d, n), back, largest(abs(factor * opaque)), factor, mirrors, deeper,
                  2891336453u);
        }
        if (transmits)
            spawn(frame.transmitted, select(through.total, point + away, point - away), through.dir,
                  select(through.total, back, onward), largest(abs(transmissive)), transmissive, glassy, deeper, 1u);
    }
}

/// No more than what shares of up to 1e6 multiply to a number: infinities of both signs would add up to none.
template <FloatBatch F>
LANECAST_INLINE Vec3<F> bounded(const Vec3<F>& color) {
    const F most(Scalar<F>(1e30));
    const auto bound = [&](F channel) { return max(min(channel, most), -most); };
    return {bound(color.x), bound(color.y), bound(color.z)};
}

/// The children's colours in the order of the traced lanes, the background for the others.
template <FloatBatch F>
LANECAST_INLINE Vec3<F> color_of_children(const Children<F>& children, std::uint32_t v, const Vec3<F>& background) {
    const Mask<F> traced = mask_from_bits<F>(children.traced[v]);
    const std::uint32_t first = children.first[v];
    const Vec3<F> color{expand_load<F>(children.queue.color[0] + first, traced),
                        expand_load<F>(children.queue.color[1] + first, traced),
                        expand_load<F>(children.queue.color[2] + first, traced)};
    return select(traced, bounded(color), background);
}

/// color = local + F reflective trace(R), then color (1 - transmissive) + transmissive trace(T).
template <FloatBatch F>
void combine(const RenderJob& job, RayQueue<F>& queue, const Frame<F>& frame) {
    const Vec3<F> background = splat<F>(job.scene.background);
    const bool reflects = (job.scene.features & feature_reflective) != 0;
    const bool transmits = (job.scene.features & feature_transmissive) != 0;
    for (std::uint32_t v = 0; v * width<F> < queue.count; ++v) {
        const std::uint32_t mirrors = reflects ? frame.reflected.wanted[v] : 0;
        const std::uint32_t glassy = transmits ? frame.transmitted.wanted[v] : 0;
        if ((mirrors | glassy) == 0) continue;
        const std::uint32_t i = v * width<F>;
        Vec3<F> color = bounded(load<F>(queue.color, i));
        if (mirrors != 0) {
            const Vec3<F> factor = load<F>(frame.reflected.factor, i);
            const Vec3<F> mirrored = color + factor * color_of_children(frame.reflected, v, background);
            color = select(mask_from_bits<F>(mirrors), mirrored, color);
        }
        if (glassy != 0) {
            const Vec3<F> k = load<F>(frame.transmitted.factor, i);
            const Vec3<F> opaque{F(1) - k.x, F(1) - k.y, F(1) - k.z};
            const Vec3<F> seen = color * opaque + k * color_of_children(frame.transmitted, v, background);
            color = select(mask_from_bits<F>(glassy), seen, color);
        }
        store<F>(queue.color, i, color);
    }
}

} // namespace detail

/// Traces and shades the rays of the queue, children included.
template <FloatBatch F>
void trace_queue(Wavefront<F>& w, RayQueue<F>& queue, RayKind kind, std::int32_t level) {
    const RenderJob& job = *w.job;
    if (queue.count == 0 || (job.stop != nullptr && __atomic_load_n(job.stop, __ATOMIC_RELAXED))) return;
    trace<Query::closest>(job.scene, queue.rays, queue.count, job.brute_force != 0, *w.trace,
                          w.stats->kinds[static_cast<int>(kind)]);
    detail::begin_shading(w, queue);
    if (job.log != nullptr) log_rays(w, queue, kind, level);
    for (std::uint32_t light = 0; light < job.scene.light_count; ++light) add_light(w, queue, light);
    if ((job.scene.features & (feature_reflective | feature_transmissive)) != 0) {
        const bool deeper = level < job.depth;
        Frame<F>& frame = w.frames[level];
        detail::spawn_children(w, queue, frame, deeper);
        if (deeper) {
            trace_queue(w, frame.reflected.queue, RayKind::reflection, level + 1);
            trace_queue(w, frame.transmitted.queue, RayKind::refraction, level + 1);
        }
        detail::combine(job, queue, frame);
    }
    if (job.log != nullptr) log_colors(*job.log, queue);
}

} // namespace lanecast::inline LANECAST_ISA
