#pragma once
// The material library of an OBJ file: Ka, Kd, Ks and Ns; everything else is skipped.

#include "scene/description.hpp"

#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace lanecast {

struct MaterialLibrary {
    std::vector<Material> materials;                      ///< [0] is the object's own
    std::unordered_map<std::string, std::uint32_t> index; ///< by name, into `materials`
};

/// Adds the materials of an MTL text; each starts as materials[0]. Throws Error(asset) with line and column.
void read_mtl(std::string_view text, const std::string& name, MaterialLibrary& library);

} // namespace lanecast
