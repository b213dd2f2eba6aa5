// SPDX-License-Identifier: Apache-2.0
// Which kernel a light goes through.
#include "controller/render/kernels.h"

#include <hwy/targets.h>

#include "controller/twin/lights/light_model.h"

namespace chiaro::render::kernels {

namespace {
core::Vec3 triple(const Samples& s, Samples::Channel x, Samples::Channel y, Samples::Channel z,
                  std::size_t i) {
  return {s.channel(x)[i], s.channel(y)[i], s.channel(z)[i]};
}

void shade_by_formula(const Samples& s, const twin::Light& light, std::size_t tile,
                      float* irradiance, float* glossy) {
  const twin::LightModel& model = twin::light_model(light.kind);
  for (std::size_t k = 0; k < kTile; ++k) {
    const std::size_t i = tile * kTile + k;
    const auto at = triple(s, Samples::position_x, Samples::position_y, Samples::position_z, i);
    const auto n = triple(s, Samples::normal_x, Samples::normal_y, Samples::normal_z, i);
    const auto v = triple(s, Samples::viewer_x, Samples::viewer_y, Samples::viewer_z, i);
    irradiance[k] = static_cast<float>(model.irradiance(light, at, n));
    if (glossy == nullptr) continue;
    const float weight = s.channel(Samples::specular)[i];
    glossy[k] = weight <= 0 ? 0
                            : weight * static_cast<float>(model.specular(
                                           light, at, n, v, s.channel(Samples::shininess)[i]));
  }
}
}  // namespace

void shade(const Samples& samples, const twin::Light& light, std::size_t tile, float* irradiance,
           float* glossy, Shading shading, const float* visible) {
  using Kind = studio::Optic::Kind;
  switch (light.kind) {
    case Kind::point:
    case Kind::spot:
    case Kind::directional:
      return shade_small(samples, light, tile, irradiance, glossy);
    case Kind::rectangle:
    case Kind::disk:
      if (shading == Shading::exact ||
          !shade_face_quickly(samples, light, tile, visible, irradiance, glossy))
        shade_face(samples, light, tile, irradiance, glossy);
      return;
  }
  shade_by_formula(samples, light, tile, irradiance, glossy);
}

void for_each_target(void (*f)(void* context), void* context) {
  const auto choose = [](std::int64_t targets) {
    hwy::SetSupportedTargetsForTest(targets);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  };
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    choose(target);
    f(context);
  }
  choose(0);
}

}  // namespace chiaro::render::kernels
