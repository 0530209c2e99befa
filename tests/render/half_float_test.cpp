// Our halves are Imath's, bit for bit, within the range of half.
#include "render/half_float.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include <Imath/half.h>

using namespace lanecast;

namespace {

int wrong = 0;

void compare_with_imath(float value) {
    if (!(std::abs(value) <= largest_half)) return; // NaN, too
    const Imath::half half(value);
    if (half_bits(value) != half.bits() || rounded_to_half(value) != static_cast<float>(half)) ++wrong;
}

} // namespace

TEST_CASE("every half, every tie between two, and their neighbours") {
    wrong = 0;
    for (unsigned bits = 0; bits < 0x7bff; ++bits) { // all finite positive ones but the last
        const float value = Imath::half(Imath::half::FromBits, static_cast<std::uint16_t>(bits));
        const float next = Imath::half(Imath::half::FromBits, static_cast<std::uint16_t>(bits + 1));
        const float tie = 0.5f * value + 0.5f * next;
        if (half_bits(value) != bits || half_bits(-value) != (bits | 0x8000u)) ++wrong;
        if (half_bits(tie) != bits + (bits & 1)) ++wrong; // to even
        for (const float v : {std::nextafter(value, 1e9f), std::nextafter(tie, 0.0f), std::nextafter(tie, 1e9f), tie, next}) {
            compare_with_imath(v);
            compare_with_imath(-v);
        }
    }
    CHECK(wrong == 0);
    CHECK(half_bits(largest_half) == 0x7bff);
}

TEST_CASE("random floats of every exponent") {
    wrong = 0;
    std::mt19937 random(3);
    for (int i = 0; i < 2000000; ++i) compare_with_imath(std::bit_cast<float>(static_cast<std::uint32_t>(random())));
    CHECK(wrong == 0);
}
