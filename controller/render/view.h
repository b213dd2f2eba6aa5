// SPDX-License-Identifier: Apache-2.0
// What one camera sees, and what each light adds to it. The view is built once; layers are made
// when a light moves; pictures are mixed from layers by levels and never trace a ray.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "controller/core/gbuffer.h"
#include "controller/core/result.h"
#include "controller/twin/scene.h"

struct RTCRay16;  // Embree's

namespace chiaro::render {

class Samples;

/// How a subject has moved as a whole since its geometry was built: turned about the origin, then
/// shifted. The axes are where x, y and z have been turned to, unit and perpendicular.
struct Motion {
  core::Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, by{};
  core::Vec3 direction(core::Vec3 v) const { return v.x * x + v.y * y + v.z * z; }
  core::Vec3 point(core::Vec3 p) const { return direction(p) + by; }
  core::Vec3 turned_back(core::Vec3 v) const { return {dot(v, x), dot(v, y), dot(v, z)}; }
};
/// Turned by `turn` radians about the upright through `about`, then shifted.
Motion turned_and_moved(core::Vec3 about, double turn, core::Vec3 by);

/// Embree's trees over a Geometry. Thread-safe once built. Owns nothing of the geometry but a
/// shared reference.
class Tracer {
 public:
  explicit Tracer(std::shared_ptr<const twin::Geometry> geometry);
  ~Tracer();
  Tracer(const Tracer&) = delete;
  Tracer& operator=(const Tracer&) = delete;

  struct Hit {
    bool hit = false;
    float distance = 0, u = 0, v = 0;
    std::uint32_t mesh = 0, triangle = 0;
  };
  Hit closest(core::Vec3 from, core::Vec3 direction, double most = 1e30) const;
  /// Up to 16 rays from one point in much the same direction, at once. Precondition: count 1..16.
  void closest16(core::Vec3 from, const core::Vec3* directions, std::size_t count, Hit* hits) const;
  bool blocked(core::Vec3 from, core::Vec3 to) const;
  /// Sixteen rays in Embree's layout, for kernels inside `render`: tfar becomes negative where
  /// `valid` is -1 and the way is blocked. Both aligned to 64 bytes.
  void blocked16(const int* valid, RTCRay16& rays) const;
  /// As it was built; what belongs to a subject has moved by motion() since.
  const twin::Geometry& geometry() const;
  const Motion& motion() const { return motion_; }

 private:
  friend class MovingTracer;
  struct Trees;
  static std::shared_ptr<const Trees> trees_of(std::shared_ptr<const twin::Geometry> geometry,
                                               bool subjects_move);
  Tracer(std::shared_ptr<const Trees> trees, const Motion& motion);
  std::shared_ptr<const Trees> trees_;
  Motion motion_;
};

/// Tracers of one geometry whose subjects move. Trees are built once: subjects have one of their
/// own, and a ray is turned back to where they stood. (Embree's instances would do it too, but
/// release 3.13 sometimes never comes back from a packet that meets one.)
class MovingTracer {
 public:
  explicit MovingTracer(std::shared_ptr<const twin::Geometry> geometry);
  /// With every subject moved by `motion`. Outlives this. Thread-safe.
  std::shared_ptr<const Tracer> at(const Motion& motion) const;

 private:
  std::shared_ptr<const Tracer::Trees> trees_;
};

/// One surface sample per pixel of `camera` at `size` (the camera's aspect is kept by its vertical
/// field of view). Counts rays in `work`.
struct View {
  core::GBuffer buffer;
  std::shared_ptr<const Tracer> tracer;
  std::shared_ptr<const Samples> samples;  ///< the buffer again, laid out for the kernels
  core::Vec3 eye;
};
View see(std::shared_ptr<const Tracer> tracer, const studio::Camera& camera, core::Size size);

enum class Shadows { none, hard, soft };  ///< hard: one ray to an area light's centre

/// Traced exactly: the reference. One or many rays per sample (soft: a fixed 16 x 16 stratified set
/// for rectangle and disk). Values are display-linear (exposure gain applied), at full level.
core::Layer layer(const View& view, const twin::Light& light, double exposure_gain,
                  Shadows shadows = Shadows::soft);
/// Visible fraction 0..1 of the light per pixel (1 where nothing is seen), by what stands between:
/// a surface that merely faces away is asked about a light just above its horizon (shadow.h).
core::Plane visibility(const View& view, const twin::Light& light, Shadows shadows = Shadows::soft);
core::Picture ambient_layer(const View& view, const core::Rgb& irradiance, double exposure_gain);

/// sum of level * (diffuse + specular) over layers, plus ambient. Precondition: equal sizes.
core::Picture relit(std::span<const core::Layer> layers, std::span<const double> levels,
                    const core::Picture& ambient);
/// The same for one plane each, such as luminance. At most 64 layers; `out` has the ambient's size.
void relit(std::span<const core::Plane* const> layers, std::span<const double> levels,
           const core::Plane& ambient, core::Plane& out);
/// The whole scene, once, with exact shadows.
core::Picture picture(const View& view, const twin::Scene& scene, Shadows shadows = Shadows::soft);

/// Work done since the program began, for tests and the bench: counted, never timed.
struct Work {
  std::uint64_t primary_rays = 0, shadow_rays = 0, layers = 0;
  std::uint64_t nodes = 0;  ///< places whose visibility was cached
};
Work work_done();  ///< process-wide, relaxed atomics

}  // namespace chiaro::render
