// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <embree3/rtcore.h>
#include <stdexcept>

#include "controller/render/view.h"

namespace chiaro::render {

struct Tracer::State {
  std::shared_ptr<const twin::Geometry> geometry;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  ~State() {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }
};

namespace {

/// Embree borrows our buffers: nothing is copied.
void attach(RTCDevice device, RTCScene scene, const twin::Mesh& mesh, unsigned id) {
  RTCGeometry triangles = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetSharedGeometryBuffer(triangles, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                             mesh.positions.data(), 0, 3 * sizeof(float),
                             mesh.positions.size() / 3);
  rtcSetSharedGeometryBuffer(triangles, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                             mesh.indices.data(), 0, 3 * sizeof(std::uint32_t), mesh.triangles());
  rtcSetGeometryBuildQuality(triangles, RTC_BUILD_QUALITY_MEDIUM);
  rtcCommitGeometry(triangles);
  rtcAttachGeometryByID(scene, triangles, id);
  rtcReleaseGeometry(triangles);
}

}  // namespace

Tracer::Tracer(std::shared_ptr<const twin::Geometry> geometry) : state_(std::make_unique<State>()) {
  state_->geometry = std::move(geometry);
  state_->device = rtcNewDevice(nullptr);
  if (state_->device == nullptr) throw std::runtime_error("Embree cannot start on this processor");
  state_->scene = rtcNewScene(state_->device);
  // Robust: a ray that grazes an edge must not slip between two triangles.
  rtcSetSceneFlags(state_->scene, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(state_->scene, RTC_BUILD_QUALITY_MEDIUM);
  for (std::size_t i = 0; i < state_->geometry->meshes.size(); ++i)
    attach(state_->device, state_->scene, state_->geometry->meshes[i], static_cast<unsigned>(i));
  rtcCommitScene(state_->scene);
  if (rtcGetDeviceError(state_->device) != RTC_ERROR_NONE)
    throw std::runtime_error("Embree cannot build its tree: is there memory enough?");
}

Tracer::~Tracer() = default;

Tracer::Hit Tracer::closest(core::Vec3 from, core::Vec3 direction, double most) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit ray{};
  ray.ray.org_x = static_cast<float>(from.x);
  ray.ray.org_y = static_cast<float>(from.y);
  ray.ray.org_z = static_cast<float>(from.z);
  ray.ray.dir_x = static_cast<float>(direction.x);
  ray.ray.dir_y = static_cast<float>(direction.y);
  ray.ray.dir_z = static_cast<float>(direction.z);
  ray.ray.tfar = static_cast<float>(most);
  ray.ray.mask = 0xffffffffu;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(state_->scene, &context, &ray);
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  return {true, ray.ray.tfar, ray.hit.u, ray.hit.v, ray.hit.geomID, ray.hit.primID};
}

void Tracer::closest16(core::Vec3 from, const core::Vec3* directions, std::size_t count,
                       Hit* hits) const {
  constexpr std::size_t kPacket = 16;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  alignas(64) int valid[kPacket];
  alignas(64) RTCRayHit16 rays;
  for (std::size_t k = 0; k < kPacket; ++k) {
    const core::Vec3 d = directions[std::min(k, count - 1)];
    valid[k] = k < count ? -1 : 0;
    rays.ray.org_x[k] = static_cast<float>(from.x);
    rays.ray.org_y[k] = static_cast<float>(from.y);
    rays.ray.org_z[k] = static_cast<float>(from.z);
    rays.ray.dir_x[k] = static_cast<float>(d.x);
    rays.ray.dir_y[k] = static_cast<float>(d.y);
    rays.ray.dir_z[k] = static_cast<float>(d.z);
    rays.ray.tnear[k] = 0, rays.ray.tfar[k] = 1e30f, rays.ray.time[k] = 0;
    rays.ray.mask[k] = 0xffffffffu, rays.ray.id[k] = 0, rays.ray.flags[k] = 0;
    rays.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
    rays.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
  }
  rtcIntersect16(valid, state_->scene, &context, &rays);
  for (std::size_t k = 0; k < count; ++k)
    hits[k] = rays.hit.geomID[k] == RTC_INVALID_GEOMETRY_ID
                  ? Hit{}
                  : Hit{true,          rays.ray.tfar[k],   rays.hit.u[k],
                        rays.hit.v[k], rays.hit.geomID[k], rays.hit.primID[k]};
}

bool Tracer::blocked(core::Vec3 from, core::Vec3 to) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay ray{};
  const core::Vec3 along = to - from;
  ray.org_x = static_cast<float>(from.x);
  ray.org_y = static_cast<float>(from.y);
  ray.org_z = static_cast<float>(from.z);
  ray.dir_x = static_cast<float>(along.x);
  ray.dir_y = static_cast<float>(along.y);
  ray.dir_z = static_cast<float>(along.z);
  ray.tfar = 1;
  ray.mask = 0xffffffffu;
  rtcOccluded1(state_->scene, &context, &ray);
  return ray.tfar < 0;
}

const twin::Geometry& Tracer::geometry() const { return *state_->geometry; }
void* Tracer::embree_scene() const { return state_->scene; }

}  // namespace chiaro::render
