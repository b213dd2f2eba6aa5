// SPDX-License-Identifier: Apache-2.0
#include "simulator/path_tracer/path_tracer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "controller/core/random.h"
#include "controller/render/surface.h"
#include "controller/twin/lights/light_model.h"
#include "simulator/path_tracer/light_sample.h"

namespace chiaro::simulator {
namespace {

using core::Rgb;
using core::Vec3;

/// Metres that shadow and bounce rays start off the surface: above the rounding of a 10 m studio,
/// below what a camera could see.
constexpr double kLift = 2e-4;
/// From here on a path survives by chance, in proportion to what it can still bring.
constexpr int kSureBounces = 2;

/// Two numbers each for the pixel, the lamp's face and the first bounce. The additive recurrence on
/// powers of the root of x^7 = x + 1 fills all six dimensions evenly (Roberts 2018, "The
/// unreasonable effectiveness of quasirandom sequences"); a random start per pixel keeps
/// neighbouring pixels independent.
class Even {
 public:
  explicit Even(core::Random& random) {
    for (double& s : start_) s = random.uniform();
  }
  double get(std::size_t dimension, int sample) const {
    const double x = start_[dimension] + (sample + 1) * kStep[dimension];
    return x - std::floor(x);
  }

 private:
  static constexpr double kRoot = 1.1127756842787055;
  static constexpr std::array<double, 6> kStep = [] {
    std::array<double, 6> steps{};
    double power = 1;
    for (double& s : steps) s = power = power / kRoot;
    return steps;
  }();
  std::array<double, 6> start_{};
};

struct Eye {
  Vec3 at, forward, right, up;
  double half_height = 0;
  core::Size size;

  Vec3 through(double x, double y) const {
    const double h = size.height;
    const double across = (2 * x - size.width) / h, down = (2 * y - h) / h;
    return core::unit(forward + (across * half_height) * right - (down * half_height) * up);
  }
};

Eye eye_of(const studio::Camera& camera, core::Size size) {
  Eye eye;
  eye.at = camera.at;
  eye.forward = core::unit(camera.look_at - camera.at);
  const Vec3 side = core::cross(eye.forward, {0, 0, 1});
  eye.right = core::length(side) > 1e-9 ? core::unit(side) : Vec3{1, 0, 0};
  eye.up = core::cross(eye.right, eye.forward);
  eye.half_height = std::tan(camera.vertical_fov / 2);
  eye.size = size;
  return eye;
}

Vec3 lifted(const render::Surface& surface) { return surface.position + kLift * surface.face; }

/// Cosine-weighted about the normal.
Vec3 bounced(Vec3 normal, double u, double v) {
  const double sign = normal.z >= 0 ? 1 : -1;  // Duff et al. 2017: a basis without a branch
  const double a = -1 / (sign + normal.z), b = normal.x * normal.y * a;
  const Vec3 tangent{1 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x};
  const Vec3 other{b, sign + normal.y * normal.y * a, -normal.y};
  const double r = std::sqrt(u), turn = 2 * core::kPi * v;
  return core::unit((r * std::cos(turn)) * tangent + (r * std::sin(turn)) * other +
                    std::sqrt(std::max(0.0, 1 - u)) * normal);
}

/// What one path brings: one colour per light at level 1, and the ambient light.
struct Gain {
  explicit Gain(std::size_t lights) : light(lights) {}
  std::vector<Rgb> light;
  Rgb ambient;
  void clear() {
    std::fill(light.begin(), light.end(), Rgb{});
    ambient = {};
  }
};

class Painter {
 public:
  Painter(const render::Tracer& tracer, const twin::Scene& scene, const TraceOptions& options,
          bool skip_dark)
      : tracer_(tracer), scene_(scene), options_(options) {
    for (std::size_t i = 0; i < scene.lights.size(); ++i)
      if (!skip_dark || scene.levels[i] > 0) lights_.push_back(i);
  }

  void path(Vec3 from, Vec3 direction, const Even& even, int sample, core::Random& random,
            Gain& gain) const {
    Rgb carried{scene_.exposure_gain, scene_.exposure_gain, scene_.exposure_gain};
    for (int bounce = 0;; ++bounce) {
      const render::Tracer::Hit hit = tracer_.closest(from, direction);
      if (!hit.hit) {
        if (bounce > 0) gain.ambient = gain.ambient + carried * scene_.ambient_irradiance;
        return;
      }
      const render::Surface surface = render::surface_at(tracer_.geometry(), hit, direction);
      const bool first = bounce == 0;
      light_directly(surface, -direction, carried, first,
                     first ? even.get(2, sample) : random.uniform(),
                     first ? even.get(3, sample) : random.uniform(), gain);
      carried = carried * surface.diffuse;
      if (bounce >= options_.bounces) {
        if (first) gain.ambient = gain.ambient + carried * scene_.ambient_irradiance;
        return;
      }
      if (bounce >= kSureBounces && !survives(carried, random)) return;
      from = lifted(surface);
      direction = bounced(surface.normal, first ? even.get(4, sample) : random.uniform(),
                          first ? even.get(5, sample) : random.uniform());
      if (core::dot(direction, surface.face) <= 0) return;
    }
  }

 private:
  void light_directly(const render::Surface& at, Vec3 viewer, Rgb carried, bool first, double u,
                      double v, Gain& gain) const {
    for (const std::size_t i : lights_) {
      const twin::Light& light = scene_.lights[i];
      const LightSample lit = sample(light, at.position, u, v);
      const double facing = core::dot(at.normal, lit.towards);
      if (lit.lux <= 0 || facing <= 0 || core::dot(at.face, lit.towards) <= 0) continue;
      if (tracer_.blocked(lifted(at), lit.from)) continue;
      Rgb seen = (facing * lit.lux) * at.diffuse;
      if (first && at.specular > 0) {
        const double highlight =
            at.specular * lit.lux * twin::highlight(at.normal, lit.towards, viewer, at.shininess);
        seen = seen + Rgb{highlight, highlight, highlight};
      }
      const Rgb brought = carried * light.colour * seen;
      gain.light[i] = gain.light[i] + (first ? brought : clipped(brought));
    }
  }

  Rgb clipped(Rgb c) const {
    const double most = std::max({c.r, c.g, c.b});
    if (options_.most_bounced <= 0 || most <= options_.most_bounced) return c;
    return (options_.most_bounced / most) * c;
  }

  bool survives(Rgb& carried, core::Random& random) const {
    const double most = std::max({carried.r, carried.g, carried.b}) / scene_.exposure_gain;
    const double chance = std::clamp(most, 0.05, 1.0);
    if (random.uniform() >= chance) return false;
    carried = (1 / chance) * carried;
    return true;
  }

  const render::Tracer& tracer_;
  const twin::Scene& scene_;
  const TraceOptions& options_;
  std::vector<std::size_t> lights_;
};

void add(core::Picture& picture, int x, int y, double share, Rgb c) {
  picture.set(x, y, picture.at(x, y) + share * c);
}

/// Counts rows and reports them in order of completion, one thread at a time.
class Rows {
 public:
  Rows(const TraceOptions& options, int rows) : options_(options), rows_(rows) {}
  bool stopped() const { return options_.stop && options_.stop->load(std::memory_order_relaxed); }
  void done_one() {
    if (!options_.progress) return;
    const std::lock_guard lock(mutex_);
    options_.progress(static_cast<double>(++done_) / rows_);
  }

 private:
  const TraceOptions& options_;
  int rows_, done_ = 0;
  std::mutex mutex_;
};

double luminance_at_levels(const Gain& gain, const std::vector<double>& levels) {
  double y = core::luminance(gain.ambient);
  for (std::size_t i = 0; i < levels.size(); ++i) y += levels[i] * core::luminance(gain.light[i]);
  return y;
}

/// All samples of one pixel. The random stream is the pixel's own: thread order cannot matter.
void paint_pixel(const Painter& painter, const twin::Scene& scene, const Eye& eye, int x, int y,
                 const TraceOptions& options, TracedLayers& into, Gain& gain) {
  const auto pixel = static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(eye.size.width) +
                     static_cast<std::uint64_t>(x);
  core::Random random(options.seed, pixel);
  const Even even(random);
  Gain sum(scene.lights.size());
  double total = 0, squares = 0;
  for (int s = 0; s < options.samples; ++s) {
    gain.clear();
    const double u = options.antialias ? even.get(0, s) : 0.5;
    const double v = options.antialias ? even.get(1, s) : 0.5;
    painter.path(eye.at, eye.through(x + u, y + v), even, s, random, gain);
    for (std::size_t i = 0; i < sum.light.size(); ++i) sum.light[i] = sum.light[i] + gain.light[i];
    sum.ambient = sum.ambient + gain.ambient;
    const double value = luminance_at_levels(gain, scene.levels);
    total += value;
    squares += value * value;
  }
  const double n = options.samples, share = 1 / n;
  for (std::size_t i = 0; i < sum.light.size(); ++i) into.lights[i].set(x, y, share * sum.light[i]);
  into.ambient.set(x, y, share * sum.ambient);
  const double variance = n > 1 ? std::max(0.0, squares - total * total / n) / (n - 1) : 0;
  into.error.at(x, y) = static_cast<float>(std::sqrt(variance / n));
}

double root_mean_square(const core::Plane& plane) {
  double sum = 0;
  for (const float v : plane.values) sum += double{v} * double{v};
  return std::sqrt(sum / static_cast<double>(plane.values.size()));
}

TracedLayers painted(const render::Tracer& tracer, const twin::Scene& scene,
                     const studio::Camera& camera, core::Size size, const TraceOptions& options,
                     bool skip_dark) {
  const Painter painter(tracer, scene, options, skip_dark);
  const Eye eye = eye_of(camera, size);
  TracedLayers layers;
  layers.lights.assign(scene.lights.size(), core::Picture(size));
  layers.ambient = core::Picture(size);
  layers.error = core::Plane(size);
  Rows rows(options, size.height);
  const auto paint_rows = [&](const tbb::blocked_range<int>& range) {
    Gain gain(scene.lights.size());
    for (int y = range.begin(); y != range.end(); ++y) {
      if (rows.stopped()) return;
      for (int x = 0; x < size.width; ++x)
        paint_pixel(painter, scene, eye, x, y, options, layers, gain);
      rows.done_one();
    }
  };
  tbb::task_arena arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic);
  arena.execute([&] { tbb::parallel_for(tbb::blocked_range<int>(0, size.height, 1), paint_rows); });
  layers.noise = root_mean_square(layers.error);
  return layers;
}

}  // namespace

TracedLayers trace_layers(const render::Tracer& tracer, const twin::Scene& scene,
                          const studio::Camera& camera, core::Size size,
                          const TraceOptions& options) {
  return painted(tracer, scene, camera, size, options, false);
}

core::Picture mixed(const TracedLayers& layers, const std::vector<double>& levels) {
  core::Picture picture = layers.ambient;
  const core::Size size = picture.size();
  for (std::size_t i = 0; i < levels.size(); ++i)
    for (int y = 0; y < size.height; ++y)
      for (int x = 0; x < size.width; ++x) add(picture, x, y, levels[i], layers.lights[i].at(x, y));
  return picture;
}

Traced trace(const render::Tracer& tracer, const twin::Scene& scene, const studio::Camera& camera,
             core::Size size, const TraceOptions& options) {
  TracedLayers layers = painted(tracer, scene, camera, size, options, true);
  return {mixed(layers, scene.levels), std::move(layers.error), layers.noise};
}

}  // namespace chiaro::simulator
