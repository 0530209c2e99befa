// N19: no infinity in a file of half floats, and its count.

#include "cli/selftest/cases.hpp"
#include "cli/selftest/picture.hpp"
#include "cli/selftest/random.hpp"
#include "render/exr_io.hpp"
#include "render/half_float.hpp"
#include "render/scrub.hpp"

#include <cmath>
#include <filesystem>

#include <unistd.h>

namespace lanecast::selftest {
namespace {

/// Finite, of any size; often about the ends of half's range, and in the middle between two halves.
float any_finite(Random& random) {
    const int kind = random.below(5);
    if (kind == 4) return std::bit_cast<float>(std::bit_cast<std::uint32_t>(any_finite(random)) & ~0xfffu);
    if (kind == 0) return static_cast<float>(random.uniform(65000, 66000)) * (random.chance(0.5) ? 1.0f : -1.0f);
    if (kind == 1) return static_cast<float>(random.uniform(-1, 1) * random.magnitude(1e-9, 1e-3));
    for (;;) {
        const float value = std::bit_cast<float>(static_cast<std::uint32_t>(random.bits()));
        if (std::isfinite(value)) return value;
    }
}

/// The nearest half, by way of double: 11 bits from 2^-14 on, steps of 2^-24 below.
double rounded_to_half(double x) {
    const double size = std::fabs(x);
    if (size >= 65504) return std::copysign(65504.0, x);
    int exponent = 0;
    std::frexp(size, &exponent);
    const double step = std::ldexp(1.0, std::max(exponent - 11, -24));
    return std::copysign(std::min(std::nearbyint(size / step) * step, 65504.0), x);
}

} // namespace

void test_half_file(const Block& block, Tally& tally) {
    Random random(block.seed);
    const int width = 64, height = std::max(1, static_cast<int>(block.rays / 192));
    Film film = make_film(width, height, {0, 0, width, height});
    std::uint64_t beyond = 0;
    for (auto& plane : film.rgb)
        for (float& value : plane) {
            value = any_finite(random);
            beyond += std::fabs(double{value}) > 65504 ? 1 : 0;
        }
    if (count_beyond_half(film) != beyond) tally.fail("the count of values beyond half is wrong");
    const std::filesystem::path file =
        std::filesystem::temp_directory_path() /
        ("lanecast-selftest-" + std::to_string(::getpid()) + "-" + std::to_string(block.seed) + ".exr");
    write_exr(file, film);
    const Film read = read_exr(file);
    std::filesystem::remove(file);
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < film.rgb[c].size(); ++i) {
            ++tally.rays;
            const float value = read.rgb[c][i];
            if (!std::isfinite(value))
                tally.fail(std::to_string(film.rgb[c][i]) + " was written as " + std::to_string(value));
            else if (double{value} != rounded_to_half(double{film.rgb[c][i]}))
                tally.fail(std::to_string(film.rgb[c][i]) + " was rounded to " + std::to_string(value));
        }
}

} // namespace lanecast::selftest
