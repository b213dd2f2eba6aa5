// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "controller/render/samples.h"
#include "controller/render/surface.h"
#include "controller/render/view.h"
#include "controller/render/work.h"

// One ray a pixel says which object and face it sees: in place of colour codes [I-6] and of a
// search of the picture for every polygon [I-7].
namespace chiaro::render {
namespace {

using core::Vec3;

struct Pinhole {
  Vec3 eye, axis, right, up;  ///< right and up reach the picture's edge at one metre
  core::Size size;
  Vec3 direction(int x, int y) const {
    const double a = 2 * (x + 0.5) / size.width - 1, b = 1 - 2 * (y + 0.5) / size.height;
    return unit(axis + a * right + b * up);
  }
};

Pinhole pinhole(const studio::Camera& camera, core::Size size) {
  Pinhole out{camera.at, unit(camera.look_at - camera.at), {}, {}, size};
  const Vec3 level = cross(out.axis, Vec3{0, 0, 1});
  const Vec3 right = length(level) > 1e-9 ? unit(level) : Vec3{1, 0, 0};
  const double v = std::tan(camera.vertical_fov / 2);
  out.right = v * size.width / size.height * right;
  out.up = v * cross(right, out.axis);
  return out;
}

void resize(core::GBuffer& b, std::size_t n) {
  b.pixel.resize(n);
  for (auto* list :
       {&b.position_x, &b.position_y, &b.position_z, &b.normal_x, &b.normal_y, &b.normal_z,
        &b.face_x, &b.face_y, &b.face_z, &b.viewer_x, &b.viewer_y, &b.viewer_z, &b.diffuse_r,
        &b.diffuse_g, &b.diffuse_b, &b.specular, &b.shininess, &b.depth})
    list->resize(n);
  b.object.resize(n);
}

void store(core::GBuffer& b, std::size_t i, const Surface& s, const Pinhole& camera, Vec3 direction,
           const Tracer::Hit& hit) {
  const auto put = [i](std::vector<float>& x, std::vector<float>& y, std::vector<float>& z,
                       Vec3 v) {
    x[i] = static_cast<float>(v.x), y[i] = static_cast<float>(v.y), z[i] = static_cast<float>(v.z);
  };
  put(b.position_x, b.position_y, b.position_z, s.position);
  put(b.normal_x, b.normal_y, b.normal_z, s.normal);
  put(b.face_x, b.face_y, b.face_z, s.face);
  put(b.viewer_x, b.viewer_y, b.viewer_z, -direction);
  put(b.diffuse_r, b.diffuse_g, b.diffuse_b, {s.diffuse.r, s.diffuse.g, s.diffuse.b});
  b.specular[i] = static_cast<float>(s.specular);
  b.shininess[i] = static_cast<float>(s.shininess);
  b.depth[i] = static_cast<float>(dot(s.position - camera.eye, camera.axis));
  b.object[i] = static_cast<std::uint16_t>(hit.mesh + 1);
}

/// In the studio, whether it has moved or not.
Surface surface_of(const Tracer& tracer, const Tracer::Hit& hit, Vec3 direction) {
  const twin::Geometry& geometry = tracer.geometry();
  if (!geometry.meshes[hit.mesh].subject) return surface_at(geometry, hit, direction);
  const Motion& motion = tracer.motion();
  Surface out = surface_at(geometry, hit, motion.turned_back(direction));
  out.position = motion.point(out.position);
  out.normal = motion.direction(out.normal);
  out.face = motion.direction(out.face);
  return out;
}

}  // namespace

View see(std::shared_ptr<const Tracer> tracer, const studio::Camera& camera, core::Size size) {
  View view;
  view.buffer.size = size;
  view.eye = camera.at;
  for (const twin::Mesh& mesh : tracer->geometry().meshes)
    view.buffer.objects.push_back({mesh.name, mesh.subject});
  const Pinhole pin = pinhole(camera, size);
  const auto width = static_cast<std::size_t>(size.width);
  std::vector<Tracer::Hit> hits(size.pixels());
  std::vector<std::size_t> first(static_cast<std::size_t>(size.height) + 1, 0);
  tbb::parallel_for(0, size.height, [&](int y) {
    std::size_t seen = 0;
    Tracer::Hit* row = hits.data() + static_cast<std::size_t>(y) * width;
    std::array<Vec3, 16> directions;
    for (int x = 0; x < size.width; x += 16) {
      const int n = std::min(16, size.width - x);
      for (int k = 0; k < n; ++k) directions[static_cast<std::size_t>(k)] = pin.direction(x + k, y);
      tracer->closest16(pin.eye, directions.data(), static_cast<std::size_t>(n), row + x);
      for (int k = 0; k < n; ++k) seen += row[x + k].hit;
    }
    first[static_cast<std::size_t>(y) + 1] = seen;
  });
  work().primary_rays += size.pixels();
  std::partial_sum(first.begin(), first.end(), first.begin());
  resize(view.buffer, first.back());
  tbb::parallel_for(0, size.height, [&](int y) {
    std::size_t i = first[static_cast<std::size_t>(y)];
    for (int x = 0; x < size.width; ++x) {
      const std::size_t pixel = static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
      if (!hits[pixel].hit) continue;
      const Vec3 direction = pin.direction(x, y);
      view.buffer.pixel[i] = static_cast<std::uint32_t>(pixel);
      store(view.buffer, i++, surface_of(*tracer, hits[pixel], direction), pin, direction,
            hits[pixel]);
    }
  });
  view.tracer = std::move(tracer);
  view.samples = std::make_shared<const Samples>(view.buffer);
  return view;
}

}  // namespace chiaro::render
