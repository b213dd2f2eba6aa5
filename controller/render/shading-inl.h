// SPDX-License-Identifier: Apache-2.0
// What the light kernels share: how they read samples, fade with distance and see a highlight.
// Included once per instruction set.
#if defined(CHIARO_RENDER_SHADING) == defined(HWY_TARGET_TOGGLE)
#ifdef CHIARO_RENDER_SHADING
#undef CHIARO_RENDER_SHADING
#else
#define CHIARO_RENDER_SHADING
#endif

#include <hwy/highway.h>

#include "controller/render/samples.h"
#include "controller/render/vector_math-inl.h"
#include "controller/twin/scene.h"

HWY_BEFORE_NAMESPACE();
namespace chiaro::render::kernels::HWY_NAMESPACE {

HWY_INLINE std::size_t lanes() { return hn::Lanes(D()); }
HWY_INLINE Vec broadcast(core::Vec3 v) {
  return {set(static_cast<float>(v.x)), set(static_cast<float>(v.y)), set(static_cast<float>(v.z))};
}

/// What a light kernel reads of sixteen samples.
struct Group {
  const Samples& samples;
  std::size_t at;
  HWY_INLINE V load(Samples::Channel c) const { return hn::Load(D(), samples.channel(c) + at); }
  HWY_INLINE Vec position() const {
    return {load(Samples::position_x), load(Samples::position_y), load(Samples::position_z)};
  }
  HWY_INLINE Vec normal() const {
    return {load(Samples::normal_x), load(Samples::normal_y), load(Samples::normal_z)};
  }
  HWY_INLINE Vec viewer() const {
    return {load(Samples::viewer_x), load(Samples::viewer_y), load(Samples::viewer_z)};
  }
};

/// Factor of the light's law at distance 1 / inverse.
HWY_INLINE V faded(studio::Optic::Attenuation law, V inverse) {
  if (law == studio::Optic::Attenuation::inverse_square) return hn::Mul(inverse, inverse);
  return law == studio::Optic::Attenuation::linear ? inverse : set(1);
}

/// (N.H)^s where N.L > 0. `nl`, `nv`, `lv`: cosines of unit directions.
HWY_INLINE V highlight(V nl, V nv, V lv, V half_shininess) {
  const V nh = hn::Max(hn::Add(nl, nv), zero());
  const V hh = hn::Max(hn::MulAdd(set(2), lv, set(2)), set(1e-12f));
  const V square = hn::Min(hn::Div(hn::Mul(nh, nh), hh), set(1));
  return hn::IfThenElseZero(hn::Gt(nl, zero()), power(square, half_shininess));
}

/// Unit direction to a small source and its inverse distance.
HWY_INLINE V towards(Vec source, Vec at, Vec& l) {
  constexpr float kMost = static_cast<float>(1 / twin::kNearestLight);
  const Vec to = minus(source, at);
  const V square = dot(to, to);
  const V inverse = inverse_root(hn::Max(square, set(1e-12f)));
  l = {hn::Mul(to.x, inverse), hn::Mul(to.y, inverse), hn::Mul(to.z, inverse)};
  return hn::Min(inverse, set(kMost));
}

}  // namespace chiaro::render::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
