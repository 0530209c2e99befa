// Promises of the compiler and the C library that our numbers rest on. A failure here explains any failure elsewhere.

#include "cli/selftest/canary_subjects.hpp"

#include <doctest/doctest.h>

#include <bit>
#include <cfenv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <thread>

#include <xmmintrin.h>

namespace {

constexpr unsigned flush_to_zero = 0x8000, denormals_are_zero = 0x0040, rounding_control = 0x6000;
const float nan_value = std::numeric_limits<float>::quiet_NaN();

std::uint32_t bits(float x) { return std::bit_cast<std::uint32_t>(x); }

// The control bits as the program found them, before any of the tests.
const unsigned mxcsr_at_start = _mm_getcsr();

} // namespace

TEST_CASE("(double)(float)x rounds") {
    const double in[3] = {0.1, 0.2, 0.3};
    double out[3] = {}, without_flags[3] = {};
    flagged::round_to_float(in, out);
    unflagged::round_to_float(in, without_flags);
    bool still_needed = false;
    for (int i = 0; i < 3; ++i) {
        volatile float rounded = static_cast<float>(in[i]);
        CHECK(out[i] == static_cast<double>(rounded));
        still_needed = still_needed || without_flags[i] != out[i];
    }
    if (still_needed) MESSAGE("without -fno-tree-slp-vectorize this compiler drops the rounding of (double)(float)x");
}

TEST_CASE("a * b + c rounds twice, also across intrinsics and under -mfma") {
    // (1 + 2^-12)^2 = 1 + 2^-11 + 2^-24, a tie that rounds to 1 + 2^-11; fused, the last term would survive.
    volatile float a = 1.0f + 0x1p-12f, c = -(1.0f + 0x1p-11f);
    CHECK(flagged::multiply_add(a, a, c) == 0.0f);
    CHECK(flagged::multiply_add_packed(a, a, c) == 0.0f);
    CHECK(flagged::multiply_add_widest(a, a, c) == 0.0f);
    if (unflagged::multiply_add(a, a, c) != 0.0f) MESSAGE("without -ffp-contract=off this compiler fuses a * b + c");
    if (unflagged::multiply_add_widest(a, a, c) != 0.0f) MESSAGE("without -ffp-contract=off it fuses across intrinsics");
}

TEST_CASE("min and max return the second operand for NaN and for zeros") {
    const auto check = [](float (*smaller)(float, float), float (*larger)(float, float)) {
        CHECK(smaller(nan_value, 1.0f) == 1.0f);
        CHECK(larger(nan_value, 1.0f) == 1.0f);
        CHECK(std::isnan(smaller(1.0f, nan_value)));
        CHECK(std::isnan(larger(1.0f, nan_value)));
        CHECK(bits(smaller(0.0f, -0.0f)) == bits(-0.0f));
        CHECK(bits(smaller(-0.0f, 0.0f)) == bits(0.0f));
        CHECK(bits(larger(0.0f, -0.0f)) == bits(-0.0f));
        CHECK(bits(larger(-0.0f, 0.0f)) == bits(0.0f));
        CHECK(smaller(1.0f, 2.0f) == 1.0f);
        CHECK(larger(1.0f, 2.0f) == 2.0f);
    };
    check(flagged::smaller, flagged::larger);
    check(flagged::smaller_packed, flagged::larger_packed);
}

TEST_CASE("the program starts with denormals on, rounding to nearest") {
    // A fast-math start-up object, linked by -ffast-math or -Ofast, would have set FTZ and DAZ.
    CHECK((mxcsr_at_start & (flush_to_zero | denormals_are_zero)) == 0);
    CHECK((mxcsr_at_start & rounding_control) == 0);
    CHECK(std::fegetround() == FE_TONEAREST);
    CHECK(flagged::add(1.0f, 0x1p-24f) == 1.0f);                       // ties go to even: down
    CHECK(flagged::add(1.0f + 0x1p-23f, 0x1p-24f) == 1.0f + 0x1p-22f); // and up
    CHECK(flagged::add(-1.0f, -0x1.8p-24f) == -1.0f - 0x1p-23f);
}

TEST_CASE("FTZ and DAZ take effect, and belong to one thread") {
    volatile float tiny = 0x1p-100f, denormal = 0x1p-130f, huge = 0x1p+20f;
    CHECK(flagged::multiply(tiny, 0x1p-30f) == 0x1p-130f);
    CHECK(flagged::multiply(denormal, huge) == 0x1p-110f);
    unsigned seen_by_thread = 0;
    float by_thread = 1.0f, by_thread_in = 1.0f;
    std::jthread([&] {
        _mm_setcsr(_mm_getcsr() | flush_to_zero | denormals_are_zero);
        by_thread = flagged::multiply(tiny, 0x1p-30f);
        by_thread_in = flagged::multiply(denormal, huge);
        seen_by_thread = _mm_getcsr();
    }).join();
    CHECK((seen_by_thread & (flush_to_zero | denormals_are_zero)) == (flush_to_zero | denormals_are_zero));
    CHECK(bits(by_thread) == bits(0.0f));
    CHECK(bits(by_thread_in) == bits(0.0f));
    CHECK((_mm_getcsr() & (flush_to_zero | denormals_are_zero)) == 0);
    CHECK(flagged::multiply(tiny, 0x1p-30f) == 0x1p-130f);
}

TEST_CASE("division and square root are correctly rounded") {
    // In double they are exact enough that rounding to float gives the correctly rounded result (53 >= 2 * 24 + 2).
    std::mt19937 random(1);
    std::uniform_real_distribution<float> exponent(-30.0f, 30.0f);
    for (int round = 0; round < 4000; ++round) {
        float a[8], b[8], quotient[8], root[8];
        for (int i = 0; i < 8; ++i) {
            a[i] = std::exp2(exponent(random));
            b[i] = std::exp2(exponent(random));
        }
        flagged::divide(a, b, quotient);
        flagged::square_root(a, root);
        for (int i = 0; i < 8; ++i) {
            volatile double exact_quotient = static_cast<double>(a[i]) / static_cast<double>(b[i]);
            volatile double exact_root = std::sqrt(static_cast<double>(a[i]));
            REQUIRE(quotient[i] == static_cast<float>(exact_quotient));
            REQUIRE(root[i] == static_cast<float>(exact_root));
        }
    }
}
