#include "scene/triangle_geometry.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace lanecast {
namespace {

/// Sum of six doubles as if in infinite precision, rounded a few times at the end: zero exactly where the sum is.
/// Shewchuk 1997, grow-expansion: the parts stay exact and do not overlap.
double exact_sum(const std::array<double, 6>& terms) {
    std::array<double, 6> part{};
    for (std::size_t count = 0; count < terms.size(); ++count) {
        double carry = terms[count];
        for (std::size_t i = 0; i < count; ++i) { // two-sum
            const double sum = carry + part[i], other = sum - carry;
            part[i] = (carry - (sum - other)) + (part[i] - other);
            carry = sum;
        }
        part[count] = carry;
    }
    double sum = 0;
    for (const double p : part) sum += p; // smallest first
    return sum;
}

/// Twice the signed area of the projection to the axes i, j. Products of two floats are exact in double.
double exact_area(const float a[3], const float b[3], const float c[3], int i, int j) {
    const double ai = a[i], aj = a[j], bi = b[i], bj = b[j], ci = c[i], cj = c[j];
    return exact_sum({bi * cj, -(bi * aj), -(ai * cj), -(bj * ci), bj * ai, aj * ci});
}

double largest(const double v[3]) { return std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])}); }

} // namespace

void triangle_cross(const float a[3], const float b[3], const float c[3], double cross[3]) {
    double ab[3], bc[3], ca[3];
    double length2[3] = {};
    for (int axis = 0; axis < 3; ++axis) {
        ab[axis] = double{b[axis]} - double{a[axis]};
        bc[axis] = double{c[axis]} - double{b[axis]};
        ca[axis] = double{a[axis]} - double{c[axis]};
        length2[0] += ab[axis] * ab[axis];
        length2[1] += bc[axis] * bc[axis];
        length2[2] += ca[axis] * ca[axis];
    }
    // ab x bc = bc x ca = ca x ab; the two shortest edges cancel least.
    const double* u = ab;
    const double* v = bc;
    double shortest2 = length2[0] * length2[1];
    if (length2[0] >= length2[1] && length2[0] >= length2[2])
        u = bc, v = ca, shortest2 = length2[1] * length2[2];
    else if (length2[1] >= length2[2])
        u = ca, v = ab, shortest2 = length2[2] * length2[0];
    cross[0] = u[1] * v[2] - u[2] * v[1];
    cross[1] = u[2] * v[0] - u[0] * v[2];
    cross[2] = u[0] * v[1] - u[1] * v[0];

    // Each component is within 2^-50 |u| |v|, unless the edges themselves were rounded or products underflowed.
    const double size = largest(cross);
    if (size * size > 0x1p-56 * shortest2 && size > 0x1p-400) return;
    cross[0] = exact_area(a, b, c, 1, 2);
    cross[1] = exact_area(a, b, c, 2, 0);
    cross[2] = exact_area(a, b, c, 0, 1);
}

bool is_degenerate(const float a[3], const float b[3], const float c[3]) {
    double cross[3];
    triangle_cross(a, b, c, cross);
    return cross[0] == 0 && cross[1] == 0 && cross[2] == 0;
}

void triangle_normal(const float a[3], const float b[3], const float c[3], float normal[3]) {
    double cross[3];
    triangle_cross(a, b, c, cross);
    double length2 = cross[0] * cross[0] + cross[1] * cross[1] + cross[2] * cross[2];
    if (!(length2 > 0x1p-900)) { // the squares underflow: exact products of floats reach down to 2^-298, sums as well
        const double scale = 1 / largest(cross);
        for (int axis = 0; axis < 3; ++axis) cross[axis] *= scale;
        length2 = cross[0] * cross[0] + cross[1] * cross[1] + cross[2] * cross[2];
    }
    const double inverse_length = 1 / std::sqrt(length2);
    for (int axis = 0; axis < 3; ++axis) normal[axis] = static_cast<float>(cross[axis] * inverse_length) + 0.0f; // no -0
}

} // namespace lanecast
