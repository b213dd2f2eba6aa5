// SPDX-License-Identifier: Apache-2.0
// Small and parallel sources: one direction per sample.
#include <algorithm>

#include "controller/render/kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "controller/render/point_kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target: both are read once per instruction set.
#include <hwy/highway.h>

#include "controller/render/shading-inl.h"

HWY_BEFORE_NAMESPACE();
namespace chiaro::render::kernels::HWY_NAMESPACE {

/// Point, spot and parallel light: one direction per sample. `E_perp` and the direction come from
/// `arrive`, the rest is common.
template <class Arrive>
HWY_INLINE void shade_single(const Samples& samples, std::size_t tile, const Arrive& arrive,
                             float* irradiance, float* glossy) {
  for (std::size_t i = 0; i < kTile; i += lanes()) {
    const Group group{samples, tile * kTile + i};
    const Vec n = group.normal();
    Vec l;
    const V lux = arrive(group.position(), l);
    const V nl = dot(n, l);
    hn::Store(hn::Mul(lux, hn::Max(nl, zero())), D(), irradiance + i);
    if (glossy == nullptr) continue;
    const V weight = group.load(Samples::specular);
    if (hn::AllFalse(D(), hn::Gt(weight, zero()))) {
      hn::Store(zero(), D(), glossy + i);
      continue;
    }
    const Vec v = group.viewer();
    const V half_shininess = hn::Mul(set(0.5f), group.load(Samples::shininess));
    const V lobe = highlight(nl, dot(n, v), dot(l, v), half_shininess);
    hn::Store(hn::Mul(hn::Mul(lux, weight), lobe), D(), glossy + i);
  }
}

HWY_INLINE void shade_point(const Samples& s, const twin::Light& light, std::size_t tile,
                            float* irradiance, float* glossy) {
  const Vec source = broadcast(light.position);
  const V candela = set(static_cast<float>(light.candela));
  const auto law = light.attenuation;
  shade_single(
      s, tile,
      [&](Vec at, Vec& l) HWY_ATTR {
        const V inverse = towards(source, at, l);
        return hn::Mul(candela, faded(law, inverse));
      },
      irradiance, glossy);
}

HWY_INLINE void shade_spot(const Samples& s, const twin::Light& light, std::size_t tile,
                           float* irradiance, float* glossy) {
  const Vec source = broadcast(light.position), axis = broadcast(light.direction);
  const V candela = set(static_cast<float>(light.candela));
  const V outer = set(static_cast<float>(light.cos_field));
  // A hard edge is a very steep soft one.
  const V slope = set(static_cast<float>(1 / std::max(light.cos_beam - light.cos_field, 1e-6)));
  const auto law = light.attenuation;
  shade_single(
      s, tile,
      [&](Vec at, Vec& l) HWY_ATTR {
        const V inverse = towards(source, at, l);
        const V cosine = hn::Neg(dot(axis, l));
        const V t = hn::Min(hn::Max(hn::Mul(hn::Sub(cosine, outer), slope), zero()), set(1));
        const V soft = hn::Mul(hn::Mul(t, t), hn::NegMulAdd(set(2), t, set(3)));
        return hn::Mul(hn::Mul(candela, soft), faded(law, inverse));
      },
      irradiance, glossy);
}

HWY_INLINE void shade_directional(const Samples& s, const twin::Light& light, std::size_t tile,
                                  float* irradiance, float* glossy) {
  const Vec l0 = broadcast(-light.direction);
  const V lux = set(static_cast<float>(light.candela));
  shade_single(
      s, tile,
      [&](Vec, Vec& l) HWY_ATTR {
        l = l0;
        return lux;
      },
      irradiance, glossy);
}

void ShadeSmall(const Samples& s, const twin::Light& light, std::size_t tile, float* irradiance,
                float* glossy) {
  using Kind = studio::Optic::Kind;
  if (light.kind == Kind::point) shade_point(s, light, tile, irradiance, glossy);
  if (light.kind == Kind::spot) shade_spot(s, light, tile, irradiance, glossy);
  if (light.kind == Kind::directional) shade_directional(s, light, tile, irradiance, glossy);
}

}  // namespace chiaro::render::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace chiaro::render::kernels {

HWY_EXPORT(ShadeSmall);

void shade_small(const Samples& samples, const twin::Light& light, std::size_t tile,
                 float* irradiance, float* glossy) {
  HWY_DYNAMIC_DISPATCH(ShadeSmall)(samples, light, tile, irradiance, glossy);
}

}  // namespace chiaro::render::kernels
#endif
