#include "golden/seed_scene.hpp"

#include <algorithm>
#include <cmath>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace lanecast::test {
namespace {

glm::dmat4 matrix_of(const Transformation& transformation) {
    const glm::dmat4 identity(1);
    if (const auto* rotation = std::get_if<Rotation>(&transformation))
        return glm::rotate(identity, glm::radians(rotation->degrees), rotation->axis);
    if (const auto* scale = std::get_if<Scale>(&transformation)) return glm::scale(identity, scale->scale);
    return glm::translate(identity, std::get<Translation>(transformation).translate);
}

template <class Real>
class Builder {
public:
    Builder(SeedScene<Real>& scene, const SeedFaults& faults) : scene_(scene), faults_(faults) {}

    void add(const Object& object) {
        glm::dmat4 m(1);
        for (const Transformation& transformation : object.transformations) m = matrix_of(transformation) * m;
        Body<Real> body;
        body.material = &object.material;
        if (const auto* sphere = std::get_if<Sphere>(&object.shape)) {
            body.radius = static_cast<Real>(sphere->radius);
            add_bounded(body, glm::translate(m, sphere->position), BodyKind::sphere);
        } else if (const auto* cylinder = std::get_if<Cylinder>(&object.shape)) {
            body.radius = static_cast<Real>(cylinder->radius);
            body.height = static_cast<Real>(cylinder->height);
            add_bounded(body, m, BodyKind::cylinder);
        } else if (const auto* plane = std::get_if<Plane>(&object.shape)) {
            body.kind = BodyKind::plane;
            body.position = Vec<Real>(plane->position);
            body.normal = Vec<Real>(faults_.plane_normal_length ? plane->normal : glm::normalize(plane->normal));
            scene_.planes.push_back(static_cast<int>(scene_.bodies.size()));
            scene_.bodies.push_back(body);
        } else {
            const Mesh& mesh = std::get<Mesh>(object.shape);
            for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
                for (std::size_t k = 0; k < 3; ++k) body.vertices[k] = Vec<Real>(mesh.positions[mesh.triangles[i][k]]);
                const auto& [a, b, c] = body.vertices;
                body.normal = glm::normalize(glm::cross(b - a, c - b));
                if (!mesh.materials.empty()) body.material = &mesh.materials[mesh.triangle_material[i]];
                add_bounded(body, m, BodyKind::triangle);
            }
        }
    }

    void build_tree() {
        if (!bounded_.empty()) build_node(bounded_, 0);
    }

private:
    void add_bounded(Body<Real> body, const glm::dmat4& m, BodyKind kind) {
        body.kind = kind;
        body.world_from_object = Matrix<Real>(m);
        body.object_from_world = glm::inverse(body.world_from_object);
        bounded_.push_back(static_cast<int>(scene_.bodies.size()));
        scene_.bodies.push_back(body);
    }

    static Vec<Real> to_world(const Body<Real>& body, const Vec<Real>& p) {
        return Vec<Real>(body.world_from_object * glm::vec<4, Real>(p, Real(1)));
    }

    static Vec<Real> centre(const Body<Real>& body) {
        if (body.kind != BodyKind::triangle) return to_world(body, Vec<Real>(0));
        return to_world(body, (body.vertices[0] + body.vertices[1] + body.vertices[2]) / Real(3));
    }

    static void include(SeedBox<Real>& box, const Vec<Real>& p) {
        for (int axis = 0; axis < 3; ++axis) {
            if (p[axis] < box.lo[axis]) box.lo[axis] = p[axis]; // as written, a NaN is left out
            if (p[axis] > box.hi[axis]) box.hi[axis] = p[axis];
        }
    }

    /// Extents by the support function: sqrt of the sum of squares of the row, for the axes in which the body is round.
    void include_quadric(SeedBox<Real>& box, const Body<Real>& body) const {
        const Matrix<Real>& m = body.world_from_object;
        const bool cylinder = body.kind == BodyKind::cylinder;
        Vec<Real> extent;
        for (int row = 0; row < 3; ++row) {
            const Real round = std::hypot(m[0][row], m[2][row], cylinder ? Real(0) : m[1][row]);
            extent[row] = body.radius * round + (cylinder ? body.height / 2 * std::abs(m[1][row]) : Real(0));
        }
        include(box, centre(body) + extent);
        include(box, centre(body) - extent);
    }

    SeedBox<Real> box_of(const Body<Real>& body) const {
        SeedBox<Real> box;
        if (body.kind == BodyKind::triangle) {
            for (const Vec<Real>& vertex : body.vertices) {
                include(box, to_world(body, vertex));
                if (faults_.untransformed_box) include(box, vertex);
            }
        } else if (body.kind == BodyKind::sphere && faults_.sphere_box_corners) {
            include(box, to_world(body, Vec<Real>(body.radius)));
            include(box, to_world(body, Vec<Real>(-body.radius)));
        } else if (body.kind == BodyKind::cylinder && faults_.cylinder_box_unscaled) {
            const Vec<Real> top = to_world(body, {0, body.height / 2, 0}), bottom = to_world(body, {0, -body.height / 2, 0});
            const Vec<Real> axis = bottom - top;
            const Vec<Real> extent = body.radius * glm::sqrt(Real(1) - axis * axis / glm::dot(axis, axis)); // of a disc
            for (const Vec<Real>& end : {top, bottom}) include(box, end + extent), include(box, end - extent);
        } else {
            include_quadric(box, body);
        }
        if (faults_.entry_at_exit) return box; // the seed's boxes are not padded: a flat one holds no origin
        const Vec<Real> pad =
            Real(64) * std::numeric_limits<Real>::epsilon() * (Real(1) + glm::max(glm::abs(box.lo), glm::abs(box.hi)));
        return {box.lo - pad, box.hi + pad};
    }

    /// Medians along x, y, z in turn, down to single bodies.
    int build_node(std::vector<int> bodies, int axis) {
        const int index = static_cast<int>(scene_.nodes.size());
        SeedNode<Real> node;
        for (const int body : bodies) {
            const SeedBox<Real> box = box_of(scene_.bodies[static_cast<std::size_t>(body)]);
            include(node.box, box.lo);
            include(node.box, box.hi);
        }
        scene_.nodes.push_back(node);
        if (bodies.size() == 1) {
            scene_.nodes.back().body = bodies[0];
            return index;
        }
        std::stable_sort(bodies.begin(), bodies.end(), [&](int a, int b) {
            return centre(scene_.bodies[static_cast<std::size_t>(a)])[axis] <
                   centre(scene_.bodies[static_cast<std::size_t>(b)])[axis];
        });
        const auto middle = bodies.begin() + static_cast<std::ptrdiff_t>(bodies.size() / 2);
        const int left = build_node({bodies.begin(), middle}, (axis + 1) % 3);
        const int right = build_node({middle, bodies.end()}, (axis + 1) % 3);
        scene_.nodes[static_cast<std::size_t>(index)].left = left;
        scene_.nodes[static_cast<std::size_t>(index)].right = right;
        return index;
    }

    SeedScene<Real>& scene_;
    const SeedFaults& faults_;
    std::vector<int> bounded_;
};

} // namespace

template <class Real>
SeedScene<Real> make_seed_scene(const SceneDescription& description, const SeedFaults& faults) {
    SeedScene<Real> scene;
    Builder<Real> builder(scene, faults);
    for (const Object& object : description.objects) builder.add(object);
    builder.build_tree();
    return scene;
}

template SeedScene<float> make_seed_scene<float>(const SceneDescription&, const SeedFaults&);
template SeedScene<double> make_seed_scene<double>(const SceneDescription&, const SeedFaults&);

} // namespace lanecast::test
