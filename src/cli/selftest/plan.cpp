#include "cli/selftest/plan.hpp"

#include "cli/selftest/random.hpp"

#include <algorithm>
#include <array>
#include <set>

namespace lanecast::selftest {
namespace {

constexpr std::size_t factor_count = 5;
using Row = std::array<int, factor_count>; ///< an index into the factor's values each

std::vector<int> bits_of_mask(unsigned mask) {
    std::vector<int> values;
    for (int bit = 0; bit < 32; ++bit)
        if ((mask >> bit & 1u) != 0) values.push_back(bit);
    return values;
}

using Pair = std::array<int, 4>; ///< factor, value, factor, value

std::set<Pair> pairs_of(const Row& row) {
    std::set<Pair> pairs;
    for (std::size_t i = 0; i < factor_count; ++i)
        for (std::size_t k = i + 1; k < factor_count; ++k) pairs.insert({int(i), row[i], int(k), row[k]});
    return pairs;
}

/// Greedy: of 50 rows that begin with a pair which is still missing, the one that brings most.
std::vector<Row> cover(const Row& counts) {
    std::set<Pair> missing;
    for (std::size_t i = 0; i < factor_count; ++i)
        for (std::size_t k = i + 1; k < factor_count; ++k)
            for (int a = 0; a < counts[i]; ++a)
                for (int b = 0; b < counts[k]; ++b) missing.insert({int(i), a, int(k), b});
    Random random(1);
    std::vector<Row> rows;
    while (!missing.empty()) {
        Row best{};
        std::size_t most = 0;
        for (int attempt = 0; attempt < 50; ++attempt) {
            Row row;
            for (std::size_t i = 0; i < factor_count; ++i) row[i] = random.below(counts[i]);
            const Pair& first = *missing.begin();
            row[static_cast<std::size_t>(first[0])] = first[1];
            row[static_cast<std::size_t>(first[2])] = first[3];
            std::size_t gain = 0;
            for (const Pair& pair : pairs_of(row)) gain += missing.count(pair);
            if (gain > most) most = gain, best = row;
        }
        for (const Pair& pair : pairs_of(best)) missing.erase(pair);
        rows.push_back(best);
    }
    return rows;
}

} // namespace

std::vector<Setting> covering_settings(const Case& c, const std::vector<const KernelTable*>& kernels) {
    const std::vector<int> primitives = bits_of_mask(c.scope.primitives), placings = bits_of_mask(c.scope.placings);
    const std::vector<int> paths = bits_of_mask(c.scope.paths);
    const int leaf_sizes = c.scope.leaf_sizes ? max_leaf_size : 1;
    std::vector<Setting> settings;
    const Row counts{int(kernels.size()), int(primitives.size()), int(placings.size()), leaf_sizes, int(paths.size())};
    for (const Row& row : cover(counts)) {
        Setting setting;
        setting.kernels = kernels[static_cast<std::size_t>(row[0])];
        setting.primitive = static_cast<PrimitiveKind>(primitives[static_cast<std::size_t>(row[1])]);
        setting.placing = static_cast<Placing>(placings[static_cast<std::size_t>(row[2])]);
        setting.leaf_size = c.scope.leaf_sizes ? row[3] + 1 : max_leaf_size;
        setting.path = static_cast<Path>(paths[static_cast<std::size_t>(row[4])]);
        settings.push_back(setting);
    }
    return settings;
}

std::uint64_t block_rays(const Setting& setting, std::uint64_t usual) {
    const std::uint64_t share = setting.kernels->width == 1 ? 32 : setting.path == Path::single ? 8 : 1;
    return std::max<std::uint64_t>(usual / share, 64);
}

Plan make_plan(const Case& c, const std::vector<const KernelTable*>& kernels, std::uint64_t rays) {
    Plan plan{covering_settings(c, kernels), c.block_rays, 0};
    const auto once = [&] { // through all rows
        std::uint64_t sum = 0;
        for (const Setting& setting : plan.settings) sum += block_rays(setting, plan.usual_rays);
        return sum;
    };
    while (once() > rays && plan.usual_rays > 64) plan.usual_rays /= 2;
    const std::uint64_t rounds = std::max<std::uint64_t>((rays + once() - 1) / once(), 1);
    plan.blocks = rounds * plan.settings.size();
    return plan;
}

} // namespace lanecast::selftest
