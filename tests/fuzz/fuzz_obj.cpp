// Any bytes as an OBJ file, and as a material library: a mesh whose indices are in range, or an Error.

#include "scene/error.hpp"
#include "scene/mesh_file.hpp"
#include "scene/read_mtl.hpp"

#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    try {
        lanecast::MeshWarnings warnings;
        const lanecast::Mesh mesh = lanecast::read_obj(text, "fuzz.obj", "/nonexistent", {}, warnings);
        for (const auto& triangle : mesh.triangles)
            for (const std::uint32_t index : triangle)
                if (index >= mesh.positions.size()) std::abort();
    } catch (const lanecast::Error&) {
    }
    try {
        lanecast::MaterialLibrary library{{lanecast::Material{}}, {}};
        lanecast::read_mtl(text, "fuzz.mtl", library);
    } catch (const lanecast::Error&) {
    }
    return 0;
}
