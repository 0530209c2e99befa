#include "cli/selftest/oracle.hpp"

#include <algorithm>
#include <cmath>

namespace lanecast::selftest {

Real length(const RealVec& a) { return std::sqrt(dot(a, a)); }

RealCrossing cross_ball(const RealVec& org, const RealVec& dir, Real radius) {
    const Real dd = dot(dir, dir), tc = -dot(org, dir) / dd;
    const Real l = length(org + dir * tc);
    const Real gap = (radius - l) / radius;
    if (gap < 0) return {false, 0, 0, gap, 0};
    const Real half = std::sqrt((radius - l) * (radius + l) / dd);
    const Real far = tc >= 0 ? tc + half : tc - half;
    const Real from_centre = length(org), near = (from_centre - radius) * (from_centre + radius) / (dd * far);
    return {true, std::min(near, far), std::max(near, far), gap, half * std::sqrt(dd) / radius};
}

RealCylinder cross_body(const RealVec& org, const RealVec& dir) {
    constexpr Real infinity = std::numeric_limits<Real>::infinity();
    const RealVec o{org.x, 0, org.z}, d{dir.x, 0, dir.z};
    Real b0 = -infinity, b1 = infinity, gap = 1, body_cosine = 0;
    bool hit = true;
    if (d.x != 0 || d.z != 0) {
        const RealCrossing body = cross_ball(o, d, 1);
        hit = body.hit, gap = body.gap;
        body_cosine = body.cosine * length(d) / length(dir);
        if (hit) b0 = body.t0, b1 = body.t1;
    } else {
        gap = 1 - length(o);
        hit = gap >= 0;
    }
    Real c0 = (-0.5L - org.y) / dir.y, c1 = (0.5L - org.y) / dir.y;
    if (c0 > c1) std::swap(c0, c1);
    if (dir.y == 0) c0 = -infinity, c1 = infinity, hit = hit && std::fabs(org.y) <= 0.5L;
    RealCylinder crossing{};
    crossing.t0 = std::max(b0, c0), crossing.t1 = std::min(b1, c1);
    crossing.hit = hit && crossing.t0 <= crossing.t1;
    crossing.cap = c0 > b0;
    crossing.cosine = crossing.cap ? std::fabs(dir.y) / length(dir) : body_cosine;
    const auto apart = [](Real x, Real y) { return std::isfinite(x) && std::isfinite(y) ? std::fabs(x - y) : infinity; };
    crossing.band = std::min({apart(b0, c0), apart(b0, c1), apart(b1, c0), apart(b1, c1)});
    crossing.gap = gap;
    return crossing;
}

RealTriangle cross_plane_of(const RealVec& a, const RealVec& b, const RealVec& c, const RealVec& org, const RealVec& dir) {
    const RealVec n = cross(b - a, c - a);
    const Real along = dot(n, dir);
    return {dot(n, a - org) / along, std::fabs(along) / (length(n) * length(dir))};
}

RealVec to_object_direction(const AffineRecord& record, const RealVec& v) {
    const float* const m = record.object_from_world;
    const auto row = [&](int i) { return Real(m[i]) * v.x + Real(m[i + 1]) * v.y + Real(m[i + 2]) * v.z; };
    return {row(0), row(3), row(6)};
}

RealVec to_object(const AffineRecord& record, const RealVec& p) {
    const float* const t = record.translation;
    return to_object_direction(record, p - RealVec{Real(t[0]), Real(t[1]), Real(t[2])});
}

} // namespace lanecast::selftest
