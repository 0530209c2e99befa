// Any bytes as a PLY file: a mesh whose indices are in range, or an Error.

#include "scene/error.hpp"
#include "scene/mesh_file.hpp"

#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    try {
        const lanecast::Mesh mesh = lanecast::read_ply(bytes, "fuzz.ply");
        for (const auto& triangle : mesh.triangles)
            for (const std::uint32_t index : triangle)
                if (index >= mesh.positions.size()) std::abort();
    } catch (const lanecast::Error&) {
    }
    return 0;
}
