#pragma once
// Whitted's model a second time, as plainly as it can be written: scalar, double, recursive, from the description, with its own
// matrices and formulae, every primitive for every ray. Knows nothing of slots, packets, trees or normalised lengths.

#include "scene/description.hpp"

#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace lanecast::test {

class WhittedOracle {
public:
    WhittedOracle(const SceneDescription& scene, const RenderSettings& settings);

    /// The colour of the image point (x, y), in pixels, y down.
    [[nodiscard]] glm::dvec3 color_at(double x, double y, int width, int height) const;

private:
    struct Body {
        const Object* object;
        glm::dmat4 world_from_object, object_from_world;
    };
    struct Hit {
        double t = 0;
        glm::dvec3 outward{0}; ///< unit geometric normal
        const Material* material = nullptr;
        std::size_t body = 0;
    };

    void hits_of(const Body& body, std::size_t index, const glm::dvec3& o, const glm::dvec3& d, std::vector<Hit>& hits) const;
    [[nodiscard]] std::vector<Hit> all_hits(const glm::dvec3& o, const glm::dvec3& d, double tmin, double tmax) const;
    [[nodiscard]] glm::dvec3 trace(const glm::dvec3& o, const glm::dvec3& d, double tmin, int level) const;
    [[nodiscard]] glm::dvec3 direct(const glm::dvec3& p, const glm::dvec3& n, const glm::dvec3& view, const Material& m) const;
    [[nodiscard]] glm::dvec3 visibility(const glm::dvec3& p, const glm::dvec3& n, const glm::dvec3& to, double tmax) const;

    SceneDescription scene_;
    RenderSettings settings_;
    std::vector<Body> bodies_;
    double epsilon_; ///< a length no feature of the scene has
};

} // namespace lanecast::test
