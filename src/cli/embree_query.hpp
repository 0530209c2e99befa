#pragma once
// Asking Embree, 3 or 4, for rays one at a time or in packets. Included by the module that links it alone.

#if LANECAST_EMBREE_MAJOR == 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <cstddef>

namespace lanecast {

template <int width>
struct Packet;
template <>
struct Packet<1> {
    using Rays = RTCRay;
    using RayHits = RTCRayHit;
};
template <>
struct Packet<4> {
    using Rays = RTCRay4;
    using RayHits = RTCRayHit4;
};
template <>
struct Packet<8> {
    using Rays = RTCRay8;
    using RayHits = RTCRayHit8;
};
template <>
struct Packet<16> {
    using Rays = RTCRay16;
    using RayHits = RTCRayHit16;
};

/// Element `lane` of a packet's array; of a single ray the field itself.
template <class T>
T& lane_of(T& field, std::size_t) {
    return field;
}
template <class T, std::size_t n>
T& lane_of(T (&field)[n], std::size_t lane) {
    return field[lane];
}

#if LANECAST_EMBREE_MAJOR == 4
/// How a query is asked: all rays of a packet go the same way, or not.
struct Asking {
    RTCIntersectArguments intersect;
    RTCOccludedArguments occluded;
    explicit Asking(bool coherent) {
        rtcInitIntersectArguments(&intersect);
        rtcInitOccludedArguments(&occluded);
        intersect.flags = occluded.flags = coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
    }
};
#define LANECAST_CLOSEST(K) rtcIntersect##K(valid, scene, &packet, &query.intersect)
#define LANECAST_ANY(K) rtcOccluded##K(valid, scene, &packet, &query.occluded)
#define LANECAST_CLOSEST1 rtcIntersect1(scene, &packet, &query.intersect)
#define LANECAST_ANY1 rtcOccluded1(scene, &packet, &query.occluded)
#else
struct Asking {
    RTCIntersectContext context;
    explicit Asking(bool coherent) {
        rtcInitIntersectContext(&context);
        context.flags = coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    }
};
#define LANECAST_CLOSEST(K) rtcIntersect##K(valid, scene, &query.context, &packet)
#define LANECAST_ANY(K) rtcOccluded##K(valid, scene, &query.context, &packet)
#define LANECAST_CLOSEST1 rtcIntersect1(scene, &query.context, &packet)
#define LANECAST_ANY1 rtcOccluded1(scene, &query.context, &packet)
#endif

template <int width>
void trace_packet(RTCScene scene, Asking& query, typename Packet<width>::RayHits& packet, const int* valid) {
    if constexpr (width == 1) LANECAST_CLOSEST1;
    if constexpr (width == 4) LANECAST_CLOSEST(4);
    if constexpr (width == 8) LANECAST_CLOSEST(8);
    if constexpr (width == 16) LANECAST_CLOSEST(16);
    static_cast<void>(valid);
}
template <int width>
void trace_packet(RTCScene scene, Asking& query, typename Packet<width>::Rays& packet, const int* valid) {
    if constexpr (width == 1) LANECAST_ANY1;
    if constexpr (width == 4) LANECAST_ANY(4);
    if constexpr (width == 8) LANECAST_ANY(8);
    if constexpr (width == 16) LANECAST_ANY(16);
    static_cast<void>(valid);
}

#undef LANECAST_CLOSEST
#undef LANECAST_ANY
#undef LANECAST_CLOSEST1
#undef LANECAST_ANY1

} // namespace lanecast
