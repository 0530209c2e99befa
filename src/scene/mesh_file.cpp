#include "scene/mesh_file.hpp"

#include <algorithm>

namespace lanecast {

MeshFormat mesh_format(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    if (extension == ".obj") return MeshFormat::obj;
    return extension == ".ply" ? MeshFormat::ply : MeshFormat::unknown;
}

} // namespace lanecast
