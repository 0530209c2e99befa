#pragma once
// The parts of a scene file, one reader each; `load_scene` lists them in order.

#include "scene/description.hpp"
#include "scene/scene_reader.hpp"

namespace lanecast {

[[nodiscard]] Camera load_camera(SceneReader& reader, NodeId node);
[[nodiscard]] RenderSettings load_render_settings(SceneReader& reader, NodeId node);
[[nodiscard]] Material load_material(SceneReader& reader, NodeId node);
[[nodiscard]] std::vector<Object> load_objects(SceneReader& reader, NodeId list);
[[nodiscard]] std::vector<Light> load_lights(SceneReader& reader, NodeId list);

/// Fails where the transformations cannot be undone.
[[nodiscard]] std::vector<Transformation> load_transformations(SceneReader& reader, NodeId list);

} // namespace lanecast
