#include "scene/mesh_file.hpp"

#include "scene/text_tools.hpp"

namespace lanecast {

MeshFormat mesh_format(const std::filesystem::path& file) {
    const std::string extension = lower_case(file.extension().string());
    if (extension == ".obj") return MeshFormat::obj;
    return extension == ".ply" ? MeshFormat::ply : MeshFormat::unknown;
}

} // namespace lanecast
