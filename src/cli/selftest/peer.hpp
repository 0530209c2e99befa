#pragma once
// A peer: another program's ray tracer that is asked the rays of our cases, as one more table of kernels. It gets the very
// floats that our kernels read, or where the rays are in the caller's units, those that its caller would give it.

#include "cli/selftest/rays.hpp"

#include <string>
#include <vector>

namespace lanecast::selftest {

/// A scene without anything of ours in its form: no tree, no inverse matrices. Triangles have the slots from 0 on.
struct PeerScene {
    struct Body {
        std::int32_t slot;
        PrimitiveKind kind; ///< ellipsoid: a unit sphere; cylinder, cone: y in [-1/2, 1/2], radius 1 + taper * y
        float taper;
        float world_from_object[9], translation[3]; ///< row-major
    };
    std::vector<float> corners; ///< nine per triangle
    std::vector<SphereRecord> spheres;
    std::int32_t first_sphere = 0; ///< slot
    std::vector<Body> bodies;
};

/// What a peer has of ours: everything but open cones and planes, which it does without.
inline constexpr unsigned peer_primitives = bounded_primitives & ~only(PrimitiveKind::open_cone);

struct PeerMode {
    const char* isa;
    bool robust;
    Query query;
};

// In the module that links Embree.
/// Its version. Throws Error (isa) where it does not run on that instruction set.
extern "C" const char* lanecast_open_embree(const char* isa);
/// Builds its tree, with default quality, and traces: in packets if the rays are coherent and more than one, else one by one.
extern "C" void lanecast_ask_embree(const PeerScene& scene, const RayStream& rays, const PeerMode& mode);

struct Contender {
    std::string name; ///< "Embree 3.13.5 robust"
    const KernelTable* kernels;
};

/// Embree in its default and its robust mode; one instruction set per run of the program. Throws Error (isa) where this build or
/// the CPU lacks it.
[[nodiscard]] std::vector<Contender> embree_contenders(const std::string& isa);

/// The cases that make sense for a peer, over what it has.
[[nodiscard]] const std::vector<Case>& peer_cases();

} // namespace lanecast::selftest
