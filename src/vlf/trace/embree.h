#pragma once
// The ray queries of Embree 3 (Debian 12) and Embree 4 (Ubuntu 24.04) under one signature. The
// older one is taken where both are installed, as in cmake/VlfDependencies.cmake.

#if __has_include(<embree3/rtcore.h>)

#include <embree3/rtcore.h>

namespace vlf::embree {

inline RTCIntersectContext makeContext(RTCIntersectContextFlags flags) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = flags;
    return context;
}

inline void intersect(RTCScene scene, RTCRayHit& query) {
    RTCIntersectContext context = makeContext(RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT);
    rtcIntersect1(scene, &context, &query);
}

inline void intersectCoherent(const int* valid, RTCScene scene, RTCRayHit8& packet) {
    RTCIntersectContext context = makeContext(RTC_INTERSECT_CONTEXT_FLAG_COHERENT);
    rtcIntersect8(valid, scene, &context, &packet);
}

inline void occluded(RTCScene scene, RTCRay& query) {
    RTCIntersectContext context = makeContext(RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT);
    rtcOccluded1(scene, &context, &query);
}

inline void occluded(const int* valid, RTCScene scene, RTCRay8& packet) {
    RTCIntersectContext context = makeContext(RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT);
    rtcOccluded8(valid, scene, &context, &packet);
}

}  // namespace vlf::embree

#else

#include <embree4/rtcore.h>

namespace vlf::embree {

inline void intersect(RTCScene scene, RTCRayHit& query) {
    rtcIntersect1(scene, &query);
}

inline void intersectCoherent(const int* valid, RTCScene scene, RTCRayHit8& packet) {
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    rtcIntersect8(valid, scene, &packet, &arguments);
}

inline void occluded(RTCScene scene, RTCRay& query) {
    rtcOccluded1(scene, &query);
}

inline void occluded(const int* valid, RTCScene scene, RTCRay8& packet) {
    rtcOccluded8(valid, scene, &packet);
}

}  // namespace vlf::embree

#endif
