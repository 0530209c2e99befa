#pragma once
// Local light of a batch: ambient, then each light in the file's order, its shadow rays traced as one batch.

#include "render/kernels/lights.hpp"
#include "render/kernels/trace_log.hpp"
#include "render/kernels/wavefront.hpp"
#include "simd/pow.hpp"

#include <limits>

namespace lanecast::inline LANECAST_ISA {

namespace detail {

/// What the way to the light lets through: each surface crossed multiplies by its `transmissive`, in order of (t, scene id).
template <FloatBatch F>
void trace_through(Wavefront<F>& w, std::uint32_t n) {
    using S = Scalar<F>;
    const RenderJob& job = *w.job;
    LightBatch<F>& l = w.light;
    RayBatch<F>& rays = l.shadow;
    for (std::uint32_t i = 0; i < n; ++i) {
        for (S* const channel : l.through) channel[i] = 1;
        l.after_t[i] = 0;
        l.after_id[i] = std::numeric_limits<std::int32_t>::max(); // t = 0 is no hit, whatever the id
        l.origin[i] = static_cast<std::int32_t>(i);
    }
    rays.tmins = l.after_t;
    rays.after = l.after_id;
    while (n > 0) {
        trace<Query::next>(job.scene, rays, n, job.brute_force != 0, *w.trace, w.stats->kinds[static_cast<int>(RayKind::shadow)]);
        std::uint32_t left = 0;
        for (std::uint32_t i = 0; i < n; ++i) {
            if (rays.slot[i] < 0) continue;
            const std::int32_t origin = l.origin[i];
            const MaterialRecord& material = job.scene.materials[job.scene.material[rays.slot[i]]];
            bool dark = true;
            for (int c = 0; c < 3; ++c) {
                l.through[c][origin] *= static_cast<S>(material.transmissive[c]);
                dark &= l.through[c][origin] == S(0);
            }
            if (dark) continue;
            for (int axis = 0; axis < 3; ++axis) {
                rays.org[axis][left] = rays.org[axis][i];
                rays.dir[axis][left] = rays.dir[axis][i];
            }
            rays.source[left] = rays.source[i];
            l.after_t[left] = rays.t[i];
            l.after_id[left] = static_cast<std::int32_t>(job.scene.scene_id[rays.slot[i]]);
            l.origin[left] = origin;
            ++left;
        }
        n = left;
    }
    rays.tmins = nullptr;
    rays.after = nullptr;
}

/// Shadow rays of one sample of a light, from every lit lane: dense, in lane order. Returns their number.
template <FloatBatch F>
std::uint32_t queue_shadow_rays(Wavefront<F>& w, const RayQueue<F>& queue, std::uint32_t light_index, std::int32_t sample) {
    const SceneView& scene = w.job->scene;
    const LightRecord& light = scene.lights[light_index];
    const bool soft = sample >= 0;
    LightBatch<F>& l = w.light;
    const SurfaceBatch<F>& surface = w.surface;
    std::uint32_t n = 0;
    for (std::uint32_t v = 0; v * width<F> < queue.count; ++v) {
        const std::uint32_t i = v * width<F>;
        l.asked[v] = 0;
        if (l.lit[v] == 0) continue;
        Mask<F> asked = mask_from_bits<F>(l.lit[v]);
        const Vec3<F> point = load<F>(surface.point, i), normal = load<F>(surface.normal, i);
        const Vec3<F> org = point + normal * load<F>(surface.offset + i);
        Vec3<F> dir = load<F>(l.to_light, i);
        if (soft) {
            const LightAt<F> at{dir, load<F>(l.wi, i), F(1), asked};
            dir = sample_light(light, at, load_int<F>(queue.seed + i), static_cast<std::uint32_t>(sample),
                               static_cast<std::uint32_t>(w.job->soft_samples), light_index);
            asked = asked & (dot(dir, normal) > F(0)); // a part of the light that has set gives no light
        }
        // from the offset point, so that t = 1 is the light itself
        if (light.kind != LightKind::directional) dir = dir - (org - point);
        l.asked[v] = bits(asked);
        const Int<F> slot = load_int<F>(queue.rays.slot + i);
        const Mask<F> inward = mask_from_bits<F>(surface.inside[v]) & is_quadric<F>(scene, slot);
        for (int axis = 0; axis < 3; ++axis) {
            compress_store<F>(l.shadow.org[axis] + n, axis == 0 ? org.x : axis == 1 ? org.y : org.z, asked);
            compress_store<F>(l.shadow.dir[axis] + n, axis == 0 ? dir.x : axis == 1 ? dir.y : dir.z, asked);
        }
        compress_store_int<F>(l.shadow.source + n, select(inward, source_inward(slot), source_outward(slot)), asked);
        n += count_bits(l.asked[v]);
    }
    l.shadow.occluders = &l.occluders[light_index];
    l.shadow.tmax = light.kind == LightKind::directional ? no_limit<Scalar<F>> : Scalar<F>(1);
    return n;
}

/// Fills LightBatch::visible for the lit lanes; returns the number it is to be divided by.
template <FloatBatch F>
std::int32_t trace_shadows(Wavefront<F>& w, const RayQueue<F>& queue, std::uint32_t light_index) {
    const RenderJob& job = *w.job;
    LightBatch<F>& l = w.light;
    const bool soft = job.soft_samples > 0 && job.scene.lights[light_index].radius > 0.0f;
    const std::int32_t samples = soft ? job.soft_samples : 1;
    const int channels = job.transmissive_shadows != 0 ? 3 : 1;
    for (std::int32_t sample = 0; sample < samples; ++sample) {
        const std::uint32_t n = queue_shadow_rays(w, queue, light_index, soft ? sample : -1);
        if (job.transmissive_shadows != 0)
            trace_through(w, n);
        else
            trace<Query::any>(job.scene, l.shadow, n, job.brute_force != 0, *w.trace,
                              w.stats->kinds[static_cast<int>(RayKind::shadow)]);
        std::uint32_t ray = 0;
        for (std::uint32_t v = 0; v * width<F> < queue.count; ++v) {
            const std::uint32_t i = v * width<F>;
            const Mask<F> asked = mask_from_bits<F>(l.asked[v]);
            for (int c = 0; c < channels; ++c) {
                F visible;
                if (job.transmissive_shadows != 0) {
                    visible = expand_load<F>(l.through[c] + ray, asked);
                } else {
                    const Int<F> slot = expand_load_int<F>(l.shadow.slot + ray, asked);
                    visible = select(asked & (Int<F>(0) > slot), F(1), F(0));
                }
                store(l.visible[c] + i, sample == 0 ? visible : load<F>(l.visible[c] + i) + visible);
            }
            ray += count_bits(l.asked[v]);
        }
    }
    return samples;
}

} // namespace detail

/// Adds one light to the colours of the queue.
template <FloatBatch F>
void add_light(Wavefront<F>& w, RayQueue<F>& queue, std::uint32_t light_index) {
    using S = Scalar<F>;
    const RenderJob& job = *w.job;
    const LightRecord& light = job.scene.lights[light_index];
    LightBatch<F>& l = w.light;
    const SurfaceBatch<F>& surface = w.surface;
    std::uint32_t any_lit = 0;
    for (std::uint32_t v = 0; v * width<F> < queue.count; ++v) {
        const std::uint32_t i = v * width<F>;
        l.lit[v] = 0;
        if (surface.lightable[v] == 0) continue;
        const LightAt<F> at = light_at<F>(light, load<F>(surface.point, i));
        const Mask<F> lit = mask_from_bits<F>(surface.lightable[v]) & at.lit & (dot(load<F>(surface.normal, i), at.wi) > F(0));
        l.lit[v] = bits(lit);
        any_lit |= l.lit[v];
        store<F>(l.wi, i, at.wi);
        store<F>(l.to_light, i, at.to_light);
        store(l.scale + i, at.scale);
    }
    if (any_lit == 0) return;
    const std::int32_t samples = job.shadows != 0 ? detail::trace_shadows(w, queue, light_index) : 1;
    const int channels = job.shadows != 0 && job.transmissive_shadows != 0 ? 3 : 1;
    const F share(S(1) / static_cast<S>(samples));
    const Vec3<F> color = splat<F>(light.color);
    for (std::uint32_t v = 0; v * width<F> < queue.count; ++v) {
        if (l.lit[v] == 0) continue;
        const std::uint32_t i = v * width<F>;
        Mask<F> lit = mask_from_bits<F>(l.lit[v]);
        Vec3<F> visible{F(1), F(1), F(1)};
        if (job.shadows != 0) {
            const F first = load<F>(l.visible[0] + i) * share;
            visible = {first, first, first};
            if (channels == 3) visible = {first, load<F>(l.visible[1] + i) * share, load<F>(l.visible[2] + i) * share};
            if (channels == 1) lit = lit & (first > F(0));
            if (none(lit) && job.log == nullptr) continue;
        }
        const Vec3<F> normal = load<F>(surface.normal, i), wi = load<F>(l.wi, i);
        const F cos_light = dot(normal, wi);
        Vec3<F> reflected = load<F>(surface.diffuse, i) * cos_light;
        const Vec3<F> specular = load<F>(surface.specular, i);
        const Mask<F> shiny = lit & ((specular.x != F(0)) | (specular.y != F(0)) | (specular.z != F(0)));
        if (any(shiny)) {
            const Vec3<F> half = normalize(wi + load<F>(surface.view, i));
            const F cos_half = min(max(dot(normal, half), F(0)), F(1)); // 1 + u to a large power is large
            reflected = reflected + specular * pow(cos_half, load<F>(surface.shininess + i));
        }
        const Vec3<F> share_of_light = color * load<F>(l.scale + i) * visible * reflected;
        const Vec3<F> before = load<F>(queue.color, i);
        store<F>(queue.color, i, select(lit, before + share_of_light, before));
        if (job.log != nullptr) log_light<F>(*job.log, queue.record + i, light_index, l.lit[v], visible, share_of_light);
    }
}

} // namespace lanecast::inline LANECAST_ISA
