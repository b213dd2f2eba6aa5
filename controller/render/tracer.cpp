// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <embree3/rtcore.h>
#include <stdexcept>

#include "controller/render/view.h"

namespace chiaro::render {

struct Tracer::Trees {
  std::shared_ptr<const twin::Geometry> geometry;
  RTCDevice device = nullptr;
  RTCScene still = nullptr;   ///< what never moves: everything, in a plain tracer
  RTCScene moving = nullptr;  ///< subjects where they stood at first; null in a plain tracer
  ~Trees() {
    for (const RTCScene scene : {still, moving})
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

constexpr std::size_t kPacket = 16;

template <class Ray>
void set_ray(Ray& ray, core::Vec3 from, core::Vec3 direction, double most) {
  ray.org_x = static_cast<float>(from.x);
  ray.org_y = static_cast<float>(from.y);
  ray.org_z = static_cast<float>(from.z);
  ray.dir_x = static_cast<float>(direction.x);
  ray.dir_y = static_cast<float>(direction.y);
  ray.dir_z = static_cast<float>(direction.z);
  ray.tnear = 0;
  ray.tfar = static_cast<float>(most);
  ray.mask = 0xffffffffu;
}

/// Up to 16 rays from one point that have hit nothing yet.
void set_packet(RTCRayHit16& rays, core::Vec3 from, const core::Vec3* directions,
                std::size_t count) {
  for (std::size_t k = 0; k < kPacket; ++k) {
    const core::Vec3 d = directions[std::min(k, count - 1)];
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
}

RTCIntersectContext coherent() {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  return context;
}

/// The rays as a subject sees them that has not moved. Lengths stay what they are.
void turn_back(const Motion& motion, const RTCRay16& rays, RTCRay16& out) {
  const auto f = [](double v) { return static_cast<float>(v); };
  const float xx = f(motion.x.x), xy = f(motion.x.y), xz = f(motion.x.z);
  const float yx = f(motion.y.x), yy = f(motion.y.y), yz = f(motion.y.z);
  const float zx = f(motion.z.x), zy = f(motion.z.y), zz = f(motion.z.z);
  const float bx = f(motion.by.x), by = f(motion.by.y), bz = f(motion.by.z);
  for (std::size_t k = 0; k < kPacket; ++k) {
    const float ox = rays.org_x[k] - bx, oy = rays.org_y[k] - by, oz = rays.org_z[k] - bz;
    out.org_x[k] = ox * xx + oy * xy + oz * xz;
    out.org_y[k] = ox * yx + oy * yy + oz * yz;
    out.org_z[k] = ox * zx + oy * zy + oz * zz;
    const float dx = rays.dir_x[k], dy = rays.dir_y[k], dz = rays.dir_z[k];
    out.dir_x[k] = dx * xx + dy * xy + dz * xz;
    out.dir_y[k] = dx * yx + dy * yy + dz * yz;
    out.dir_z[k] = dx * zx + dy * zy + dz * zz;
    out.tnear[k] = rays.tnear[k], out.tfar[k] = rays.tfar[k], out.time[k] = 0;
    out.mask[k] = rays.mask[k], out.id[k] = 0, out.flags[k] = 0;
  }
}

void take_hits(const RTCRayHit16& rays, std::size_t count, Tracer::Hit* hits) {
  for (std::size_t k = 0; k < count; ++k)
    if (rays.hit.geomID[k] != RTC_INVALID_GEOMETRY_ID)
      hits[k] = {true,          rays.ray.tfar[k],   rays.hit.u[k],
                 rays.hit.v[k], rays.hit.geomID[k], rays.hit.primID[k]};
}

void take_hit(const RTCRayHit& ray, Tracer::Hit& hit) {
  if (ray.hit.geomID != RTC_INVALID_GEOMETRY_ID)
    hit = {true, ray.ray.tfar, ray.hit.u, ray.hit.v, ray.hit.geomID, ray.hit.primID};
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

std::shared_ptr<const Tracer::Trees> Tracer::trees_of(
    std::shared_ptr<const twin::Geometry> geometry, bool subjects_move) {
  auto trees = std::make_shared<Trees>();
  trees->geometry = std::move(geometry);
  trees->device = new_device();
  trees->still = new_scene(trees->device);
  if (subjects_move) trees->moving = new_scene(trees->device);
  for (std::size_t i = 0; i < trees->geometry->meshes.size(); ++i) {
    const twin::Mesh& mesh = trees->geometry->meshes[i];
    attach(trees->device, mesh.subject && subjects_move ? trees->moving : trees->still, mesh,
           static_cast<unsigned>(i));
  }
  for (const RTCScene scene : {trees->still, trees->moving})
    if (scene != nullptr) rtcCommitScene(scene);
  require_built(trees->device);
  return trees;
}

Tracer::Tracer(std::shared_ptr<const twin::Geometry> geometry)
    : trees_(trees_of(std::move(geometry), false)) {}
Tracer::Tracer(std::shared_ptr<const Trees> trees, const Motion& motion)
    : trees_(std::move(trees)), motion_(motion) {}
Tracer::~Tracer() = default;

MovingTracer::MovingTracer(std::shared_ptr<const twin::Geometry> geometry)
    : trees_(Tracer::trees_of(std::move(geometry), true)) {}

std::shared_ptr<const Tracer> MovingTracer::at(const Motion& motion) const {
  return std::shared_ptr<const Tracer>(new Tracer(trees_, motion));
}

Tracer::Hit Tracer::closest(core::Vec3 from, core::Vec3 direction, double most) const {
  Hit hit;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit ray{};
  set_ray(ray.ray, from, direction, most);
  ray.hit.geomID = ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(trees_->still, &context, &ray);
  take_hit(ray, hit);
  if (trees_->moving == nullptr) return hit;
  RTCRayHit back{};
  set_ray(back.ray, motion_.turned_back(from - motion_.by), motion_.turned_back(direction),
          hit.hit ? hit.distance : most);
  back.hit.geomID = back.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(trees_->moving, &context, &back);
  take_hit(back, hit);
  return hit;
}

void Tracer::closest16(core::Vec3 from, const core::Vec3* directions, std::size_t count,
                       Hit* hits) const {
  RTCIntersectContext context = coherent();
  alignas(64) int valid[kPacket];
  for (std::size_t k = 0; k < kPacket; ++k) valid[k] = k < count ? -1 : 0;
  alignas(64) RTCRayHit16 rays;
  set_packet(rays, from, directions, count);
  rtcIntersect16(valid, trees_->still, &context, &rays);
  std::fill_n(hits, count, Hit{});
  take_hits(rays, count, hits);
  if (trees_->moving == nullptr) return;
  alignas(64) RTCRayHit16 back = rays;
  turn_back(motion_, rays.ray, back.ray);
  for (unsigned& id : back.hit.geomID) id = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect16(valid, trees_->moving, &context, &back);
  take_hits(back, count, hits);
}

bool Tracer::blocked(core::Vec3 from, core::Vec3 to) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay ray{};
  set_ray(ray, from, to - from, 1);
  rtcOccluded1(trees_->still, &context, &ray);
  if (ray.tfar < 0 || trees_->moving == nullptr) return ray.tfar < 0;
  RTCRay back{};
  set_ray(back, motion_.turned_back(from - motion_.by), motion_.turned_back(to - from), 1);
  rtcOccluded1(trees_->moving, &context, &back);
  return back.tfar < 0;
}

void Tracer::blocked16(const int* valid, RTCRay16& rays) const {
  RTCIntersectContext context = coherent();
  rtcOccluded16(valid, trees_->still, &context, &rays);
  if (trees_->moving == nullptr) return;
  alignas(64) int left[kPacket];
  bool any = false;
  for (std::size_t k = 0; k < kPacket; ++k) {
    left[k] = valid[k] != 0 && !(rays.tfar[k] < 0) ? -1 : 0;
    any = any || left[k] != 0;
  }
  if (!any) return;
  alignas(64) RTCRay16 back;
  turn_back(motion_, rays, back);
  rtcOccluded16(left, trees_->moving, &context, &back);
  for (std::size_t k = 0; k < kPacket; ++k)
    if (left[k] != 0) rays.tfar[k] = back.tfar[k];
}

const twin::Geometry& Tracer::geometry() const { return *trees_->geometry; }

}  // namespace chiaro::render
