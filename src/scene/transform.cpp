#include "scene/transform.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace lanecast {
namespace {

double largest(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }
double largest(const glm::dmat3& m) { return std::max({largest(m[0]), largest(m[1]), largest(m[2])}); }

/// Exact power of two near `x` > 0, to take a matrix near 1 without rounding.
double power_of_two_near(double x) { return std::ldexp(1.0, std::ilogb(x)); }

/// Sine and cosine, exact at the quarter turns that scenes are full of.
void sin_cos(double degrees, double& sine, double& cosine) {
    const double turn = std::remainder(degrees, 360.0); // exact
    const double quarter = std::nearbyint(turn / 90.0);
    const double rest = (turn - quarter * 90.0) * (std::numbers::pi / 180.0);
    const double s = std::sin(rest), c = std::cos(rest);
    switch (static_cast<int>(quarter) & 3) {
    case 0:
        sine = s, cosine = c;
        break;
    case 1:
        sine = c, cosine = -s;
        break;
    case 2:
        sine = -s, cosine = -c;
        break;
    default:
        sine = -c, cosine = s;
        break;
    }
}

struct Append {
    AffineTransform& so_far;
    void operator()(const Rotation& r) const {
        const glm::dmat3 m = matrix_of(r);
        so_far.linear = m * so_far.linear;
        so_far.translation = m * so_far.translation;
    }
    void operator()(const Scale& s) const {
        for (int column = 0; column < 3; ++column) so_far.linear[column] *= s.scale;
        so_far.translation *= s.scale;
    }
    void operator()(const Translation& t) const { so_far.translation += t.translate; }
};

} // namespace

glm::dmat3 matrix_of(const Rotation& rotation) { // Rodrigues
    const glm::dvec3 a = unit(rotation.axis);
    double s = 0, c = 1;
    sin_cos(rotation.degrees, s, c);
    const double k = 1 - c;
    return glm::dmat3(glm::dvec3(c + k * a.x * a.x, k * a.x * a.y + s * a.z, k * a.x * a.z - s * a.y),
                      glm::dvec3(k * a.x * a.y - s * a.z, c + k * a.y * a.y, k * a.y * a.z + s * a.x),
                      glm::dvec3(k * a.x * a.z + s * a.y, k * a.y * a.z - s * a.x, c + k * a.z * a.z));
}

AffineTransform compose(std::span<const Transformation> transformations) {
    AffineTransform result;
    for (const Transformation& t : transformations) std::visit(Append{result}, t);
    return result;
}

glm::dvec3 apply(const AffineTransform& world_from_object, const glm::dvec3& p_object) {
    return world_from_object.linear * p_object + world_from_object.translation;
}

TransformClass classify(const glm::dmat3& linear) {
    const double size = largest(linear);
    if (!(size > 0) || !std::isfinite(size)) return TransformClass::affine;
    const glm::dmat3 m = linear / power_of_two_near(size);
    const glm::dmat3 gram = glm::transpose(m) * m; // scale^2 times the identity for a similarity
    const double scale2 = (gram[0][0] + gram[1][1] + gram[2][2]) / 3;
    double deviation = 0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) deviation = std::max(deviation, std::abs(gram[i][j] - (i == j ? scale2 : 0.0)));
    return deviation <= 0x1p-32 * scale2 ? TransformClass::similarity : TransformClass::affine;
}

double uniform_scale(const glm::dmat3& linear) {
    const double size = largest(linear);
    if (!(size > 0) || !std::isfinite(size)) return 0;
    const double exact = power_of_two_near(size);
    return exact * std::cbrt(std::abs(glm::determinant(linear / exact)));
}

bool is_mirroring(const glm::dmat3& linear) {
    const double size = largest(linear);
    if (!(size > 0) || !std::isfinite(size)) return false;
    return glm::determinant(linear / power_of_two_near(size)) < 0;
}

glm::dmat3 inverted(const glm::dmat3& linear) {
    const double size = largest(linear);
    const double exact = size > 0 && std::isfinite(size) ? power_of_two_near(size) : 1;
    return glm::inverse(linear / exact) / exact;
}

double condition(const glm::dmat3& linear, const glm::dmat3& inverse) {
    double worst = 0;
    for (int row = 0; row < 3; ++row) {
        double sum = 0;
        for (int column = 0; column < 3; ++column)
            for (int k = 0; k < 3; ++k) sum += std::abs(inverse[k][row]) * std::abs(linear[column][k]);
        worst = std::max(worst, sum);
    }
    return worst;
}

glm::dvec3 unit(const glm::dvec3& v) {
    const double size = largest(v);
    const glm::dvec3 near_one = v / power_of_two_near(size);
    return near_one / std::sqrt(glm::dot(near_one, near_one));
}

bool is_finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
bool is_finite(const glm::dmat3& m) { return is_finite(m[0]) && is_finite(m[1]) && is_finite(m[2]); }

} // namespace lanecast
