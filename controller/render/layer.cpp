// SPDX-License-Identifier: Apache-2.0
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <stdexcept>

#include "controller/render/shadow.h"
#include "controller/render/view.h"
#include "controller/render/work.h"
#include "controller/twin/lights/light_model.h"

namespace chiaro::render {
namespace {

using core::Vec3;

constexpr std::size_t kTile = 512;
constexpr int kExactStrata = 16;

template <class F>
void over_tiles(std::size_t samples, const F& f) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, samples, kTile),
                    [&](const auto& range) { f(range.begin(), range.end()); });
}

std::vector<float> fractions(const View& view, const twin::Light& light, Shadows shadows) {
  std::vector<float> out(view.buffer.samples(), 1.0f);
  if (shadows == Shadows::none) return out;
  const int strata = shadows == Shadows::hard ? 1 : kExactStrata;
  over_tiles(out.size(), [&](std::size_t from, std::size_t to) {
    trace_fraction(view, light, strata, from, std::span(out).subspan(from, to - from));
  });
  return out;
}

}  // namespace

Counters& work() {
  static Counters counters;
  return counters;
}
Work work_done() {
  return {work().primary_rays.value(), work().shadow_rays.value(), work().layers.value()};
}

core::Layer layer(const View& view, const twin::Light& light, double gain, Shadows shadows) {
  const core::GBuffer& b = view.buffer;
  const twin::LightModel& model = twin::light_model(light.kind);
  const std::vector<float> visible = fractions(view, light, shadows);
  core::Layer out{core::Picture(b.size), core::Picture(b.size)};
  over_tiles(b.samples(), [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      const Vec3 at{b.position_x[i], b.position_y[i], b.position_z[i]};
      const Vec3 normal{b.normal_x[i], b.normal_y[i], b.normal_z[i]};
      const double k = gain * visible[i];
      const double e = k * model.irradiance(light, at, normal);
      const std::size_t p = b.pixel[i];
      out.diffuse.red.values[p] = static_cast<float>(e * light.colour.r * b.diffuse_r[i]);
      out.diffuse.green.values[p] = static_cast<float>(e * light.colour.g * b.diffuse_g[i]);
      out.diffuse.blue.values[p] = static_cast<float>(e * light.colour.b * b.diffuse_b[i]);
      if (b.specular[i] <= 0) continue;
      const double s = k * b.specular[i] *
                       model.specular(light, at, normal,
                                      {b.viewer_x[i], b.viewer_y[i], b.viewer_z[i]}, b.shininess[i]);
      out.specular.red.values[p] = static_cast<float>(s * light.colour.r);
      out.specular.green.values[p] = static_cast<float>(s * light.colour.g);
      out.specular.blue.values[p] = static_cast<float>(s * light.colour.b);
    }
  });
  work().layers += 1;
  return out;
}

core::Plane visibility(const View& view, const twin::Light& light, Shadows shadows) {
  const std::vector<float> visible = fractions(view, light, shadows);
  core::Plane out(view.buffer.size, 1.0f);
  for (std::size_t i = 0; i < visible.size(); ++i) out.values[view.buffer.pixel[i]] = visible[i];
  return out;
}

core::Picture ambient_layer(const View& view, const core::Rgb& irradiance, double gain) {
  const core::GBuffer& b = view.buffer;
  core::Picture out(b.size);
  for (std::size_t i = 0; i < b.samples(); ++i) {
    const std::size_t p = b.pixel[i];
    out.red.values[p] = static_cast<float>(gain * irradiance.r * b.diffuse_r[i]);
    out.green.values[p] = static_cast<float>(gain * irradiance.g * b.diffuse_g[i]);
    out.blue.values[p] = static_cast<float>(gain * irradiance.b * b.diffuse_b[i]);
  }
  return out;
}

namespace {
void add(core::Plane& to, double level, const core::Plane& from) {
  const auto k = static_cast<float>(level);
  for (std::size_t i = 0; i < to.values.size(); ++i) to.values[i] += k * from.values[i];
}
void add(core::Picture& to, double level, const core::Picture& from) {
  add(to.red, level, from.red);
  add(to.green, level, from.green);
  add(to.blue, level, from.blue);
}
}  // namespace

core::Picture relit(std::span<const core::Layer> layers, std::span<const double> levels,
                    const core::Picture& ambient) {
  core::Picture out = ambient;
  for (std::size_t k = 0; k < layers.size(); ++k) {
    if (!(layers[k].diffuse.size() == out.size())) throw std::logic_error("layers of unequal size");
    add(out, levels[k], layers[k].diffuse);
    add(out, levels[k], layers[k].specular);
  }
  return out;
}

core::Picture picture(const View& view, const twin::Scene& scene, Shadows shadows) {
  core::Picture out = ambient_layer(view, scene.ambient_irradiance, scene.exposure_gain);
  for (std::size_t k = 0; k < scene.lights.size(); ++k) {
    if (scene.levels[k] <= 0) continue;
    const core::Layer lit = layer(view, scene.lights[k], scene.exposure_gain, shadows);
    add(out, scene.levels[k], lit.diffuse);
    add(out, scene.levels[k], lit.specular);
  }
  return out;
}

}  // namespace chiaro::render
