#include "cli/measure/trial.hpp"

#include "cli/interrupt.hpp"
#include "render/compare.hpp"
#include "render/dispatch.hpp"
#include "render/exr_io.hpp"
#include "render/half_float.hpp"
#include "render/scrub.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <time.h>
#include <unistd.h>

namespace lanecast::trade {
namespace {

/// The frame's mean may lie this far above that of the sample: two standard errors of a weighted mean (Cochran, Sampling
/// Techniques, 6.4), to which tiles that stand for themselves alone add nothing.
[[nodiscard]] double above(const std::vector<double>& by_tile, double mean, const TileSample& sample) {
    const auto n = static_cast<double>(by_tile.size());
    if (n < 2) return 0;
    double square = 0, weights = 0;
    for (std::size_t i = 0; i < by_tile.size(); ++i) {
        const double weight = sample.weights[i], off = weight * (by_tile[i] - mean);
        square += off * off * std::max(0.0, 1 - 1 / weight);
        weights += weight;
    }
    const double errors = n < 30 ? 2.3 : 2; // Student's t: few tiles tell their spread badly
    return errors * std::sqrt(square * n / (n - 1)) / weights;
}

[[nodiscard]] double process_time() {
    timespec now{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// The windows of a sample side by side in rows about as long as the image's, as one film: a file's compression goes by rows.
[[nodiscard]] Film packed(const std::vector<Film>& films, int image_width) {
    int cell_width = 1, cell_height = 1;
    for (const Film& film : films) {
        cell_width = std::max(cell_width, film.width);
        cell_height = std::max(cell_height, film.height);
    }
    const int count = static_cast<int>(films.size());
    const int columns = std::clamp(image_width / cell_width, 1, count), rows = (count + columns - 1) / columns;
    Film all = make_film(columns * cell_width, rows * cell_height, {0, 0, columns * cell_width, rows * cell_height});
    for (int i = 0; i < count; ++i) {
        const Film& film = films[static_cast<std::size_t>(i)];
        for (int y = 0; y < film.height; ++y)
            for (std::size_t c = 0; c < 3; ++c) {
                const std::ptrdiff_t row = static_cast<std::ptrdiff_t>(i / columns * cell_height + y) * all.width;
                std::copy_n(film.rgb[c].begin() + y * static_cast<std::ptrdiff_t>(film.width), film.width,
                            all.rgb[c].begin() + row + i % columns * cell_width);
            }
    }
    return all;
}

[[nodiscard]] RenderedSample render_by(const KernelTable& kernels, const Bench& bench, const RenderSettings& settings) {
    RenderedSample rendered = render_sample(kernels, *bench.scene, *bench.camera, settings, bench.options, bench.sample);
    for (Film& film : rendered.films) scrub(film);
    return rendered;
}

} // namespace

PictureError error_of(const std::vector<Film>& films, const ReferencePicture& reference, const TileSample& sample) {
    PictureError error;
    double pixels = 0, squares = 0, relative = 0, off = 0, flip = 0;
    std::vector<double> mse_by_tile, flip_by_tile;
    for (std::size_t i = 0; i < films.size(); ++i) {
        const Comparison c = compare(films[i], reference.films[i]);
        const double weight = sample.weights[i], n = weight * static_cast<double>(c.pixels);
        const double seen = mean_flip(see(films[i]), reference.seen[i]);
        pixels += n;
        squares += c.rmse * c.rmse * n;
        relative += c.relmse * n;
        off += weight * static_cast<double>(c.off_pixels);
        flip += seen * n;
        error.largest = std::max(error.largest, c.largest);
        mse_by_tile.push_back(c.rmse * c.rmse);
        flip_by_tile.push_back(seen);
    }
    error.rmse = std::sqrt(squares / pixels);
    error.relmse = relative / pixels;
    error.off = off / pixels;
    error.flip = flip / pixels;
    const double mse = squares / pixels;
    error.rmse_above = std::sqrt(mse + above(mse_by_tile, mse, sample));
    error.flip_above = error.flip + above(flip_by_tile, error.flip, sample);
    return error;
}

RenderedSample render(const Bench& bench, const RenderSettings& settings) {
    const std::string isa = settings.precision == Precision::reference ? "auto" : bench.isa;
    return render_by(find_kernels(isa, settings.precision), bench, settings);
}

RenderedSample render_sooner(const Bench& bench, const RenderSettings& settings) {
    return settings.precision == Precision::reference ? render_by(truth_kernels(), bench, settings) : render(bench, settings);
}

void round_as_file(std::vector<Film>& films, bool float_file) {
    if (float_file) return;
    for (Film& film : films)
        for (auto& plane : film.rgb)
            for (float& value : plane) value = rounded_to_half(std::clamp(value, -largest_half, largest_half));
}

ReferencePicture render_reference(const Bench& bench, const Choice& choice) {
    constexpr int small_tile = 4; // a pixel of glass may take seconds: no thread shall be left with all of them
    Bench small = bench;
    small.sample = in_tiles_of(bench.sample, small_tile);
    RenderedSample rendered = render_sooner(small, choice.settings);
    ReferencePicture reference;
    reference.frame_seconds = rendered.frame_seconds;
    reference.films = std::move(rendered.films);
    round_as_file(reference.films, choice.float_file);
    for (const Film& film : reference.films) reference.seen.push_back(see(film));
    return reference;
}

ReferencePicture cut(const ReferencePicture& reference, const TileSample& sample) {
    ReferencePicture out;
    out.frame_seconds = reference.frame_seconds;
    for (const Tile& window : sample.windows) {
        const Film& from = *std::ranges::find_if(reference.films, [&](const Film& film) {
            return film.x0 <= window.x0 && film.y0 <= window.y0 && film.x0 + film.width >= window.x1 &&
                   film.y0 + film.height >= window.y1;
        });
        Film film = make_film(from.image_width, from.image_height, window);
        for (int y = 0; y < film.height; ++y)
            for (std::size_t c = 0; c < 3; ++c)
                std::copy_n(from.rgb[c].begin() + (film.y0 - from.y0 + y) * static_cast<std::ptrdiff_t>(from.width) + film.x0 -
                                from.x0,
                            film.width, film.rgb[c].begin() + y * static_cast<std::ptrdiff_t>(film.width));
        out.seen.push_back(see(film));
        out.films.push_back(std::move(film));
    }
    return out;
}

double time_of_file(const Bench& bench, const std::vector<Film>& films, bool float_file) {
    const Film film = packed(films, bench.sample.width);
    const std::string name = "lanecast_measure_" + std::to_string(::getpid()) + ".exr";
    const InterruptScope interrupt;
    OutputFile file(std::filesystem::temp_directory_path() / name); // never committed, so it leaves nothing behind
    const double begin = process_time();
    write_exr(file, film, {.float_pixels = float_file, .threads = 1, .attributes = {}});
    interrupt.check();
    return (process_time() - begin) * bench.sample.frame_pixels / bench.sample.pixels();
}

RenderSettings bare(RenderSettings settings) {
    settings.precision = Precision::balanced;
    settings.anti_aliasing.mode = AntiAliasMode::off;
    settings.soft_shadows = 0;
    settings.transmissive_shadows = false;
    return settings;
}

void bound_truth(const Bench& bench, const Choice& base, std::vector<Ladder>& ladders) {
    const auto depth = std::ranges::find(ladders, Knob::depth, &Ladder::knob);
    const auto cutoff = std::ranges::find(ladders, Knob::cutoff, &Ladder::knob);
    constexpr double most_rays = 10;
    constexpr std::size_t places = 2048; // of 2x2 pixels: it is a few spots of glass where rays never end
    Bench few = bench;
    few.options.tile_size = 2;
    few.sample = spread_tiles(few.options, places);
    RenderSettings settings = bare(true_choice(base, ladders).settings);
    const auto affordable = [&](const RenderSettings& tried) {
        const TileStats stats = render(few, tried).stats;
        const auto rays = [&](RayKind kind) { return static_cast<double>(stats.kinds[static_cast<int>(kind)].rays); };
        return rays(RayKind::reflection) + rays(RayKind::refraction) <= most_rays * rays(RayKind::primary);
    };
    // In small steps: coloured glass that mirrors may double its rays at every level, whatever the cutoff.
    if (cutoff != ladders.end()) settings.cutoff = 1.0 / 256;
    if (depth != ladders.end()) {
        const int deepest = settings.depth;
        int last = base.settings.depth;
        for (int next = last; next <= deepest; next += next < 16 ? 2 : 8) {
            settings.depth = next;
            if (!affordable(settings)) break;
            last = next;
        }
        if (last + 8 > deepest) last = deepest;
        set_true_depth(*depth, last, base);
        settings.depth = last;
    }
    if (cutoff == ladders.end()) return;
    double smallest = settings.cutoff;
    for (double next = smallest / 2; next >= 1.0 / 65536; next /= 2) {
        settings.cutoff = next;
        if (!affordable(settings)) break;
        smallest = next;
    }
    set_true_cutoff(*cutoff, smallest, base);
}

Choice second_truth(const Choice& truth, const std::vector<Ladder>& ladders) {
    Choice second = truth;
    RenderSettings& s = second.settings;
    const auto two_thirds = [](int n) { return 2 * n / 3; };
    for (const Ladder& ladder : ladders) switch (ladder.knob) {
        case Knob::precision:
            s.precision = Precision::balanced;
            break;
        case Knob::anti_aliasing:
            s.anti_aliasing.samples = two_thirds(s.anti_aliasing.samples);
            break;
        case Knob::soft_shadows:
            s.soft_shadows = two_thirds(s.soft_shadows);
            break;
        case Knob::depth:
            s.depth = two_thirds(s.depth);
            break;
        case Knob::cutoff:
            s.cutoff = std::min(1.0, 4 * s.cutoff);
            break;
        case Knob::file:
            break;
        }
    return second;
}

} // namespace lanecast::trade
