#include "cli/selftest/caller.hpp"
#include "cli/selftest/peer.hpp"
#include "cli/selftest/progress.hpp"

#include <algorithm>
#include <string_view>

namespace lanecast::selftest {
namespace {

/// Left out: what is about our own trees (N1, N3), pictures, normals of bodies, processor time, and rays that are none (N15),
/// at which Debian's Embree aborts. N4 compares the peer with itself, N5 and N8 are replaced by what a caller of streams can ask.
constexpr std::string_view shared[] = {"N2 edges",
                                       "N2 vertices",
                                       "N4 near",
                                       "N4 far",
                                       "N6",
                                       "N10 far",
                                       "N10 beside",
                                       "N10 huge",
                                       "N10 far, off centre",
                                       "N10 far, rounding",
                                       "N10 huge, off centre",
                                       "N11 sides",
                                       "N11 sides, rounding",
                                       "N11 axis",
                                       "N12 triangles",
                                       "N12 needles",
                                       "N13 points"};

std::vector<Case> make_cases() {
    std::vector<Case> cases;
    for (const Case& c : all_cases()) {
        if (std::find(std::begin(shared), std::end(shared), name_of(c)) == std::end(shared)) continue;
        cases.push_back(c);
        Scope& scope = cases.back().scope;
        scope.primitives &= peer_primitives;
        scope.paths &= ~only(Path::single); // a tree per call; `mixed` asks a peer ray by ray
        scope.leaf_sizes = false;           // its tree is its own
        if (name_of(c) == "N13 points") scope.primitives = only(PrimitiveKind::ellipsoid); // no peer has stretched cylinders
    }
    using enum PrimitiveKind;
    constexpr unsigned paths = only(Path::batch) | only(Path::mixed);
    constexpr unsigned centred = every_placing & ~only(Placing::translated) & ~only(Placing::stretched);
    constexpr Scope round{peer_primitives, every_placing & ~only(Placing::stretched), paths, false};
    constexpr Scope any{only(triangle) | only(sphere), every_placing, paths, false};
    constexpr Scope convex{only(triangle) | only(sphere), centred, paths, false};
    constexpr Scope convex_mesh{only(triangle), centred, paths, false};
    // clang-format off
    const Case more[] = {
        {"N3", "streams", "the object that the double-precision reference finds, or finds for the ray as rounded",
         {}, test_streams, round, 1'000'000, 16384},
        {"N5", "streams, to 2^20", "all lengths times 2^k, k from -20 to 20: the same hits, t times 2^k",
         {}, test_scaled_streams, any, 2'000'000, 16384},
        {"N5", "streams, to 2^36", "k from -36 to 36",
         {}, test_far_scaled_streams, any, 2'000'000, 16384},
        {"N8", "streams", "rays from o + t d outwards meet a convex body again",
         {}, test_started_rays, convex, 1'000'000},
        {"N8", "streams, tmin 1e-3", "if they begin at a thousandth of its size",
         {}, test_shortened_rays, convex, 1'000'000},
        {"N8", "streams, filtered", "if the triangle that they start from is left out",
         {}, test_filtered_rays, convex_mesh, 1'000'000},
    };
    // clang-format on
    cases.insert(cases.end(), std::begin(more), std::end(more));
    const auto number = [](const Case& c) { return std::stoi(c.id + 1); };
    std::stable_sort(cases.begin(), cases.end(), [&](const Case& a, const Case& b) { return number(a) < number(b); });
    return cases;
}

} // namespace

const std::vector<Case>& peer_cases() {
    static const std::vector<Case> cases = make_cases();
    return cases;
}

} // namespace lanecast::selftest
