#pragma once
// What is compared: a library, an instruction set and a way of asking it.

#include "cli/bench/ray_sets.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace lanecast::bench {

struct HitList {
    std::vector<float> t;                 ///< closest: of the hit; infinity for a miss. any: 0 for a hit, infinity for a miss
    std::vector<std::uint32_t> primitive; ///< closest: triangle; no_hit for a miss
};

/// Reads a byte of every cache line, so that they are at hand when the clock starts: a prefetch may still be on its way.
inline void warm(const void* first, std::size_t bytes) {
    const auto* const at = static_cast<const volatile unsigned char*>(first);
    for (std::size_t i = 0; i < bytes; i += 64) static_cast<void>(at[i]);
    if (bytes > 0) static_cast<void>(at[bytes - 1]);
}

class Contender {
public:
    std::string library;   ///< with its version: "lanecast 0.1.0", "embree 3.13.5"
    std::string isa;       ///< "sse4.2", "avx2", "avx512", "scalar"
    std::string precision; ///< "balanced", "reference"; of others "-"
    std::string mode;      ///< ours: the tree, "default" or "quality"; "high:16c": build quality, width, coherent flag
    bool ours = false;

    virtual ~Contender() = default;
    virtual void prepare(const RaySet& set) = 0; ///< converts all rays; untimed
    virtual void reset(std::size_t chunk) = 0;   ///< makes the chunk's rays as good as new, in cache; untimed
    virtual void trace(std::size_t chunk) = 0;   ///< timed. Chunks may be traced at the same time
    [[nodiscard]] virtual HitList hits() const = 0;
};
using Contenders = std::vector<std::unique_ptr<Contender>>;

/// A build of a tree that was timed.
struct BuildRow {
    std::string library, isa, quality;
    double seconds = 0, bytes = 0;
};

void add_ours(Contenders& contenders, std::vector<BuildRow>& builds, const BenchMesh& mesh, const std::string& isa,
              const std::string& precision, const std::string& bvh, int threads);

/// Every mode of Embree worth trying at that instruction set. Does nothing where it is not there.
void add_embree(Contenders& contenders, std::vector<BuildRow>& builds, const BenchMesh& mesh, const std::string& isa,
                int threads);

} // namespace lanecast::bench
