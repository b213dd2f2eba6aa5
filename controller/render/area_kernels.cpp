// SPDX-License-Identifier: Apache-2.0
// Rectangles and disks, by the closed forms of twin/lights.
#include <algorithm>
#include <cmath>

#include "controller/render/kernels.h"
#include "controller/twin/lights/light_model.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "controller/render/area_kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target: both are read once per instruction set.
#include <hwy/highway.h>

#include "controller/render/shading-inl.h"

HWY_BEFORE_NAMESPACE();
namespace chiaro::render::kernels::HWY_NAMESPACE {

/// The points of a flat face that stand for it in highlights (twin::face_points), ready for use.
struct FacePoints {
  float x[9], y[9], z[9], candela[9];
  std::size_t count;

  FacePoints(const twin::Light& light, std::span<const twin::FacePoint> points, double half_right,
             double half_up)
      : count(points.size()) {
    for (std::size_t k = 0; k < count; ++k) {
      const core::Vec3 at = light.position + points[k].x * half_right * light.right +
                            points[k].y * half_up * light.up;
      x[k] = static_cast<float>(at.x), y[k] = static_cast<float>(at.y);
      z[k] = static_cast<float>(at.z);
      candela[k] = static_cast<float>(points[k].weight * light.candela);
    }
  }
};

HWY_INLINE V face_lobe(const Group& group, const FacePoints& points, Vec axis,
                       studio::Optic::Attenuation law) {
  const Vec at = group.position(), n = group.normal(), v = group.viewer();
  const V nv = dot(n, v), half_shininess = hn::Mul(set(0.5f), group.load(Samples::shininess));
  V sum = zero();
  for (std::size_t k = 0; k < points.count; ++k) {
    Vec l;
    const V inverse = towards({set(points.x[k]), set(points.y[k]), set(points.z[k])}, at, l);
    const V leaving = hn::Max(hn::Neg(dot(axis, l)), zero());
    const V lux = hn::Mul(hn::Mul(set(points.candela[k]), leaving), faded(law, inverse));
    sum = hn::MulAdd(lux, highlight(dot(n, l), nv, dot(l, v), half_shininess), sum);
  }
  return sum;
}

/// A tile's highlights of a flat face.
HWY_INLINE void gloss_of_face(const Samples& samples, std::size_t tile, const twin::Light& light,
                              const FacePoints& few, const FacePoints& many, float* out) {
  const Vec axis = broadcast(light.direction);
  for (std::size_t i = 0; i < kTile; i += lanes()) {
    const Group group{samples, tile * kTile + i};
    const V weight = group.load(Samples::specular);
    V lobe = zero();
    if (!hn::AllFalse(D(), hn::Gt(weight, zero()))) {
      const M broad =
          hn::Le(group.load(Samples::shininess), set(static_cast<float>(twin::kFewPointsUpTo)));
      if (!hn::AllFalse(D(), broad)) lobe = face_lobe(group, few, axis, light.attenuation);
      if (!hn::AllTrue(D(), broad))
        lobe = hn::IfThenElse(broad, lobe, face_lobe(group, many, axis, light.attenuation));
    }
    hn::Store(hn::Mul(weight, lobe), D(), out + i);
  }
}

/// Lambert's formula over the whole rectangle. x0..y1: the edges as the sample sees them; h its
/// distance from the face's plane; n the normal in the plate's axes. Not cut at the horizon.
struct Seen {
  V x0, x1, y0, y1, h;
};
HWY_INLINE V whole_plate(const Seen& s, Vec n) {
  const V xx0 = hn::Mul(s.x0, s.x0), xx1 = hn::Mul(s.x1, s.x1);
  const V yy0 = hn::MulAdd(s.y0, s.y0, hn::Mul(s.h, s.h));
  const V yy1 = hn::MulAdd(s.y1, s.y1, hn::Mul(s.h, s.h));
  const V i00 = inverse_root(hn::Add(xx0, yy0)), i10 = inverse_root(hn::Add(xx1, yy0));
  const V i11 = inverse_root(hn::Add(xx1, yy1)), i01 = inverse_root(hn::Add(xx0, yy1));
  const V width = hn::Sub(s.x1, s.x0), height = hn::Sub(s.y1, s.y0);
  const V hh = hn::Mul(s.h, s.h), x01 = hn::Mul(s.x0, s.x1);
  const V y01 = hn::MulAdd(s.y0, s.y1, hh);
  const auto edge = [](V cosine_over, V a, V b) HWY_ATTR {
    const V both = hn::Mul(a, b);
    return hn::Mul(both, angle_over_sine(hn::Mul(cosine_over, both)));
  };
  const V bottom = hn::Mul(width, edge(hn::Add(x01, yy0), i00, i10));
  const V top = hn::Mul(width, edge(hn::Add(x01, yy1), i01, i11));
  const V right = hn::Mul(height, edge(hn::Add(xx1, y01), i10, i11));
  const V left = hn::Mul(height, edge(hn::Add(xx0, y01), i00, i01));
  const V fx = hn::Mul(s.h, hn::Sub(left, right)), fy = hn::Mul(s.h, hn::Sub(bottom, top));
  const V fz = hn::Add(hn::MulSub(s.y1, top, hn::Mul(s.y0, bottom)),
                       hn::MulSub(s.x1, right, hn::Mul(s.x0, left)));
  return dot(n, {fx, fy, fz});
}

/// One edge of a polygon whose corners are anywhere; zero-length corners give zero.
HWY_INLINE V any_edge(Vec a, Vec b, Vec n) {
  const V tiny = set(1e-12f);
  const V both =
      hn::Mul(inverse_root(hn::Max(dot(a, a), tiny)), inverse_root(hn::Max(dot(b, b), tiny)));
  const V cosine = hn::Min(hn::Max(hn::Mul(dot(a, b), both), set(-1)), set(1));
  const Vec across{hn::MulSub(a.y, b.z, hn::Mul(a.z, b.y)), hn::MulSub(a.z, b.x, hn::Mul(a.x, b.z)),
                   hn::MulSub(a.x, b.y, hn::Mul(a.y, b.x))};
  return hn::Mul(hn::Mul(dot(across, n), both), angle_over_sine(cosine));
}

HWY_INLINE Vec choose(M m, Vec a, Vec b) {
  return {hn::IfThenElse(m, a.x, b.x), hn::IfThenElse(m, a.y, b.y), hn::IfThenElse(m, a.z, b.z)};
}

/// The same, cut at the surface's horizon: each edge keeps its part above, and one more edge along
/// the horizon closes the polygon from where it was left to where it is entered again.
HWY_INLINE V cut_plate(const Seen& s, Vec n) {
  const Vec corners[4] = {
      {s.x0, s.y0, s.h}, {s.x1, s.y0, s.h}, {s.x1, s.y1, s.h}, {s.x0, s.y1, s.h}};
  const Vec none{zero(), zero(), zero()};
  Vec left = none, entered = none;
  V sum = zero();
  for (int k = 0; k < 4; ++k) {
    const Vec a = corners[k], b = corners[(k + 1) % 4];
    const V za = dot(n, a), zb = dot(n, b);
    const M a_up = hn::Ge(za, zero()), b_up = hn::Ge(zb, zero());
    const V gap = hn::Sub(za, zb);
    const V safe = hn::IfThenElse(hn::Lt(hn::Abs(gap), set(1e-20f)), set(1e-20f), gap);
    const Vec crossing = scaled_sum(a, hn::Div(za, safe), minus(b, a));
    const Vec from = choose(a_up, a, crossing), to = choose(b_up, b, crossing);
    const M some = hn::Or(a_up, b_up);
    sum = hn::Add(sum, hn::IfThenElseZero(some, any_edge(from, to, n)));
    left = choose(hn::AndNot(b_up, a_up), crossing, left);
    entered = choose(hn::AndNot(a_up, b_up), crossing, entered);
  }
  return hn::Add(sum, any_edge(left, entered, n));
}

HWY_INLINE void shade_rectangle(const Samples& samples, const twin::Light& light, std::size_t tile,
                                float* irradiance, float* glossy) {
  const double luminance = light.candela / std::max(light.width * light.height, 1e-9);
  const Vec centre = broadcast(light.position), right = broadcast(light.right),
            up = broadcast(light.up), ahead = broadcast(light.direction);
  const V half_width = set(static_cast<float>(0.5 * light.width));
  const V half_height = set(static_cast<float>(0.5 * light.height));
  const V half_luminance = set(static_cast<float>(0.5 * luminance));
  for (std::size_t i = 0; i < kTile; i += lanes()) {
    const Group group{samples, tile * kTile + i};
    const Vec to = minus(centre, group.position()), normal = group.normal();
    const V x = dot(to, right), y = dot(to, up), h = dot(to, ahead);
    const Seen seen{hn::Sub(x, half_width), hn::Add(x, half_width), hn::Sub(y, half_height),
                    hn::Add(y, half_height), h};
    const Vec n{dot(normal, right), dot(normal, up), dot(normal, ahead)};
    // Highest and lowest corner over the surface.
    const V middle = dot(n, {x, y, h});
    const V reach = hn::MulAdd(hn::Abs(n.x), half_width, hn::Mul(hn::Abs(n.y), half_height));
    const M dark = hn::Or(hn::Ge(h, zero()), hn::Le(hn::Add(middle, reach), zero()));
    V lux = zero();
    if (!hn::AllTrue(D(), dark)) {
      const M cut = hn::Lt(middle, reach);
      V sum = hn::AllTrue(D(), hn::Or(cut, dark)) ? zero() : whole_plate(seen, n);
      const M needs_cut = hn::AndNot(dark, cut);
      if (!hn::AllFalse(D(), needs_cut)) sum = hn::IfThenElse(needs_cut, cut_plate(seen, n), sum);
      lux = hn::IfThenZeroElse(dark, hn::Mul(half_luminance, hn::Abs(sum)));
      if (light.attenuation != studio::Optic::Attenuation::inverse_square) {
        const V square = hn::Max(dot(to, to), set(1e-12f));
        lux = hn::Mul(hn::Mul(lux, square), faded(light.attenuation, inverse_root(square)));
      }
    }
    hn::Store(lux, D(), irradiance + i);
  }
  if (glossy == nullptr) return;
  const double w = 0.5 * light.width, h = 0.5 * light.height;
  gloss_of_face(samples, tile, light, FacePoints(light, twin::face_points(1), w, h),
                FacePoints(light, twin::face_points(1e3), w, h), glossy);
}

/// As in twin/lights/disk.cpp.
HWY_INLINE V capped(V f, V cosine) {
  const V whole = hn::Mul(f, hn::Max(cosine, zero()));
  const M cut = hn::Lt(hn::Mul(cosine, cosine), f);
  if (hn::AllFalse(D(), cut)) return whole;
  const V sine = hn::Sqrt(hn::Max(hn::NegMulAdd(cosine, cosine, set(1)), set(1e-12f)));
  const V x = hn::Sqrt(hn::Max(hn::Sub(hn::Div(set(1), hn::Max(f, set(1e-12f))), set(1)), zero()));
  const V y = hn::Min(hn::Max(hn::Neg(hn::Div(hn::Mul(x, cosine), sine)), set(-1)), set(1));
  const V z = hn::Mul(sine, hn::Sqrt(hn::Max(hn::NegMulAdd(y, y, set(1)), zero())));
  const V size = inverse_root(hn::Max(hn::MulAdd(x, x, hn::Mul(z, z)), set(1e-12f)));
  const V atan =
      hn::Mul(acute_angle_over_sine(hn::Min(hn::Mul(x, size), set(1))), hn::Mul(z, size));
  const V part = hn::MulAdd(hn::MulSub(cosine, arc_cosine(y), hn::Mul(x, z)), f, atan);
  const V some = hn::Mul(hn::Max(part, zero()), set(static_cast<float>(1 / core::kPi)));
  return hn::IfThenElse(cut, some, whole);
}

HWY_INLINE void shade_disk(const Samples& samples, const twin::Light& light, std::size_t tile,
                           float* irradiance, float* glossy) {
  const Vec centre = broadcast(light.position), ahead = broadcast(light.direction);
  const V rr = set(static_cast<float>(light.radius * light.radius));
  // pi x luminance = candela / radius^2
  const V scale =
      set(static_cast<float>(light.candela / std::max(light.radius * light.radius, 1e-9)));
  for (std::size_t i = 0; i < kTile; i += lanes()) {
    const Group group{samples, tile * kTile + i};
    const Vec from = minus(group.position(), centre), n = group.normal();
    const V h = dot(from, ahead);
    const Vec aside = scaled_sum(from, hn::Neg(h), ahead);
    const V dd = dot(aside, aside), hh = hn::Mul(h, h);
    const V q = hn::Add(hn::Add(hh, dd), rr), off = hn::Sub(hn::Add(hh, dd), rr);
    // (q^2 - 4 rr dd) without its cancellation: off^2 + 4 rr hh
    const V s =
        hn::Sqrt(hn::Max(hn::MulAdd(off, off, hn::Mul(set(4), hn::Mul(rr, hh))), set(1e-20f)));
    const V axial_far = hn::Div(hn::Mul(set(2), hn::Mul(rr, hh)),
                                hn::Mul(s, hn::Max(hn::Add(s, off), set(1e-12f))));
    const V axial_near = hn::Mul(set(0.5f), hn::Sub(set(1), hn::Div(off, s)));
    const V axial = hn::IfThenElse(hn::Gt(off, zero()), axial_far, axial_near);
    const V radial = hn::Div(hn::Mul(set(2), hn::Mul(h, rr)), hn::Mul(s, hn::Add(q, s)));
    const Vec vector{hn::NegMulSub(axial, ahead.x, hn::Mul(radial, aside.x)),
                     hn::NegMulSub(axial, ahead.y, hn::Mul(radial, aside.y)),
                     hn::NegMulSub(axial, ahead.z, hn::Mul(radial, aside.z))};
    const V square = hn::Max(dot(vector, vector), set(1e-24f));
    const V inverse = inverse_root(square);
    const V f = hn::Min(hn::Mul(square, inverse), set(1));
    V lux = hn::Mul(scale, capped(f, hn::Min(hn::Mul(dot(vector, n), inverse), set(1))));
    if (light.attenuation != studio::Optic::Attenuation::inverse_square) {
      const V far = hn::Max(dot(from, from), set(1e-12f));
      lux = hn::Mul(hn::Mul(lux, far), faded(light.attenuation, inverse_root(far)));
    }
    hn::Store(hn::IfThenElseZero(hn::Gt(h, zero()), lux), D(), irradiance + i);
  }
  if (glossy == nullptr) return;
  const double r = light.radius;
  gloss_of_face(samples, tile, light, FacePoints(light, twin::disk_points(1), r, r),
                FacePoints(light, twin::disk_points(1e3), r, r), glossy);
}

void ShadeFace(const Samples& s, const twin::Light& light, std::size_t tile, float* irradiance,
               float* glossy) {
  if (light.kind == studio::Optic::Kind::rectangle)
    shade_rectangle(s, light, tile, irradiance, glossy);
  else
    shade_disk(s, light, tile, irradiance, glossy);
}

}  // namespace chiaro::render::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace chiaro::render::kernels {

HWY_EXPORT(ShadeFace);

void shade_face(const Samples& samples, const twin::Light& light, std::size_t tile,
                float* irradiance, float* glossy) {
  HWY_DYNAMIC_DISPATCH(ShadeFace)(samples, light, tile, irradiance, glossy);
}

}  // namespace chiaro::render::kernels
#endif
