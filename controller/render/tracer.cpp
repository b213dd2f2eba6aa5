// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <embree3/rtcore.h>
#include <stdexcept>
#include <vector>

#include "controller/render/view.h"

namespace chiaro::render {

/// One tree per mesh, shared by the scenes that place them.
struct MovingTracer::Trees {
  std::shared_ptr<const twin::Geometry> geometry;
  RTCDevice device = nullptr;
  std::vector<RTCScene> meshes;
  ~Trees() {
    for (const RTCScene mesh : meshes) rtcReleaseScene(mesh);
    if (device != nullptr) rtcReleaseDevice(device);
  }
};

struct Tracer::State {
  std::shared_ptr<const twin::Geometry> geometry;
  std::shared_ptr<const MovingTracer::Trees> trees;  ///< null where nothing moves
  Motion motion;
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

RTCDevice new_device() {
  const RTCDevice device = rtcNewDevice(nullptr);
  if (device == nullptr) throw std::runtime_error("Embree cannot start on this processor");
  return device;
}

/// Robust: a ray that grazes an edge must not slip between two triangles.
RTCScene new_scene(RTCDevice device) {
  const RTCScene scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
  return scene;
}

void require_built(RTCDevice device) {
  if (rtcGetDeviceError(device) != RTC_ERROR_NONE)
    throw std::runtime_error("Embree cannot build its tree: is there memory enough?");
}

void place(RTCDevice device, RTCScene scene, RTCScene mesh, const Motion& motion, unsigned id) {
  RTCGeometry instance = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(instance, mesh);
  std::array<float, 12> columns;
  const core::Vec3 each[] = {motion.x, motion.y, motion.z, motion.by};
  for (std::size_t c = 0; c < 4; ++c) {
    columns[3 * c] = static_cast<float>(each[c].x);
    columns[3 * c + 1] = static_cast<float>(each[c].y);
    columns[3 * c + 2] = static_cast<float>(each[c].z);
  }
  rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns.data());
  // A mark for shadow.cpp: whoever traces placed meshes must do it ray by ray. Embree 3.13
  // sometimes never comes back from a packet that meets instances.
  rtcSetGeometryUserData(instance, mesh);
  rtcCommitGeometry(instance);
  rtcAttachGeometryByID(scene, instance, id);
  rtcReleaseGeometry(instance);
}

/// In a scene of placed meshes the instance is the mesh, in a plain one the geometry is.
std::uint32_t mesh_of(unsigned instance, unsigned geometry) {
  return instance != RTC_INVALID_GEOMETRY_ID ? instance : geometry;
}

}  // namespace

Motion turned_and_moved(core::Vec3 about, double turn, core::Vec3 by) {
  const double c = std::cos(turn), s = std::sin(turn);
  Motion out;
  out.x = {c, s, 0};
  out.y = {-s, c, 0};
  out.by = about + by - out.direction(about);
  return out;
}

Tracer::Tracer(std::shared_ptr<const twin::Geometry> geometry) : state_(std::make_unique<State>()) {
  state_->geometry = std::move(geometry);
  state_->device = new_device();
  state_->scene = new_scene(state_->device);
  for (std::size_t i = 0; i < state_->geometry->meshes.size(); ++i)
    attach(state_->device, state_->scene, state_->geometry->meshes[i], static_cast<unsigned>(i));
  rtcCommitScene(state_->scene);
  require_built(state_->device);
}

Tracer::Tracer(std::unique_ptr<State> state) : state_(std::move(state)) {}

MovingTracer::MovingTracer(std::shared_ptr<const twin::Geometry> geometry) {
  auto trees = std::make_shared<Trees>();
  trees->geometry = std::move(geometry);
  trees->device = new_device();
  for (const twin::Mesh& mesh : trees->geometry->meshes) {
    trees->meshes.push_back(new_scene(trees->device));
    attach(trees->device, trees->meshes.back(), mesh, 0);
    rtcCommitScene(trees->meshes.back());
  }
  require_built(trees->device);
  trees_ = std::move(trees);
}

MovingTracer::~MovingTracer() = default;

std::shared_ptr<const Tracer> MovingTracer::at(const Motion& motion) const {
  auto state = std::make_unique<Tracer::State>();
  state->geometry = trees_->geometry;
  state->trees = trees_;
  state->motion = motion;
  state->scene = new_scene(trees_->device);
  for (std::size_t i = 0; i < trees_->meshes.size(); ++i)
    place(trees_->device, state->scene, trees_->meshes[i],
          trees_->geometry->meshes[i].subject ? motion : Motion{}, static_cast<unsigned>(i));
  rtcCommitScene(state->scene);
  require_built(trees_->device);
  return std::shared_ptr<const Tracer>(new Tracer(std::move(state)));
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
  ray.hit.geomID = ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(state_->scene, &context, &ray);
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  return {
      true,          ray.ray.tfar, ray.hit.u, ray.hit.v, mesh_of(ray.hit.instID[0], ray.hit.geomID),
      ray.hit.primID};
}

void Tracer::closest16(core::Vec3 from, const core::Vec3* directions, std::size_t count,
                       Hit* hits) const {
  if (state_->trees != nullptr) {  // placed meshes: ray by ray, see place()
    for (std::size_t k = 0; k < count; ++k) hits[k] = closest(from, directions[k]);
    return;
  }
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
                  : Hit{true,
                        rays.ray.tfar[k],
                        rays.hit.u[k],
                        rays.hit.v[k],
                        mesh_of(rays.hit.instID[0][k], rays.hit.geomID[k]),
                        rays.hit.primID[k]};
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
const Motion& Tracer::motion() const { return state_->motion; }
void* Tracer::embree_scene() const { return state_->scene; }

}  // namespace chiaro::render
