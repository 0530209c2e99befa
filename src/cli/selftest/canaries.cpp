// N21: what the compiler and the processor must do for everything else to hold, for each set of flags that kernels are built
// with.

#include "cli/selftest/canary_subjects.hpp"
#include "cli/selftest/cases.hpp"
#include "cli/selftest/random.hpp"
#include "cli/selftest/rays.hpp"

#include <array>
#include <cfenv>
#include <cmath>

#define LANECAST_KERNELS(isa)                                                                                                    \
    namespace canary_##isa {                                                                                                     \
        CANARY_SUBJECTS                                                                                                          \
    }                                                                                                                            \
    namespace lanecast::isa {                                                                                                    \
    extern const KernelTable kernels;                                                                                            \
    }
#include "render/kernel_list.inc"
#undef LANECAST_KERNELS

namespace lanecast::selftest {
namespace {

struct Subjects {
    const KernelTable* kernels;
    void (*round_to_float)(const double*, double*);
    std::array<float (*)(float, float, float), 3> multiply_add;
    std::array<float (*)(float, float), 2> smaller, larger;
    float (*add)(float, float);
    void (*divide)(const float*, const float*, float*);
    void (*square_root)(const float*, float*);
};

constexpr Subjects all_subjects[] = {
#define LANECAST_KERNELS(isa)                                                                                                    \
    {&lanecast::isa::kernels,                                                                                                    \
     canary_##isa::round_to_float,                                                                                               \
     {canary_##isa::multiply_add, canary_##isa::multiply_add_packed, canary_##isa::multiply_add_widest},                         \
     {canary_##isa::smaller, canary_##isa::smaller_packed},                                                                      \
     {canary_##isa::larger, canary_##isa::larger_packed},                                                                        \
     canary_##isa::add,                                                                                                          \
     canary_##isa::divide,                                                                                                       \
     canary_##isa::square_root},
#include "render/kernel_list.inc"
#undef LANECAST_KERNELS
};

void check(bool right, const char* what, Tally& tally) {
    if (!right) tally.fail(what);
    ++tally.rays;
}

/// What holds once and for all.
void check_rules(const Subjects& s, Tally& tally) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    volatile float a = 1.0f + 0x1p-12f, c = -(1.0f + 0x1p-11f); // the square is a tie: fused, its last term would survive
    for (const auto multiply_add : s.multiply_add) check(multiply_add(a, a, c) == 0.0f, "a * b + c was fused", tally);
    for (const auto smaller : s.smaller) {
        check(smaller(nan, 1.0f) == 1.0f && std::isnan(smaller(1.0f, nan)), "min does not return its second operand", tally);
        check(bits_of(smaller(0.0f, -0.0f)) == bits_of(-0.0f), "min of zeros", tally);
    }
    for (const auto larger : s.larger) {
        check(larger(nan, 1.0f) == 1.0f && std::isnan(larger(1.0f, nan)), "max does not return its second operand", tally);
        check(bits_of(larger(0.0f, -0.0f)) == bits_of(-0.0f), "max of zeros", tally);
    }
    check(s.add(1.0f, 0x1p-24f) == 1.0f && s.add(1.0f + 0x1p-23f, 0x1p-24f) == 1.0f + 0x1p-22f, "ties do not go to even", tally);
    check(std::fegetround() == FE_TONEAREST, "the rounding mode is not to nearest", tally);
}

/// Kernels flush denormals and put the control register back.
void check_control(const KernelTable& kernels, Tally& tally) {
    const unsigned before = __builtin_ia32_stmxcsr();
    constexpr unsigned sticky = 0x3f; // exceptions that occurred
    SceneView nothing{};
    Rays rays;
    rays.add({0, 0, 0}, {0, 0, 1});
    static_cast<void>(ask(kernels, nothing, rays, Path::batch));
    check((before & ~sticky) == (__builtin_ia32_stmxcsr() & ~sticky), "a call changed the control register", tally);
    check((before & 0x8040u) == 0, "the program runs with denormals off outside kernels", tally);
}

} // namespace

void test_canaries(const Block& block, Tally& tally) {
    Random random(block.seed);
    for (const Subjects& s : all_subjects) {
        if (s.kernels != block.setting.kernels) continue;
        check_rules(s, tally);
        check_control(*s.kernels, tally);
        while (tally.rays < block.rays) {
            double in[3], out[3];
            for (double& x : in) x = random.uniform(-1, 1) * random.magnitude(1e-20, 1e20);
            s.round_to_float(in, out);
            for (int i = 0; i < 3; ++i) {
                volatile float rounded = static_cast<float>(in[i]);
                check(out[i] == static_cast<double>(rounded), "(double)(float)x was not rounded", tally);
            }
            float a[8], b[8], quotient[8], root[8];
            for (int i = 0; i < 8; ++i) {
                a[i] = static_cast<float>(random.magnitude(1e-9, 1e9));
                b[i] = static_cast<float>(random.magnitude(1e-9, 1e9));
            }
            s.divide(a, b, quotient);
            s.square_root(a, root);
            for (int i = 0; i < 8; ++i) { // double holds enough digits that rounding it again is right
                volatile double exact_quotient = static_cast<double>(a[i]) / static_cast<double>(b[i]);
                volatile double exact_root = std::sqrt(static_cast<double>(a[i]));
                check(quotient[i] == static_cast<float>(exact_quotient), "a quotient is not correctly rounded", tally);
                check(root[i] == static_cast<float>(exact_root), "a square root is not correctly rounded", tally);
            }
        }
    }
}

} // namespace lanecast::selftest
