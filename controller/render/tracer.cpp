// SPDX-License-Identifier: Apache-2.0
#include <embree3/rtcore.h>

#include <cmath>
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
