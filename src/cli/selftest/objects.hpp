#pragma once
// Not inlined: g++ 12 warns of uninitialised strings where a variant's alternative is made or replaced in sight.

#include "scene/description.hpp"

namespace lanecast::selftest {

[[nodiscard]] Object make_object(const Shape& shape, const std::vector<Transformation>& transformations = {},
                                 const Material& material = {});
void add_object(SceneDescription& scene, const Shape& shape, const std::vector<Transformation>& transformations = {},
                const Material& material = {});

} // namespace lanecast::selftest
