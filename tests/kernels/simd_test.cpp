// Every batch operation equals the scalar one lane by lane, bit for bit: what "same bytes on every ISA" rests on.

#include "kernels/kernel_support.hpp"
#include "simd/vec3.hpp"

#include <doctest/doctest.h>

using namespace lanecast;
using lanecast::test::canonical;
using lanecast::test::cases;
using lanecast::test::Lottery;

namespace {

using F = NativeFloat;
using S = Scalar<F>;
constexpr int W = width<F>;
constexpr bool is_fast = LANECAST_FAST;

struct Lanes {
    alignas(64) S v[W + 16];
    S operator[](int i) const { return v[i]; }
};
struct IntLanes {
    alignas(64) std::int32_t v[W + 16];
    std::int32_t operator[](int i) const { return v[i]; }
};

Lanes random_lanes(Lottery& random) {
    Lanes lanes{};
    for (S& v : lanes.v) v = static_cast<S>(random.any_float());
    return lanes;
}
F load(const Lanes& lanes) { return lanecast::load<F>(lanes.v); }
Lanes lanes_of(F a) {
    Lanes lanes{};
    lanecast::store(lanes.v, a);
    return lanes;
}
IntLanes lanes_of_int(Int<F> a) {
    IntLanes lanes{};
    lanecast::store(lanes.v, a);
    return lanes;
}
IntLanes random_ints(Lottery& random) {
    IntLanes lanes{};
    for (std::int32_t& v : lanes.v) v = random.chance(0.5) ? random.below(7) - 3 : static_cast<std::int32_t>(random.bits());
    return lanes;
}

/// Denormals vanish in arithmetic under FlushDenormals, but a min or a select may hand one through: both mean 0.
template <class T>
auto flushed(T x) {
    return canonical(std::fabs(x) < std::numeric_limits<T>::min() ? std::copysign(T(0), x) : x);
}

template <class Batch, class One>
void check_unary(const char* name, Batch&& batch, One&& one) {
    Lottery random(1);
    const FlushDenormals flush;
    std::uint64_t wrong = 0;
    for (int n = 0; n < cases(200000) / W; ++n) {
        const Lanes a = random_lanes(random);
        const Lanes r = lanes_of(batch(load(a)));
        for (int i = 0; i < W; ++i) wrong += flushed(r[i]) != flushed(static_cast<S>(one(a[i])));
    }
    INFO(name);
    CHECK(wrong == 0);
}
template <class Batch, class One>
void check_binary(const char* name, Batch&& batch, One&& one) {
    Lottery random(2);
    const FlushDenormals flush;
    std::uint64_t wrong = 0;
    for (int n = 0; n < cases(200000) / W; ++n) {
        const Lanes a = random_lanes(random), b = random_lanes(random);
        const Lanes r = lanes_of(batch(load(a), load(b)));
        for (int i = 0; i < W; ++i) wrong += flushed(r[i]) != flushed(static_cast<S>(one(a[i], b[i])));
    }
    INFO(name);
    CHECK(wrong == 0);
}
template <class Batch, class One>
void check_comparison(const char* name, Batch&& batch, One&& one) {
    Lottery random(3);
    const FlushDenormals flush;
    std::uint64_t wrong = 0, held = 0;
    for (int n = 0; n < cases(200000) / W; ++n) {
        const Lanes a = random_lanes(random);
        Lanes b = random_lanes(random);
        for (int i = 0; i < W; ++i)
            if (random.chance(0.2)) b.v[i] = a.v[i];
        const std::uint32_t m = bits(batch(load(a), load(b)));
        CHECK(m <= all_lanes<F>);
        for (int i = 0; i < W; ++i) {
            wrong += ((m >> i & 1u) != 0) != one(a[i], b[i]);
            held += m >> i & 1u;
        }
    }
    INFO(name);
    CHECK(wrong == 0);
    CHECK(held > 0);
}

// Compiled apart, so that no optimiser folds what the test wants to see executed.
[[gnu::noinline]] bool is_less(S a, S b) { return a < b; }

} // namespace

TEST_CASE("arithmetic of a batch is the scalar one, lane by lane") {
    check_binary(
        "+", [](F a, F b) { return a + b; }, [](S a, S b) { return a + b; });
    check_binary(
        "-", [](F a, F b) { return a - b; }, [](S a, S b) { return a - b; });
    check_binary(
        "*", [](F a, F b) { return a * b; }, [](S a, S b) { return a * b; });
    check_binary(
        "/", [](F a, F b) { return a / b; }, [](S a, S b) { return a / b; });
    check_unary(
        "negation", [](F a) { return -a; }, [](S a) { return std::copysign(a, std::signbit(a) ? S(1) : S(-1)); });
    check_unary(
        "sqrt", [](F a) { return sqrt(a); }, [](S a) { return std::sqrt(a); });
    check_unary(
        "abs", [](F a) { return abs(a); }, [](S a) { return std::fabs(a); });
    check_binary(
        "copysign", [](F a, F b) { return copysign(a, b); }, [](S a, S b) { return std::copysign(a, b); });
    check_binary(
        "+=", [](F a, F b) { return a += b; }, [](S a, S b) { return a + b; });
    // the second operand unless the comparison holds: with NaN, and with zeros of either sign
    check_binary(
        "min", [](F a, F b) { return min(a, b); }, [](S a, S b) { return is_less(a, b) ? a : b; });
    check_binary(
        "max", [](F a, F b) { return max(a, b); }, [](S a, S b) { return is_less(b, a) ? a : b; });
}

TEST_CASE("negation and abs touch the sign bit only") {
    Lottery random(4);
    for (int n = 0; n < cases(100000) / W; ++n) {
        const Lanes a = random_lanes(random);
        const Lanes minus = lanes_of(-load(a)), size = lanes_of(abs(load(a)));
        for (int i = 0; i < W; ++i) {
            if (a[i] != a[i]) continue;
            CHECK(std::signbit(minus[i]) != std::signbit(a[i]));
            CHECK(!std::signbit(size[i]));
        }
    }
}

TEST_CASE("comparisons of a batch are the scalar ones, NaN included") {
    check_comparison(
        "<", [](F a, F b) { return a < b; }, [](S a, S b) { return a < b; });
    check_comparison(
        "<=", [](F a, F b) { return a <= b; }, [](S a, S b) { return a <= b; });
    check_comparison(
        ">", [](F a, F b) { return a > b; }, [](S a, S b) { return a > b; });
    check_comparison(
        ">=", [](F a, F b) { return a >= b; }, [](S a, S b) { return a >= b; });
    check_comparison(
        "==", [](F a, F b) { return a == b; }, [](S a, S b) { return a == b; });
    check_comparison(
        "!=", [](F a, F b) { return Mask<F>(a != b); }, [](S a, S b) { return a != b; });
}

TEST_CASE("masks: bits, logic, select and first_lanes") {
    Lottery random(5);
    for (int n = 0; n < cases(20000); ++n) {
        const auto p = static_cast<std::uint32_t>(random.bits()) & all_lanes<F>;
        const auto q = static_cast<std::uint32_t>(random.bits()) & all_lanes<F>;
        const Mask<F> mp = mask_from_bits<F>(p), mq = mask_from_bits<F>(q);
        CHECK(bits(mp) == p);
        CHECK(bits(mp & mq) == (p & q));
        CHECK(bits(mp | mq) == (p | q));
        CHECK(bits(!mp) == (~p & all_lanes<F>));
        CHECK(any(mp) == (p != 0));
        CHECK(none(mp) == (p == 0));
        CHECK(all(mp) == (p == all_lanes<F>));
        const Lanes a = random_lanes(random), b = random_lanes(random);
        const IntLanes ia = random_ints(random), ib = random_ints(random);
        const Lanes chosen = lanes_of(select(mp, load(a), load(b)));
        const IntLanes chosen_int = lanes_of_int(select(mp, load_int<F>(ia.v), load_int<F>(ib.v)));
        for (int i = 0; i < W; ++i) {
            const bool left = (p >> i & 1u) != 0;
            CHECK(canonical(chosen[i]) == canonical(left ? a[i] : b[i]));
            CHECK(chosen_int[i] == (left ? ia[i] : ib[i]));
        }
    }
    for (std::uint32_t n = 0; n < 70; ++n) CHECK(bits(first_lanes<F>(n)) == (n >= W ? all_lanes<F> : (1u << n) - 1u));
    CHECK(bits(Mask<F>(true)) == all_lanes<F>);
    CHECK(bits(Mask<F>(false)) == 0);
}

TEST_CASE("integer operations of a batch are the scalar ones") {
    Lottery random(6);
    for (int n = 0; n < cases(50000) / W; ++n) {
        const IntLanes a = random_ints(random), b = random_ints(random);
        const Int<F> va = load_int<F>(a.v), vb = load_int<F>(b.v);
        IntLanes sum{}, difference{};
        if constexpr (W > 1) sum = lanes_of_int(va + vb), difference = lanes_of_int(va - vb);
        const IntLanes both = lanes_of_int(va & vb), either = lanes_of_int(va | vb);
        const IntLanes shifted = lanes_of_int(shift_right(va, 7)),
                       hashed = lanes_of_int(multiply_add(va, 747796405u, 2891336453u));
        const std::uint32_t equal = bits(Mask<F>(va == vb)), greater = bits(Mask<F>(va > vb));
        for (int i = 0; i < W; ++i) {
            const auto ua = static_cast<std::uint32_t>(a[i]), ub = static_cast<std::uint32_t>(b[i]);
            if constexpr (W > 1) {
                CHECK(static_cast<std::uint32_t>(sum[i]) == ua + ub);
                CHECK(static_cast<std::uint32_t>(difference[i]) == ua - ub);
            }
            CHECK(both[i] == (a[i] & b[i]));
            CHECK(either[i] == (a[i] | b[i]));
            CHECK(shifted[i] == a[i] >> 7);
            CHECK(static_cast<std::uint32_t>(hashed[i]) == ua * 747796405u + 2891336453u);
            CHECK((equal >> i & 1u) == (a[i] == b[i] ? 1u : 0u));
            CHECK((greater >> i & 1u) == (a[i] > b[i] ? 1u : 0u));
        }
    }
}

TEST_CASE("conversions and exponents are the scalar ones") {
    Lottery random(7);
    for (int n = 0; n < cases(200000) / W; ++n) {
        const IntLanes k = random_ints(random);
        Lanes x{}, whole{}, round_me{};
        for (int i = 0; i < W; ++i) {
            x.v[i] = static_cast<S>(std::bit_cast<float>(0x00800000u + static_cast<std::uint32_t>(random.bits() % 0x7f000000u)));
            whole.v[i] = static_cast<S>(random.below(253) - 126);
            round_me.v[i] = static_cast<S>(random.chance(0.2) ? random.below(20) - 9.5 : random.uniform(-4194303.0, 4194303.0));
            if (random.chance(0.3)) round_me.v[i] = static_cast<S>(random.uniform(-130, 130));
        }
        F e{};
        const Lanes m = lanes_of(split_exponent(load(x), e));
        const Lanes exponent = lanes_of(e), power = lanes_of(power_of_two(load(whole)));
        const Lanes rounded = lanes_of(round_to_integer(load(round_me)));
        Lanes from_int{};
        if constexpr (sizeof(S) == 4) from_int = lanes_of(to_float(load_int<F>(k.v)));
        for (int i = 0; i < W; ++i) {
            CHECK(std::ldexp(m[i], static_cast<int>(exponent[i])) == x[i]);
            CHECK(m[i] >= S(0.70710677));
            CHECK(m[i] < S(1.4142137));
            CHECK(power[i] == std::ldexp(S(1), static_cast<int>(whole[i])));
            CHECK(rounded[i] == std::nearbyint(round_me[i]));
            if constexpr (sizeof(S) == 4) CHECK(from_int[i] == static_cast<float>(k[i]));
        }
    }
}

TEST_CASE("fused: the product is exact, the sum rounded to double and then to the result") {
    Lottery random(8);
    std::uint64_t wrong = 0, unlike_fma = 0, unlike_plain = 0;
    const int rounds = cases(400000) / W;
    for (int n = 0; n < rounds; ++n) {
        Lanes a{}, b{}, c{}, d{};
        for (int i = 0; i < W; ++i) {
            a.v[i] = static_cast<S>(static_cast<float>(random.uniform(-2, 2)));
            b.v[i] = static_cast<S>(static_cast<float>(random.uniform(-2, 2)));
            // half of the sums cancel: there the product's low bits are the result
            c.v[i] = static_cast<S>(random.chance(0.5) ? static_cast<float>(random.uniform(-2, 2))
                                                       : -static_cast<float>(a.v[i] * b.v[i]));
            d.v[i] = static_cast<S>(static_cast<float>(random.uniform(-2, 2)));
        }
        const Lanes r = lanes_of(fused(load(a), load(b), load(c)));
        const Lanes s = lanes_of(sum_of_squares_less(load(a), load(b), load(c), load(d)));
        for (int i = 0; i < W; ++i) {
            const auto da = static_cast<double>(a[i]), db = static_cast<double>(b[i]), dc = static_cast<double>(c[i]);
            const auto dd = static_cast<double>(d[i]);
            CHECK(static_cast<__float128>(da) * static_cast<__float128>(db) == static_cast<__float128>(da * db));
            const S rounded = is_fast ? std::fma(a[i], b[i], c[i]) : static_cast<S>(da * db + dc);
            wrong += canonical(r[i]) != canonical(rounded);
            wrong += canonical(s[i]) != canonical(static_cast<S>(da * da + db * db + dc * dc - dd * dd));
            // against exact arithmetic: half an ulp, and the second rounding's
            const auto exact = static_cast<double>(static_cast<__float128>(da) * db + dc);
            wrong += lanecast::test::ulps(static_cast<float>(r[i]), exact) > 0.50000001;
            if constexpr (sizeof(S) == 4) {
                unlike_fma += r[i] != std::fma(a[i], b[i], c[i]);
                unlike_plain += r[i] != a[i] * b[i] + c[i];
            }
        }
    }
    CHECK(wrong == 0);
    CHECK(unlike_fma <= 2); // double rounding: about once in 2^29
    if constexpr (sizeof(S) == 4) CHECK(unlike_plain > static_cast<std::uint64_t>(rounds) * W / 4);
}

TEST_CASE("multiply_add and less_product: rounded once in fast, twice elsewhere, in every lane") {
    Lottery random(12);
    std::uint64_t wrong = 0, unlike = 0;
    const int rounds = cases(100000) / W;
    for (int n = 0; n < rounds; ++n) {
        Lanes a{}, b{}, c{};
        for (int i = 0; i < W; ++i) {
            a.v[i] = static_cast<S>(static_cast<float>(random.uniform(-2, 2)));
            b.v[i] = static_cast<S>(static_cast<float>(random.uniform(-2, 2)));
            c.v[i] = static_cast<S>(static_cast<float>(random.uniform(-2, 2)));
        }
        const Lanes sum = lanes_of(multiply_add(load(a), load(b), load(c)));
        const Lanes difference = lanes_of(less_product(load(c), load(a), load(b)));
        for (int i = 0; i < W; ++i) {
            const S twice = a[i] * b[i] + c[i], less_twice = c[i] - a[i] * b[i];
            const S once = std::fma(a[i], b[i], c[i]), less_once = std::fma(-a[i], b[i], c[i]);
            wrong += sum[i] != (is_fast ? once : twice);
            wrong += difference[i] != (is_fast ? less_once : less_twice);
            unlike += once != twice;
        }
    }
    CHECK(wrong == 0);
    if constexpr (sizeof(S) == 4) CHECK(unlike > 0);
}

TEST_CASE("compress_store packs the lanes of a mask, expand_load brings them back") {
    Lottery random(9);
    for (int n = 0; n < cases(40000); ++n) {
        // all masks of narrow batches are met many times
        const auto m = static_cast<std::uint32_t>(random.bits()) & all_lanes<F>;
        const Lanes a = random_lanes(random);
        const IntLanes k = random_ints(random);
        Lanes packed{};
        IntLanes packed_int{};
        compress_store<F>(packed.v, load(a), mask_from_bits<F>(m));
        compress_store_int<F>(packed_int.v, load_int<F>(k.v), mask_from_bits<F>(m));
        int count = 0;
        for_each_bit(m, [&](std::uint32_t lane) {
            CHECK(canonical(packed[count]) == canonical(a[static_cast<int>(lane)]));
            CHECK(packed_int[count] == k[static_cast<int>(lane)]);
            ++count;
        });
        const Lanes back = lanes_of(expand_load<F>(packed.v, mask_from_bits<F>(m)));
        const IntLanes back_int = lanes_of_int(expand_load_int<F>(packed_int.v, mask_from_bits<F>(m)));
        for (int i = 0; i < W; ++i) {
            const bool in = (m >> i & 1u) != 0;
            CHECK(canonical(back[i]) == canonical(in ? a[i] : S(0)));
            CHECK(back_int[i] == (in ? k[i] : 0));
        }
    }
}

TEST_CASE("for_each_unique visits every value once, with all of its lanes, lowest lane first") {
    Lottery random(10);
    for (int n = 0; n < cases(40000); ++n) {
        IntLanes k{};
        for (std::int32_t& v : k.v) v = random.below(1 + random.below(6)) - 2;
        const auto active = static_cast<std::uint32_t>(random.bits()) & all_lanes<F>;
        std::uint32_t seen = 0, order = 0;
        for_each_unique<F>(load_int<F>(k.v), mask_from_bits<F>(active), [&](std::int32_t value, Mask<F> lanes) {
            const std::uint32_t b = bits(lanes);
            std::uint32_t expected = 0;
            for (int i = 0; i < W; ++i)
                if ((active >> i & 1u) != 0 && k[i] == value) expected |= 1u << i;
            CHECK(b == expected);
            CHECK((b & seen) == 0);
            CHECK((seen == 0 || (b & (~b + 1)) > order));
            order = b & (~b + 1);
            seen |= b;
        });
        CHECK(seen == active);
    }
}

TEST_CASE("the batch for eight items computes as one item does") {
    using E = Eight<F>;
    constexpr int n_lanes = width<E>;
    Lottery random(12);
    for (int n = 0; n < cases(40000); ++n) {
        float a[8], b[8];
        for (int i = 0; i < 8; ++i) {
            a[i] = static_cast<float>(random.uniform(-9, 9));
            b[i] = random.chance(0.2) ? a[i] : static_cast<float>(random.uniform(-9, 9));
        }
        const E x = load_eight<E>(a), y = load_eight<E>(b);
        S sum[8], difference[8], product[8], quotient[8], least[8], most[8];
        lanecast::store(sum, x + y);
        lanecast::store(difference, x - y);
        lanecast::store(product, x * y);
        lanecast::store(quotient, x / y);
        lanecast::store(least, lanecast::min(x, y));
        lanecast::store(most, lanecast::max(x, y));
        const std::uint32_t below = bits(x <= y), above = bits(x >= y);
        const std::uint32_t first = random.below(n_lanes + 1);
        CHECK(bits(first_lanes<E>(first)) == (1u << first) - 1u);
        CHECK(bits((x <= y) & (x >= y)) == (below & above));
        CHECK(bits((x <= y) | (x >= y)) == (below | above));
        CHECK(none(x <= y) == (below == 0));
        for (int i = 0; i < n_lanes; ++i) {
            const S p = static_cast<S>(a[i]), q = static_cast<S>(b[i]);
            CHECK(sum[i] == p + q);
            CHECK(difference[i] == p - q);
            CHECK(product[i] == p * q);
            CHECK(quotient[i] == p / q);
            CHECK(least[i] == (p < q ? p : q));
            CHECK(most[i] == (p > q ? p : q));
            CHECK(((below >> i) & 1u) == (p <= q ? 1u : 0u));
            CHECK(((above >> i) & 1u) == (p >= q ? 1u : 0u));
        }
    }
}

TEST_CASE("load_eight, gather, reduce_min and reduce_max") {
    Lottery random(11);
    for (int n = 0; n < cases(40000); ++n) {
        float eight[8];
        for (float& x : eight) x = static_cast<float>(random.uniform(-9, 9));
        S loaded[8];
        lanecast::store(loaded, load_eight<Eight<F>>(eight));
        for (int i = 0; i < width<Eight<F>>; ++i) CHECK(loaded[i] == static_cast<S>(eight[i]));
        Lanes x{};
        IntLanes table{}, index{};
        S lowest = std::numeric_limits<S>::infinity(), highest = -lowest;
        for (int i = 0; i < W; ++i) {
            x.v[i] = static_cast<S>(static_cast<float>(random.chance(0.1) ? random.below(3) - 1 : random.uniform(-9, 9)));
            if (random.chance(0.05))
                x.v[i] = random.chance(0.5) ? std::numeric_limits<S>::infinity() : -std::numeric_limits<S>::infinity();
            lowest = std::fmin(lowest, x[i]);
            highest = std::fmax(highest, x[i]);
            table.v[i] = static_cast<std::int32_t>(random.bits());
            index.v[i] = random.below(W);
        }
        CHECK(reduce_min(load(x)) == lowest);
        CHECK(reduce_max(load(x)) == highest);
        const IntLanes picked_int = lanes_of_int(gather(table.v, load_int<F>(index.v)));
        for (int i = 0; i < W; ++i) {
            CHECK(picked_int[i] == table[index[i]]);
        }
    }
}

TEST_CASE("FlushDenormals: denormals are zero inside, and the old state comes back") {
    const volatile float tiny = std::numeric_limits<float>::denorm_min(), least = std::numeric_limits<float>::min();
    const auto batch_product = [&] { return lanes_of(F(S(least)) * F(S(0.5))); };
    CHECK(least * 0.5f > 0.0f);
    {
        const FlushDenormals flush;
        if constexpr (sizeof(S) == 4) {
            const Lanes product = batch_product(), sum = lanes_of(F(S(tiny)) + F(S(tiny)));
            for (int i = 0; i < W; ++i) {
                CHECK(product[i] == 0);
                CHECK(sum[i] == 0);
            }
        }
        const volatile float half = least * 0.5f;
        CHECK(std::bit_cast<std::uint32_t>(static_cast<float>(half)) == 0);
    }
    const volatile float half = least * 0.5f;
    CHECK(std::bit_cast<std::uint32_t>(static_cast<float>(half)) != 0);
}
