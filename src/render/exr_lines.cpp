#include "render/exr_lines.hpp"

#include "render/deflate.hpp"
#include "render/half_float.hpp"
#include "render/scrub.hpp"
#include "scene/parallel.hpp"

#include <algorithm>
#include <bit>

namespace lanecast {
namespace {

constexpr int level = 4;                  ///< OpenEXR's default. Measured: docs/output.md
constexpr std::size_t lines_at_once = 16; ///< a compressor for each so many

static_assert(std::endian::native == std::endian::little, "as the file is");

template <class Pixel>
[[nodiscard]] Pixel pixel_of(float value) noexcept;
template <>
std::uint16_t pixel_of<std::uint16_t>(float value) noexcept {
    return half_bits(std::clamp(value == value ? value : 0.0f, -largest_half, largest_half));
}
template <>
float pixel_of<float>(float value) noexcept {
    return scrubbed(value);
}

/// Channels one after the other, by name: B, G, R.
template <class Pixel>
void line_of(const Film& film, std::size_t line, Pixel* out) noexcept {
    const auto width = static_cast<std::size_t>(film.width);
    for (std::size_t c = 3; c-- > 0; out += width) {
        const float* const from = film.rgb[c].data() + line * width;
        for (std::size_t x = 0; x < width; ++x) out[x] = pixel_of<Pixel>(from[x]);
    }
}

/// What zlib is given: first the even bytes, then the odd ones, each as its difference from the one before, plus 128.
void predict(const unsigned char* line, std::size_t size, unsigned char* split, unsigned char* out) noexcept {
    const std::size_t half = size / 2; // a pixel is an even number of bytes
    for (std::size_t i = 0; i < half; ++i) {
        split[i] = line[2 * i];
        split[half + i] = line[2 * i + 1];
    }
    out[0] = split[0];
    for (std::size_t i = 1; i < size; ++i) out[i] = static_cast<unsigned char>(split[i] - split[i - 1] + 128);
}

void append(std::vector<unsigned char>& bytes, const void* data, std::size_t size) {
    const auto* const first = static_cast<const unsigned char*>(data);
    bytes.insert(bytes.end(), first, first + size);
}

/// Lines first to last - 1.
template <class Pixel>
[[nodiscard]] ExrLines compress_band(const Film& film, std::size_t first, std::size_t last) {
    std::vector<Pixel> line(3 * static_cast<std::size_t>(film.width));
    const auto* const plain = reinterpret_cast<const unsigned char*>(line.data());
    const std::size_t size = line.size() * sizeof(Pixel);
    std::vector<unsigned char> split(size), predicted(size), compressed(size);
    Deflater deflater(level);
    ExrLines lines;
    lines.bytes.reserve((last - first) * (8 + size));
    for (std::size_t y = first; y < last; ++y) {
        line_of(film, y, line.data());
        predict(plain, size, split.data(), predicted.data());
        const std::size_t less = deflater.compress(predicted.data(), size, compressed.data(), size - 1);
        const std::size_t kept = less > 0 ? less : size; // as it is where that is not less
        const std::int32_t head[2] = {film.y0 + static_cast<std::int32_t>(y), static_cast<std::int32_t>(kept)};
        append(lines.bytes, head, sizeof head);
        append(lines.bytes, less > 0 ? compressed.data() : plain, kept);
        lines.sizes.push_back(static_cast<std::uint32_t>(sizeof head + kept));
    }
    return lines;
}

} // namespace

std::vector<ExrLines> compress_lines(const Film& film, bool float_pixels, int threads) {
    const auto height = static_cast<std::size_t>(film.height);
    std::vector<ExrLines> all(piece_count(height, lines_at_once));
    parallel_for(threads, all.size(), [&](std::size_t band) {
        const std::size_t first = band * lines_at_once, last = std::min(height, first + lines_at_once);
        all[band] = (float_pixels ? compress_band<float> : compress_band<std::uint16_t>)(film, first, last);
    });
    return all;
}

} // namespace lanecast
