// SPDX-License-Identifier: Apache-2.0
/// Embree 3.13 and Embree 4 under one set of names, those of Embree 4 if it has one. GLTFX_EMBREE
/// is the major version.
#pragma once

#if GLTFX_EMBREE < 4
#include <embree3/rtcore.h>

using RTCRayQueryContext = RTCIntersectContext;
inline void rtcInitRayQueryContext(RTCRayQueryContext* context) {
  rtcInitIntersectContext(context);
}
#else
#include <embree4/rtcore.h>
#endif

namespace gltfx::render {

/// The closest hit. Filters find `context`.
inline void find_hit(RTCScene scene, RTCRayQueryContext& context, RTCRayHit& query) {
#if GLTFX_EMBREE < 4
  rtcIntersect1(scene, &context, &query);
#else
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &context;
  rtcIntersect1(scene, &query, &arguments);
#endif
}

/// The closest hits of those rays of a packet whose `valid` is -1, not 0; for rays that are close
/// together.
inline void find_hits(RTCScene scene, RTCRayQueryContext& context, const int* valid,
                      RTCRayHit8& query) {
#if GLTFX_EMBREE < 4
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect8(valid, scene, &context, &query);
#else
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &context;
  arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  rtcIntersect8(valid, scene, &query, &arguments);
#endif
}

/// Any hit, after which `tfar` is below 0.
inline void find_occluder(RTCScene scene, RTCRayQueryContext& context, RTCRay& query) {
#if GLTFX_EMBREE < 4
  rtcOccluded1(scene, &context, &query);
#else
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.context = &context;
  rtcOccluded1(scene, &query, &arguments);
#endif
}

/// The same for those rays of a packet whose `valid` is -1, not 0.
inline void find_occluders(RTCScene scene, RTCRayQueryContext& context, const int* valid,
                           RTCRay4& query) {
#if GLTFX_EMBREE < 4
  rtcOccluded4(valid, scene, &context, &query);
#else
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.context = &context;
  rtcOccluded4(valid, scene, &query, &arguments);
#endif
}

}  // namespace gltfx::render
