#include "scene/mesh_file.hpp"

#include "scene/error.hpp"
#include "scene/read_file.hpp"
#include "scene/text_tools.hpp"

#include <algorithm>

namespace lanecast {

Mesh read_mesh(const std::filesystem::path& file, const Material& base, std::vector<std::string>& warnings) {
    const std::string name = printable(file.string(), 4096);
    std::string extension = file.extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    if (extension != ".obj" && extension != ".ply")
        throw Error(ExitCode::asset, name + ": error: a mesh file must end in .obj or .ply");
    const FileBytes bytes = read_file(file);
    if (!bytes.fault.empty()) throw Error(ExitCode::asset, name + ": error: cannot read the mesh: " + bytes.fault);
    return extension == ".obj" ? read_obj(bytes.view(), name, file.parent_path(), base, warnings) : read_ply(bytes.view(), name);
}

} // namespace lanecast
