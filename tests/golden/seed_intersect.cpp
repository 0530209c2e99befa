#include "golden/seed_intersect.hpp"

#include <cmath>
#include <optional>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace lanecast::test {
namespace {

template <class Real>
struct Interval {
    Real near, far;
};

/// a t^2 + 2 b t + c = 0, as textbooks solve it.
template <class Real>
std::optional<Interval<Real>> roots(Real a, Real b, Real c) {
    const Real disc = b * b - a * c;
    if (!(disc >= 0) || a == 0) return std::nullopt;
    const Real root = std::sqrt(disc);
    return Interval<Real>{(-b - root) / a, (-b + root) / a};
}

template <class Real>
class Search {
public:
    Search(const SeedScene<Real>& scene, const SeedFaults& faults, const SeedRay<Real>& ray)
        : scene_(scene), faults_(faults), ray_(ray), inv_dir_(Real(1) / ray.dir) {}

    SeedHit<Real> closest() {
        if (!scene_.nodes.empty()) visit(0);
        for (const int plane : scene_.planes) meet(plane);
        return best_;
    }

private:
    void visit(int index) {
        const SeedNode<Real>& node = scene_.nodes[static_cast<std::size_t>(index)];
        Real near = -std::numeric_limits<Real>::infinity(), far = std::numeric_limits<Real>::infinity();
        for (int axis = 0; axis < 3; ++axis) {
            Real t0 = (node.box.lo[axis] - ray_.org[axis]) * inv_dir_[axis];
            Real t1 = (node.box.hi[axis] - ray_.org[axis]) * inv_dir_[axis];
            if (t0 > t1) std::swap(t0, t1);
            if (t0 > near) near = t0; // as written, NaN leaves the axis out
            if (t1 < far) far = t1;
        }
        if (far < near || far < ray_.tmin) return;
        const Real entry = faults_.entry_at_exit && near < ray_.tmin ? far : near;
        if (entry > best_.t) return;
        if (node.body >= 0) return meet(node.body);
        visit(node.left);
        visit(node.right);
    }

    void meet(int index) {
        const Body<Real>& body = scene_.bodies[static_cast<std::size_t>(index)];
        const bool own = index == ray_.source;
        const bool flat = body.kind == BodyKind::plane || body.kind == BodyKind::triangle;
        if (own && (flat || !ray_.inward)) return;
        far_only_ = own;
        index_ = index;
        if (body.kind == BodyKind::plane) return meet_plane(body);
        const Vec<Real> org(body.object_from_world * glm::vec<4, Real>(ray_.org, Real(1)));
        const Vec<Real> dir(body.object_from_world * glm::vec<4, Real>(ray_.dir, Real(0)));
        if (body.kind == BodyKind::triangle) return meet_triangle(body, org, dir);
        if (body.kind == BodyKind::sphere) return meet_sphere(body, org, dir);
        if (faults_.cylinder_caps) return meet_cylinder_as_seed(body, org, dir);
        meet_cylinder(body, org, dir);
    }

    [[nodiscard]] bool in_range(Real t) const { return t > ray_.tmin && t < best_.t; }

    void accept(const Body<Real>& body, Real t, const Vec<Real>& p_object, const Vec<Real>& n_object) {
        const Vec<Real> by_m(body.world_from_object * glm::vec<4, Real>(n_object, Real(0)));
        const Vec<Real> by_inverse(glm::transpose(body.object_from_world) * glm::vec<4, Real>(n_object, Real(0)));
        const bool keeps_length = body.kind == BodyKind::triangle || (body.kind == BodyKind::cylinder && n_object.y != 0);
        best_.t = t;
        best_.body = index_;
        best_.point = Vec<Real>(body.world_from_object * glm::vec<4, Real>(p_object, Real(1)));
        best_.normal = !faults_.normals_by_m ? glm::normalize(by_inverse) : keeps_length ? by_m : glm::normalize(by_m);
    }

    void meet_plane(const Body<Real>& body) {
        const Real approach = glm::dot(body.normal, ray_.dir);
        if (approach == 0) return;
        const Real t = glm::dot(body.normal, body.position - ray_.org) / approach;
        if (!in_range(t)) return;
        best_ = {t, index_, ray_.org + t * ray_.dir, body.normal};
    }

    void meet_triangle(const Body<Real>& body, const Vec<Real>& org, const Vec<Real>& dir) {
        const auto& [a, b, c] = body.vertices;
        const Vec<Real>& n = body.normal;
        const Real approach = glm::dot(n, dir);
        if (approach == 0) return;
        const Real t = glm::dot(n, a - org) / approach;
        if (!in_range(t)) return;
        const Vec<Real> p = org + t * dir;
        const Real sides[3] = {glm::dot(glm::cross(b - a, p - a), n), glm::dot(glm::cross(c - b, p - b), n),
                               glm::dot(glm::cross(a - c, p - c), n)};
        for (const Real side : sides)
            if (faults_.strict_inside ? !(side > 0) : !(side >= 0)) return;
        accept(body, t, p, n);
    }

    void meet_sphere(const Body<Real>& body, const Vec<Real>& org, const Vec<Real>& dir) {
        const auto t = roots(glm::dot(dir, dir), glm::dot(dir, org), glm::dot(org, org) - body.radius * body.radius);
        if (!t) return;
        const Real nearest = far_only_ || !(t->near > ray_.tmin) ? t->far : t->near;
        if (!in_range(nearest)) return;
        const Vec<Real> p = org + nearest * dir;
        accept(body, nearest, p, p / body.radius);
    }

    std::optional<Interval<Real>> side_crossings(const Body<Real>& body, const Vec<Real>& org, const Vec<Real>& dir) {
        return roots(dir.x * dir.x + dir.z * dir.z, dir.x * org.x + dir.z * org.z,
                     org.x * org.x + org.z * org.z - body.radius * body.radius);
    }

    void accept_side(const Body<Real>& body, Real t, const Vec<Real>& org, const Vec<Real>& dir) {
        const Vec<Real> p = org + t * dir;
        accept(body, t, p, Vec<Real>(p.x, 0, p.z) / body.radius);
    }

    /// The stretch inside the infinite cylinder met with the stretch between the caps.
    void meet_cylinder(const Body<Real>& body, const Vec<Real>& org, const Vec<Real>& dir) {
        constexpr Real infinity = std::numeric_limits<Real>::infinity();
        const Real half = body.height / 2;
        Interval<Real> side{-infinity, infinity}, caps{-infinity, infinity};
        if (const auto crossings = side_crossings(body, org, dir))
            side = *crossings;
        else if (dir.x * dir.x + dir.z * dir.z > 0 || org.x * org.x + org.z * org.z > body.radius * body.radius)
            return;
        if (dir.y != 0) {
            caps = {(-half - org.y) / dir.y, (half - org.y) / dir.y};
            if (caps.near > caps.far) std::swap(caps.near, caps.far);
        } else if (std::abs(org.y) > half) {
            return;
        }
        const Real near = std::max(side.near, caps.near), far = std::min(side.far, caps.far);
        if (near > far) return;
        const bool leaves = far_only_ || !(near > ray_.tmin);
        const Real t = leaves ? far : near;
        if (!in_range(t)) return;
        const bool on_cap = leaves ? caps.far < side.far : caps.near > side.near;
        if (!on_cap) return accept_side(body, t, org, dir);
        const Vec<Real> p = org + t * dir;
        accept(body, t, p, {0, p.y > 0 ? 1 : -1, 0});
    }

    /// A point of the side between the caps first; the caps only where there was one, and only nearer ones.
    void meet_cylinder_as_seed(const Body<Real>& body, const Vec<Real>& org, const Vec<Real>& dir) {
        const Real half = body.height / 2;
        auto side = side_crossings(body, org, dir);
        if (!side || (side->near < ray_.tmin && side->far < ray_.tmin)) return;
        if (side->near < ray_.tmin || far_only_) side->near = side->far;
        const auto between = [&](Real t) { return std::abs(org.y + t * dir.y) < half; };
        if (!between(side->near)) side->near = side->far;
        if (!between(side->near)) return;
        if (in_range(side->near)) accept_side(body, side->near, org, dir);
        for (const Real y : {half, -half}) {
            const Real t = (y - org.y) / dir.y;
            const Vec<Real> p = org + t * dir;
            if (t < side->near && in_range(t) && std::hypot(p.x, p.z) <= body.radius) accept(body, t, p, {0, y > 0 ? 1 : -1, 0});
        }
    }

    const SeedScene<Real>& scene_;
    const SeedFaults& faults_;
    const SeedRay<Real>& ray_;
    Vec<Real> inv_dir_;
    SeedHit<Real> best_{};
    int index_ = -1;        ///< the body being met
    bool far_only_ = false; ///< it is the one the ray leaves from, into its inside
};

} // namespace

template <class Real>
SeedHit<Real> closest_hit(const SeedScene<Real>& scene, const SeedFaults& faults, const SeedRay<Real>& ray) {
    return Search<Real>(scene, faults, ray).closest();
}

template SeedHit<float> closest_hit<float>(const SeedScene<float>&, const SeedFaults&, const SeedRay<float>&);
template SeedHit<double> closest_hit<double>(const SeedScene<double>&, const SeedFaults&, const SeedRay<double>&);

} // namespace lanecast::test
