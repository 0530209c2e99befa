#include "render/dispatch.hpp"

#include "scene/error.hpp"

#include <algorithm>
#include <iterator>

// Each namespace of kernels defines its table with constant initialisation, so nothing compiled for another CPU runs here.
#define LANECAST_KERNELS(isa)                                                                                                    \
    namespace lanecast::isa {                                                                                                    \
    extern const KernelTable kernels;                                                                                            \
    }
#include "render/kernel_list.inc"
#undef LANECAST_KERNELS

namespace lanecast {
namespace {

constexpr const KernelTable* tables[] = {
#define LANECAST_KERNELS(isa) &isa::kernels,
#include "render/kernel_list.inc"
#undef LANECAST_KERNELS
};

// __builtin_cpu_supports asks XGETBV too: AVX-512 counts only where the operating system saves its registers.
bool always() { return true; }
bool has_sse42() { return __builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("popcnt"); }
bool has_avx2() {
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi") &&
           __builtin_cpu_supports("bmi2");
}
bool has_avx512() {
    return has_avx2() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
           __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512cd");
}

struct KnownIsa {
    std::string_view name;
    bool (*supported)();
};
// Slowest first.
constexpr KnownIsa known[] = {{"scalar", always}, {"sse4.2", has_sse42}, {"avx2", has_avx2}, {"avx512", has_avx512}};

const KernelTable* compiled_table(std::string_view isa, Precision precision) {
    const auto* found = std::find_if(std::begin(tables), std::end(tables), [&](const KernelTable* table) {
        return table->isa == isa && table->precision == precision;
    });
    return found == std::end(tables) ? nullptr : *found;
}

// "scalar, avx2": those one could ask for instead.
std::string usable_names() {
    std::string names;
    for (const IsaInfo& isa : known_isas()) {
        if (!isa.compiled || !isa.supported) continue;
        if (!names.empty()) names += ", ";
        names += isa.name;
    }
    return names;
}

} // namespace

std::vector<IsaInfo> known_isas() {
    std::vector<IsaInfo> isas;
    for (const KnownIsa& isa : known) {
        const KernelTable* table = compiled_table(isa.name, Precision::balanced);
        isas.push_back({std::string(isa.name), table ? table->width : 0, table != nullptr, isa.supported()});
    }
    return isas;
}

const char* name_of(Precision precision) {
    constexpr const char* names[] = {"fast", "balanced", "precise", "reference"};
    return names[static_cast<std::size_t>(precision)];
}

Precision precision_named(std::string_view name) {
    for (const Precision precision : {Precision::fast, Precision::balanced, Precision::precise, Precision::reference})
        if (name == name_of(precision)) return precision;
    throw Error(ExitCode::usage,
                "precision '" + std::string(name) + "' does not exist; expected fast, balanced, precise or reference");
}

bool same_numbers(Precision a, Precision b) {
    const auto in_double = [](Precision p) { return p == Precision::precise || p == Precision::reference; };
    return a == b || (in_double(a) && in_double(b));
}

std::string_view best_isa(Precision precision) {
    const auto best = std::find_if(std::rbegin(known), std::rend(known),
                                   [&](const KnownIsa& isa) { return compiled_table(isa.name, precision) && isa.supported(); });
    return best == std::rend(known) ? "" : best->name;
}

std::vector<const KernelTable*> usable_kernels() {
    std::vector<const KernelTable*> usable;
    for (const KnownIsa& isa : known)
        for (const KernelTable* table : tables)
            if (table->isa == isa.name && isa.supported()) usable.push_back(table);
    return usable;
}

std::vector<const KernelTable*> usable_kernels(Precision precision) {
    std::vector<const KernelTable*> usable = usable_kernels();
    std::erase_if(usable, [&](const KernelTable* table) { return table->precision != precision; });
    return usable;
}

const KernelTable& truth_kernels() {
    return find_kernels("auto", best_isa(Precision::precise).empty() ? Precision::reference : Precision::precise);
}

const KernelTable& find_kernels(std::string_view isa, Precision precision) {
    const std::string named = "precision '" + std::string(name_of(precision)) + "'";
    if (isa == "auto") {
        isa = best_isa(precision);
        if (isa.empty())
            throw Error(ExitCode::isa, "this build has no kernels of " + named + " that this CPU runs; it needs " +
                                           (precision == Precision::precise ? "sse4.2, " : "") + "avx2 or avx512");
    }
    const auto* entry = std::find_if(std::begin(known), std::end(known), [&](const KnownIsa& k) { return k.name == isa; });
    const std::string quoted = "instruction set '" + std::string(isa) + "'";
    if (entry == std::end(known)) {
        throw Error(ExitCode::usage, quoted + " does not exist; expected auto, scalar, sse4.2, avx2 or avx512");
    }
    if (precision == Precision::reference && isa != "scalar")
        throw Error(ExitCode::usage, named + " is computed by 'scalar' only, not by " + quoted);
    if (precision == Precision::precise && isa == "scalar")
        throw Error(ExitCode::usage, named + " needs vectors; of 'scalar', 'reference' gives the same numbers");
    if (precision == Precision::fast && isa != "avx2" && isa != "avx512")
        throw Error(ExitCode::usage, named + " needs fused multiply-add: 'avx2' or 'avx512', not " + quoted);
    if (!entry->supported()) throw Error(ExitCode::isa, "this CPU lacks " + quoted + "; it can run " + usable_names());
    const KernelTable* table = compiled_table(isa, precision);
    if (!table && compiled_table(isa, Precision::balanced))
        throw Error(ExitCode::isa, "this build lacks " + named + " for " + quoted);
    if (!table) throw Error(ExitCode::isa, "this build lacks " + quoted + "; it holds " + usable_names());
    return *table;
}

} // namespace lanecast
