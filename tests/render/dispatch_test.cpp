#include "render/dispatch.hpp"
#include "scene/error.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <set>
#include <string>

using namespace lanecast;

namespace {

ExitCode code_of(std::string_view isa, Precision precision) {
    try {
        (void)find_kernels(isa, precision);
    } catch (const Error& error) {
        CHECK(std::string(error.what()).find("'" + std::string(isa) + "'") != std::string::npos);
        return error.code();
    }
    return ExitCode::done;
}

constexpr Precision every_precision[] = {Precision::fast, Precision::balanced, Precision::precise, Precision::reference};

bool usable(std::string_view isa, Precision precision) {
    const std::vector<const KernelTable*> tables = usable_kernels(precision);
    return std::any_of(tables.begin(), tables.end(), [&](const KernelTable* table) { return table->isa == isa; });
}

} // namespace

TEST_CASE("every instruction set is found where build and CPU have it, and is an error elsewhere") {
    const int widths[] = {1, 4, 8, 16};
    const std::vector<IsaInfo> isas = known_isas();
    REQUIRE(isas.size() == 4);
    for (std::size_t i = 0; i < isas.size(); ++i) {
        const IsaInfo& isa = isas[i];
        CAPTURE(isa.name);
        CHECK(isa.width == (isa.compiled ? widths[i] : 0));
        if (isa.compiled && isa.supported) {
            const KernelTable& table = find_kernels(isa.name, Precision::balanced);
            CHECK(table.isa == isa.name);
            CHECK(table.width == isa.width);
            CHECK(table.precision == Precision::balanced);
        } else {
            CHECK(code_of(isa.name, Precision::balanced) == ExitCode::isa);
        }
    }
    CHECK(isas[0].compiled);
    CHECK(isas[0].supported);
}

TEST_CASE("auto is the fastest that can run") {
    const std::vector<IsaInfo> isas = known_isas();
    const auto best = std::find_if(isas.rbegin(), isas.rend(), [](const IsaInfo& isa) { return isa.compiled && isa.supported; });
    REQUIRE(best != isas.rend());
    CHECK(best_isa() == best->name);
    CHECK(find_kernels("auto", Precision::balanced).isa == best->name);
}

TEST_CASE("the reference is scalar, and a table of its own") {
    const KernelTable& table = find_kernels("auto", Precision::reference);
    CHECK(&table == &find_kernels("scalar", Precision::reference));
    CHECK(&table != &find_kernels("scalar", Precision::balanced));
    CHECK(table.precision == Precision::reference);
    CHECK(table.width == 1);
    for (const char* isa : {"sse4.2", "avx2", "avx512"}) CHECK(code_of(isa, Precision::reference) == ExitCode::usage);
}

TEST_CASE("fast is a table of its own where there is fused multiply-add, or the message says what is lacking") {
    CHECK(code_of("scalar", Precision::fast) == ExitCode::usage);
    CHECK(code_of("sse4.2", Precision::fast) == ExitCode::usage);
    bool some = false;
    for (const IsaInfo& isa : known_isas()) {
        if (isa.name == "scalar" || isa.name == "sse4.2") continue;
        CAPTURE(isa.name);
        if (usable(isa.name, Precision::fast)) {
            const KernelTable& table = find_kernels(isa.name, Precision::fast);
            CHECK(table.isa == isa.name);
            CHECK(table.width == isa.width);
            CHECK(table.precision == Precision::fast);
            CHECK(&table != &find_kernels(isa.name, Precision::balanced));
            some = true;
        } else {
            CHECK(code_of(isa.name, Precision::fast) == ExitCode::isa);
        }
    }
    CHECK(best_isa(Precision::fast).empty() == !some);
    if (some) {
        CHECK(find_kernels("auto", Precision::fast).isa == best_isa(Precision::fast));
        return;
    }
    try {
        (void)find_kernels("auto", Precision::fast);
        CHECK(false);
    } catch (const Error& error) {
        CHECK(error.code() == ExitCode::isa);
        CHECK(std::string(error.what()).find("precision 'fast'") != std::string::npos);
    }
}

TEST_CASE("precise is a table of its own where there are vectors, half as wide, or the message says what is lacking") {
    CHECK(code_of("scalar", Precision::precise) == ExitCode::usage);
    for (const IsaInfo& isa : known_isas()) {
        if (isa.name == "scalar") continue;
        CAPTURE(isa.name);
        if (usable(isa.name, Precision::precise)) {
            const KernelTable& table = find_kernels(isa.name, Precision::precise);
            CHECK(table.isa == isa.name);
            CHECK(table.width == isa.width / 2);
            CHECK(table.precision == Precision::precise);
        } else {
            CHECK(code_of(isa.name, Precision::precise) == ExitCode::isa);
        }
    }
    CHECK(truth_kernels().precision == (best_isa(Precision::precise).empty() ? Precision::reference : Precision::precise));
}

TEST_CASE("the tables that are usable are those that can be found") {
    std::size_t found = 0;
    for (const IsaInfo& isa : known_isas())
        for (const Precision precision : every_precision)
            if (code_of(isa.name, precision) == ExitCode::done) {
                ++found;
                CHECK(usable(isa.name, precision));
            }
    CHECK(usable_kernels().size() == found);
    for (const Precision precision : every_precision)
        for (const KernelTable* table : usable_kernels(precision)) CHECK(table->precision == precision);
}

TEST_CASE("precisions have names") {
    for (const Precision precision : every_precision) CHECK(precision_named(name_of(precision)) == precision);
    CHECK_THROWS_AS((void)precision_named("exact"), Error);
}

TEST_CASE("only precise and the reference share their numbers") {
    for (const Precision a : every_precision)
        for (const Precision b : every_precision)
            CHECK(same_numbers(a, b) == (a == b || (a >= Precision::precise && b >= Precision::precise)));
}

TEST_CASE("a name that does not exist is a usage error") {
    for (const char* name : {"", "avx", "AVX2", "sse42", "reference", "neon"}) {
        CHECK(code_of(name, Precision::balanced) == ExitCode::usage);
    }
}

TEST_CASE("every table that can run answers: in an empty scene all rays miss") {
    const SceneView empty{};
    const float zero[5] = {}, one[5] = {1, 1, 1, 1, 1};
    for (const IsaInfo& isa : known_isas()) {
        if (!isa.compiled || !isa.supported) continue;
        CAPTURE(isa.name);
        float t[5] = {};
        std::int32_t slot[5] = {};
        RayStream rays{};
        for (int axis = 0; axis < 3; ++axis) rays.org[axis] = zero, rays.dir[axis] = axis == 2 ? one : zero;
        rays.t = t;
        rays.slot = slot;
        rays.count = 5;
        find_kernels(isa.name, Precision::balanced).closest_hit(empty, rays);
        for (int i = 0; i < 5; ++i) {
            CHECK(slot[i] == -1);
            CHECK(t[i] == std::numeric_limits<float>::infinity());
        }
    }
}
