// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <stdexcept>
#include <vector>

#include "controller/render/kernels.h"
#include "controller/render/lighting.h"
#include "controller/render/view.h"

namespace chiaro::render {
namespace {

Strata strata(Shadows shadows) { return shadows == Shadows::soft ? kExact : kHard; }

/// Adds level x each plane to `to`, in one pass over memory.
void mix_into(core::Plane& to, std::span<const core::Plane* const> planes,
              std::span<const double> levels) {
  std::vector<const float*> from;
  std::vector<float> weights;
  for (std::size_t k = 0; k < planes.size(); ++k) {
    if (!(planes[k]->size == to.size)) throw std::logic_error("layers of unequal size");
    from.push_back(planes[k]->values.data());
    weights.push_back(static_cast<float>(levels[k]));
  }
  kernels::mix(from, weights, to.values.data(), to.values.data(), to.values.size());
}

}  // namespace

core::Layer layer(const View& view, const twin::Light& light, double gain, Shadows shadows) {
  core::Layer out;
  const Traced traced(view, light, strata(shadows));
  colour(view, light, gain, shadows == Shadows::none ? nullptr : &traced, out);
  return out;
}

core::Plane visibility(const View& view, const twin::Light& light, Shadows shadows) {
  core::Plane out(view.buffer.size, 1.0f);
  if (shadows != Shadows::none) visibility(view, Traced(view, light, strata(shadows)), out);
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

void relit(std::span<const core::Plane* const> layers, std::span<const double> levels,
           const core::Plane& ambient, core::Plane& out) {
  std::array<const float*, 64> from;
  std::array<float, 64> weights;
  if (layers.size() > from.size() || !(out.size == ambient.size))
    throw std::logic_error("relit: more than 64 layers, or planes of unequal size");
  for (std::size_t k = 0; k < layers.size(); ++k) {
    from[k] = layers[k]->values.data();
    weights[k] = static_cast<float>(levels[k]);
  }
  kernels::mix({from.data(), layers.size()}, {weights.data(), layers.size()}, ambient.values.data(),
               out.values.data(), out.values.size());
}

core::Picture relit(std::span<const core::Layer> layers, std::span<const double> levels,
                    const core::Picture& ambient) {
  core::Picture out = ambient;
  std::vector<const core::Plane*> planes(2 * layers.size());
  std::vector<double> twice(planes.size());
  for (core::Plane core::Picture::*channel :
       {&core::Picture::red, &core::Picture::green, &core::Picture::blue}) {
    for (std::size_t k = 0; k < layers.size(); ++k) {
      planes[2 * k] = &(layers[k].diffuse.*channel);
      planes[2 * k + 1] = &(layers[k].specular.*channel);
      twice[2 * k] = twice[2 * k + 1] = levels[k];
    }
    mix_into(out.*channel, planes, twice);
  }
  return out;
}

core::Picture picture(const View& view, const twin::Scene& scene, Shadows shadows) {
  std::vector<core::Layer> layers;
  std::vector<double> levels;
  for (std::size_t k = 0; k < scene.lights.size(); ++k) {
    if (scene.levels[k] <= 0) continue;
    layers.push_back(layer(view, scene.lights[k], scene.exposure_gain, shadows));
    levels.push_back(scene.levels[k]);
  }
  return relit(layers, levels, ambient_layer(view, scene.ambient_irradiance, scene.exposure_gain));
}

}  // namespace chiaro::render
