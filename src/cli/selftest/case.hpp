#pragma once
// What a case is: one invariant, tried by blocks of rays that are independent of each other; and what blocks add up to.

#include "render/kernel_table.hpp"

#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace lanecast::selftest {

/// How the objects of a scene are placed.
enum class Placing { plain, translated, rotated, scaled, stretched, mirrored };
inline constexpr int placing_count = 6;
[[nodiscard]] const char* name_of(Placing placing);

/// How rays are handed to the kernels.
enum class Path {
    batch,  ///< many per call, neighbours alike: packets
    mixed,  ///< many per call, in no order: packets that fall apart
    single, ///< one per call
};
inline constexpr int path_count = 3;
[[nodiscard]] const char* name_of(Path path);

/// One row of the covering list.
struct Setting {
    const KernelTable* kernels = nullptr;
    PrimitiveKind primitive = PrimitiveKind::triangle;
    Placing placing = Placing::plain;
    int leaf_size = 8; ///< every leaf but the last holds so many, where there are enough of a kind
    Path path = Path::batch;
};
[[nodiscard]] std::string text_of(const Setting& setting);

struct Block {
    Setting setting;
    std::uint64_t seed;
    std::uint64_t rays;                             ///< about as many
    const std::vector<const KernelTable*>& kernels; ///< all that take part in the run, the slowest first
};

/// Sums and largest values, so that the order of blocks does not matter; `example` is of the first block that failed.
struct Tally {
    std::uint64_t rays = 0;
    std::uint64_t failures = 0; ///< rays that break the invariant
    double worst = 0;           ///< error, in the case's unit
    /// Errors by size, sixteen classes per factor of two.
    std::map<int, std::uint64_t> errors;
    std::string example;

    void fail(const std::string& what, std::uint64_t count = 1) {
        if (failures == 0) example = what;
        failures += count;
    }
    void add_error(double error);
    /// The upper end of the class in which that share of the errors is reached; 0: there are none.
    [[nodiscard]] double percentile(double share) const;
    [[nodiscard]] double mean() const; ///< by the upper ends of the classes: 4 % too large at most
    void add(const Tally& later);
};

/// What must hold of a tally. Limits are inclusive.
struct Target {
    double failure_rate = 0; ///< failures per ray
    double worst = std::numeric_limits<double>::infinity();
    double p99 = std::numeric_limits<double>::infinity();
    double mean = std::numeric_limits<double>::infinity();
    double median = std::numeric_limits<double>::infinity();
    const char* unit = ""; ///< of errors
    bool listed = false;   ///< a miss is shown, and does not fail the run
};
[[nodiscard]] bool is_met(const Target& target, const Tally& tally);
[[nodiscard]] std::string text_of(const Target& target);

/// What of the covering list makes a difference to a case.
struct Scope {
    unsigned primitives = 1; ///< bit: PrimitiveKind
    unsigned placings = 1;   ///< bit: Placing
    unsigned paths = 1;      ///< bit: Path
    bool leaf_sizes = false;
};
inline constexpr unsigned every_primitive = 0x7f;
inline constexpr unsigned bounded_primitives = 0x3f;
inline constexpr unsigned every_placing = 0x3f;
inline constexpr unsigned every_path = 7;
[[nodiscard]] constexpr unsigned only(PrimitiveKind kind) { return 1u << static_cast<unsigned>(kind); }
[[nodiscard]] constexpr unsigned only(Placing placing) { return 1u << static_cast<unsigned>(placing); }
[[nodiscard]] constexpr unsigned only(Path path) { return 1u << static_cast<unsigned>(path); }

struct Case {
    const char* id;        ///< "N1" to "N23"
    const char* part;      ///< of the invariant
    const char* statement; ///< in a line
    Target target;
    void (*run)(const Block& block, Tally& tally);
    Scope scope;
    std::uint64_t quick_rays;         ///< in the minute's size
    std::uint64_t block_rays = 65536; ///< a block takes 10 to 300 ms
    double full_share = 1;            ///< of the rays of a full run, where rays are dear or nothing is left to find
};

/// In the order of the reference table.
[[nodiscard]] const std::vector<Case>& all_cases();

} // namespace lanecast::selftest
