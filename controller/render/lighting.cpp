// SPDX-License-Identifier: Apache-2.0
#include "controller/render/lighting.h"

#include <algorithm>
#include <array>
#include <tbb/parallel_for.h>

#include "controller/render/kernels.h"
#include "controller/render/work.h"

namespace chiaro::render {
namespace {

struct alignas(64) Tile {
  std::array<float, kTile> irradiance, glossy, visible, out;
};

/// A cached light is done before another core has woken up; traced ones are worth waking it for.
/// Each tile is one thread's alone, so the answer does not depend on their number.
template <class F>
void over_tiles(const Samples& samples, const Visible* visible, const F& f) {
  if (visible != nullptr && visible->traces())
    tbb::parallel_for(std::size_t{0}, samples.tiles(), f);
  else
    for (std::size_t t = 0; t < samples.tiles(); ++t) f(t);
}

struct Lit {
  const float *glossy, *visible;
};
Lit light_tile(const View& view, const twin::Light& light, const Visible* visible, std::size_t t,
               Tile& tile, Shading shading) {
  const Samples& samples = *view.samples;
  float* glossy = samples.glossy(t) ? tile.glossy.data() : nullptr;
  if (visible != nullptr) visible->tile(t, tile.visible.data());
  const float* seen = visible != nullptr ? tile.visible.data() : nullptr;
  kernels::shade(samples, light, t, tile.irradiance.data(), glossy, shading, seen);
  return {glossy, seen};
}

void clear_unseen(const Samples& samples, core::Plane& plane, float value) {
  if (!(plane.size == samples.size())) plane = core::Plane(samples.size());
  if (!samples.fills_picture()) std::fill(plane.values.begin(), plane.values.end(), value);
}

}  // namespace

Counters& work() {
  static Counters counters;
  return counters;
}
Work work_done() {
  return {work().primary_rays.value(), work().shadow_rays.value(), work().layers.value(),
          work().nodes.value()};
}

void Traced::tile(std::size_t tile, float* out) const {
  trace_fraction(view_, light_, strata_, tile * kTile,
                 {out, std::min(kTile, view_.buffer.samples() - tile * kTile)});
  std::fill(out + view_.samples->in_tile(tile), out + kTile, 0.0f);
}

void luminance(const View& view, const twin::Light& light, double gain, const Visible* visible,
               core::Plane& out, Shading shading, core::Plane* seen) {
  const Samples& samples = *view.samples;
  clear_unseen(samples, out, 0);
  if (seen != nullptr) clear_unseen(samples, *seen, 1);
  const core::Rgb c = light.colour;
  const bool neutral = c.r == c.g && c.g == c.b;
  const float rgb[3] = {static_cast<float>(gain * c.r) * core::kLuminance[0],
                        static_cast<float>(gain * c.g) * core::kLuminance[1],
                        static_cast<float>(gain * c.b) * core::kLuminance[2]};
  const auto y = static_cast<float>(gain * core::luminance(c));
  over_tiles(samples, visible, [&](std::size_t t) {
    Tile tile;
    const Lit lit = light_tile(view, light, visible, t, tile, shading);
    if (seen != nullptr && lit.visible != nullptr)
      samples.scatter(t, lit.visible, seen->values.data());
    if (neutral)
      kernels::combine(samples.channel(Samples::diffuse_y) + t * kTile, tile.irradiance.data(),
                       lit.glossy, lit.visible, y, y, tile.out.data(), kTile);
    else
      kernels::combine_rgb(samples, t, tile.irradiance.data(), lit.glossy, lit.visible, rgb, y,
                           tile.out.data());
    samples.scatter(t, tile.out.data(), out.values.data());
  });
  work().layers += 1;
}

void colour(const View& view, const twin::Light& light, double gain, const Visible* visible,
            core::Layer& out, Shading shading) {
  const Samples& samples = *view.samples;
  for (core::Picture* part : {&out.diffuse, &out.specular})
    for (core::Plane* plane : {&part->red, &part->green, &part->blue})
      clear_unseen(samples, *plane, 0);
  const std::array<double, 3> c{light.colour.r, light.colour.g, light.colour.b};
  const std::array<core::Plane*, 3> diffuse{&out.diffuse.red, &out.diffuse.green,
                                            &out.diffuse.blue};
  const std::array<core::Plane*, 3> specular{&out.specular.red, &out.specular.green,
                                             &out.specular.blue};
  const std::array albedo{Samples::diffuse_r, Samples::diffuse_g, Samples::diffuse_b};
  over_tiles(samples, visible, [&](std::size_t t) {
    Tile tile;
    const Lit lit = light_tile(view, light, visible, t, tile, shading);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto gc = static_cast<float>(gain * c[k]);
      kernels::combine(samples.channel(albedo[k]) + t * kTile, tile.irradiance.data(), nullptr,
                       lit.visible, gc, 0, tile.out.data(), kTile);
      samples.scatter(t, tile.out.data(), diffuse[k]->values.data());
      if (lit.glossy != nullptr)
        // 0 x irradiance: the highlight alone.
        kernels::combine(tile.irradiance.data(), tile.irradiance.data(), lit.glossy, lit.visible, 0,
                         gc, tile.out.data(), kTile);
      else
        std::fill(tile.out.begin(), tile.out.end(), 0.0f);
      samples.scatter(t, tile.out.data(), specular[k]->values.data());
    }
  });
  work().layers += 1;
}

void visibility(const View& view, const Visible& visible, core::Plane& out) {
  const Samples& samples = *view.samples;
  clear_unseen(samples, out, 1);
  over_tiles(samples, &visible, [&](std::size_t t) {
    alignas(64) std::array<float, kTile> values;
    visible.tile(t, values.data());
    samples.scatter(t, values.data(), out.values.data());
  });
}

}  // namespace chiaro::render
