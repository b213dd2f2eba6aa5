// SPDX-License-Identifier: Apache-2.0
// Rectangles and disks for a search: one direction per sample, to the face's middle, and what the
// face's extent changes by its moments. The irradiance is an expansion to the fourth order of
// h (n.v) / |v|^4 over the face, cut at the horizon as an evenly spread face would be. The
// highlight is the lobe at the middle times the mean of exp over the face, to the fourth order in
// the cumulants of its logarithm. At 256 x 256 a rectangle's layer takes 130 us where the
// closed forms take 320, a disk's 112 where they take 250.
#include <algorithm>
#include <cmath>

#include "controller/render/kernels.h"
#include "controller/twin/lights/light_model.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "controller/render/quick_kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target: both are read once per instruction set.
#include <hwy/highway.h>

#include "controller/render/shading-inl.h"

HWY_BEFORE_NAMESPACE();
namespace chiaro::render::kernels::HWY_NAMESPACE {

/// The expansion holds while half the face's longer side is below this share of its distance; its
/// second order alone while below that one (to 0.15 %).
constexpr double kNarrow = 0.4, kDistant = 0.22;

/// Three samples stand for a line of sixteen where the lamp is this many lengths of it away.
constexpr float kLengths = 5;
/// A lobe whose middle is below 2 to this gives nothing that shows, its face spread out or not.
constexpr float kUnseen = -16;

/// What is the same for all samples. Per axis: half sides of the rectangle with the face's second
/// moments, those moments, and the fourth ones in units of their products.
struct Face {
  Vec centre, right, up, ahead;
  V half_x, half_y, moment_x, moment_y, fourth, mixed, candela, nearest, distant;
  V falls;  ///< minus the power of the distance with which a slanting face's light fades
  studio::Optic::Attenuation law;

  explicit Face(const twin::Light& light)
      : centre(broadcast(light.position)),
        right(broadcast(light.right)),
        up(broadcast(light.up)),
        ahead(broadcast(light.direction)),
        candela(set(static_cast<float>(light.candela))),
        law(light.attenuation) {
    using Law = studio::Optic::Attenuation;
    falls = set(law == Law::inverse_square ? 3.0f : law == Law::linear ? 2.0f : 1.0f);
    const bool disk = light.kind == studio::Optic::Kind::disk;
    const double across = std::sqrt(3.0) / 2 * light.radius;
    const double x = disk ? across : 0.5 * light.width, y = disk ? across : 0.5 * light.height;
    half_x = set(static_cast<float>(x)), half_y = set(static_cast<float>(y));
    moment_x = set(static_cast<float>(x * x / 3)), moment_y = set(static_cast<float>(y * y / 3));
    fourth = set(disk ? 2.0f : 1.8f), mixed = set(disk ? 2.0f / 3 : 1.0f);
    const double half = disk ? light.radius : std::max(x, y);
    nearest = set(static_cast<float>(half * half / (kNarrow * kNarrow)));
    distant = set(static_cast<float>(half * half / (kDistant * kDistant)));
  }
};

/// The face as a sample sees it. `x`, `y`: the way to its middle along its axes; `h`: how far the
/// sample lies before its plane; `m`: that way on the normal; `nx`, `ny`: the normal on its axes.
struct Sight {
  Vec to, normal;
  V square, inverse, h, m, x, y, nx, ny;

  HWY_INLINE Sight(const Face& face, Vec position, Vec its_normal)
      : to(minus(face.centre, position)), normal(its_normal) {
    square = hn::Max(dot(to, to), set(1e-6f));
    inverse = inverse_root(square);
    h = hn::Neg(dot(to, face.ahead));
    m = dot(normal, to);
    x = dot(to, face.right), y = dot(to, face.up);
    nx = dot(normal, face.right), ny = dot(normal, face.up);
  }
};

/// Of a linear function over the face, (D / |v|^2)^2 times it: the mean, and by what the function's
/// own mean enters it.
struct Mean {
  V value, weight;
};
/// (m + nx x + ny y), nowhere cut, to the second order.
HWY_INLINE Mean distant_mean(const Face& face, const Sight& s) {
  const V per = hn::Mul(s.inverse, s.inverse);
  const V a = hn::Mul(face.moment_x, per), b = hn::Mul(face.moment_y, per);
  const V ax = hn::Mul(a, s.x), by = hn::Mul(b, s.y);
  const V slant = hn::Mul(per, hn::MulAdd(ax, s.x, hn::Mul(by, s.y)));
  const V weight = hn::MulAdd(set(12), slant, hn::NegMulAdd(set(2), hn::Add(a, b), set(1)));
  const V aside = hn::MulAdd(s.nx, ax, hn::Mul(s.ny, by));
  return {hn::NegMulAdd(set(4), aside, hn::Mul(s.m, weight)), weight};
}
/// To the fourth.
HWY_INLINE Mean near_mean(const Face& face, const Sight& s) {
  const V per = hn::Mul(s.inverse, s.inverse);
  const V a = hn::Mul(face.moment_x, per), b = hn::Mul(face.moment_y, per);
  const V aa = hn::Mul(face.fourth, hn::Mul(a, a)), bb = hn::Mul(face.fourth, hn::Mul(b, b));
  const V ab = hn::Mul(face.mixed, hn::Mul(a, b));
  const V tx = hn::Mul(hn::Mul(s.x, s.x), per), ty = hn::Mul(hn::Mul(s.y, s.y), per);
  const V axb = hn::Add(aa, ab), bxa = hn::Add(bb, ab);
  const auto along = [](V one, V two, V cross, V t) HWY_ATTR {
    const V bend = hn::MulSub(set(80), hn::Mul(two, t), hn::Mul(set(48), cross));
    return hn::Mul(t, hn::MulAdd(set(12), one, bend));
  };
  V weight = hn::MulAdd(set(3), hn::Add(axb, bxa), hn::NegMulAdd(set(2), hn::Add(a, b), set(1)));
  weight = hn::Add(weight, hn::Add(along(a, aa, axb, tx), along(b, bb, bxa, ty)));
  weight = hn::MulAdd(hn::Mul(set(480), ab), hn::Mul(tx, ty), weight);
  const auto slope = [](V one, V two, V cross, V mixed, V t, V other) HWY_ATTR {
    const V bend = hn::MulAdd(set(3), hn::Mul(mixed, other), hn::Mul(two, t));
    return hn::NegMulAdd(set(32), bend, hn::MulSub(set(12), cross, hn::Mul(set(4), one)));
  };
  const V aside = hn::MulAdd(hn::Mul(s.nx, s.x), slope(a, aa, axb, ab, tx, ty),
                             hn::Mul(hn::Mul(s.ny, s.y), slope(b, bb, bxa, ab, ty, tx)));
  return {hn::MulAdd(s.m, weight, aside), weight};
}

/// What is above the surface's horizon: the mean of max(0, m + x + y) over |x| <= p, |y| <= q, and
/// the share of that rectangle where it is above 0.
struct Above {
  V mean, share;
};
HWY_INLINE Above above_horizon(V m, V p, V q) {
  const V wide = hn::Max(hn::Max(p, q), set(1e-6f));
  // A narrow side only blurs: widening it a little keeps the differences from cancelling.
  const V thin = hn::Max(hn::Min(p, q), hn::Mul(set(0.03f), wide));
  const V reach = hn::Add(wide, thin);
  Above out{hn::Max(m, zero()), hn::IfThenElseZero(hn::Gt(m, zero()), set(1))};
  const M cut = hn::Lt(hn::Abs(m), reach);
  if (hn::AllFalse(D(), cut)) return out;
  const V gap = hn::Sub(wide, thin);
  const V far = hn::Max(hn::Add(m, reach), zero()), near = hn::Max(hn::Sub(m, reach), zero());
  const V more = hn::Max(hn::Add(m, gap), zero()), less = hn::Max(hn::Sub(m, gap), zero());
  const V area = hn::Div(set(1.0f / 8), hn::Mul(wide, thin));
  const V f2 = hn::Mul(far, far), n2 = hn::Mul(near, near), m2 = hn::Mul(more, more),
          l2 = hn::Mul(less, less);
  const V squares = hn::Sub(hn::Add(f2, n2), hn::Add(m2, l2));
  const V cubes =
      hn::Sub(hn::MulAdd(f2, far, hn::Mul(n2, near)), hn::MulAdd(m2, more, hn::Mul(l2, less)));
  const V third = hn::Mul(area, set(1.0f / 3));
  out.mean = hn::IfThenElse(cut, hn::Max(hn::Mul(cubes, third), zero()), out.mean);
  out.share =
      hn::IfThenElse(cut, hn::Min(hn::Max(hn::Mul(squares, area), zero()), set(1)), out.share);
  return out;
}

/// Logarithm of the mean of exp(g x + c x^2 / 2) over one axis of the face: t = -c and z = g^2,
/// both times its second moment. To the fourth order of their cumulants.
HWY_INLINE V spread(V t, V z) {
  const V tt = hn::Max(t, set(-0.5f));
  const V flank = reciprocal(hn::MulAdd(set(0.1f), z, hn::MulAdd(set(0.4f), tt, set(1))));
  const V top = hn::MulAdd(hn::MulAdd(set(0.02f), tt, set(-0.1f)), tt, set(0.5f));
  return hn::MulSub(hn::Mul(set(0.5f), z), flank, hn::Mul(tt, top));
}

/// (N.H)^s summed over the face as a share of its whole, the lamp's own fall-off over the face in
/// it.
HWY_INLINE V lobe(const Face& face, const Sight& s, const Group& group) {
  const Vec viewer = group.viewer();
  const V shininess = group.load(Samples::shininess);
  const V r = s.inverse;
  const V nl = hn::Mul(s.m, r), nv = dot(s.normal, viewer);
  const V lv = hn::Mul(dot(viewer, s.to), r);
  const V lx = hn::Mul(s.x, r), ly = hn::Mul(s.y, r);
  const V vx = dot(viewer, face.right), vy = dot(viewer, face.up);
  const V a = hn::Max(hn::Add(nl, nv), set(1e-3f)),
          b = hn::Max(hn::MulAdd(set(2), lv, set(2)), set(1e-3f));
  const V both = reciprocal(hn::Mul(a, b));
  const V by_a = hn::Mul(b, both), by_b = hn::Mul(a, both);
  const V square = hn::Min(hn::Mul(hn::Mul(a, a), by_b), set(1));
  const V middle = hn::Mul(hn::Mul(set(0.5f), shininess), log2_of(square));
  if (hn::AllTrue(D(), hn::Lt(middle, set(kUnseen)))) return zero();
  const V per = hn::Mul(r, r);
  const V turn = hn::MulSub(nl, by_a, hn::Mul(lv, by_b));
  const V steady = hn::MulAdd(shininess, turn, face.falls);
  const auto along = [&](V n, V l, V v, V moment) HWY_ATTR {
    // Derivatives of ln(N.L + N.V) and of half ln |L + V|^2, times the distance.
    const V da = hn::Mul(hn::NegMulAdd(nl, l, n), by_a);
    const V db = hn::Mul(hn::NegMulAdd(lv, l, v), by_b);
    const V slope = hn::Sub(da, db);
    const V g = hn::MulSub(shininess, slope, hn::Mul(face.falls, l));
    const V bend =
        hn::NegMulAdd(hn::Add(db, db), db, hn::MulAdd(hn::Add(l, l), slope, hn::Mul(da, da)));
    const V c = hn::MulAdd(hn::NegMulAdd(l, l, set(1)), steady, hn::Mul(shininess, bend));
    const V share = hn::Mul(moment, per);
    return spread(hn::Mul(c, share), hn::Mul(hn::Mul(g, g), share));
  };
  const V more = hn::Add(along(s.nx, lx, vx, face.moment_x), along(s.ny, ly, vy, face.moment_y));
  return exp2_or_none(hn::MulAdd(more, set(1.44269504f), middle));
}

/// Lux on a surface, and what its highlights are made of.
struct Light {
  M before, lit;  ///< before the face; and above the surface's horizon
  V lux, head_on, share;
};
HWY_INLINE Light arriving(const Face& face, const Sight& s) {
  Light out;
  out.before = hn::Gt(s.h, zero());
  const V p = hn::Mul(hn::Abs(s.nx), face.half_x), q = hn::Mul(hn::Abs(s.ny), face.half_y);
  out.lit = hn::And(out.before, hn::Gt(hn::Add(s.m, hn::Add(p, q)), zero()));
  out.lux = out.head_on = out.share = zero();
  if (hn::AllFalse(D(), out.lit)) return out;
  const bool far = hn::AllTrue(D(), hn::Gt(s.square, face.distant));
  const Mean whole = far ? distant_mean(face, s) : near_mean(face, s);
  const Above seen = above_horizon(whole.value, hn::Mul(p, whole.weight), hn::Mul(q, whole.weight));
  const V slant = hn::Mul(s.h, s.inverse);
  out.head_on = hn::IfThenElseZero(
      out.lit, hn::Mul(hn::Mul(face.candela, slant), faded(face.law, s.inverse)));
  out.lux = hn::Mul(hn::Mul(out.head_on, s.inverse), seen.mean);
  out.share = seen.share;
  return out;
}

/// Too near for the expansion.
HWY_INLINE bool too_near(const Face& face, const Sight& s) {
  return !hn::AllFalse(D(), hn::And(hn::Gt(s.h, zero()), hn::Lt(s.square, face.nearest)));
}

/// Fits a parabola through three samples of each line.
HWY_INLINE void fill_lines(const Samples::Lines& lines, const float (&node)[3][Samples::kGroups],
                           float* out) {
  HWY_ALIGN float weight[3][Samples::kGroup];
  for (std::size_t i = 0; i < Samples::kGroup; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      float w = 1;
      for (std::size_t other = 0; other < 3; ++other)
        if (other != k)
          w *=
              (static_cast<float>(i) - static_cast<float>(Samples::kNodes[other])) /
              (static_cast<float>(Samples::kNodes[k]) - static_cast<float>(Samples::kNodes[other]));
      weight[k][i] = w;
    }
  for (std::size_t i = 0; i < Samples::kGroup; i += lanes()) {
    const V a = hn::Load(D(), weight[0] + i), b = hn::Load(D(), weight[1] + i),
            c = hn::Load(D(), weight[2] + i);
    std::size_t line = 0;
    for (std::uint64_t rest = lines.groups; rest != 0; rest &= rest - 1, ++line) {
      const auto group = static_cast<std::size_t>(hwy::Num0BitsBelowLS1Bit_Nonzero64(rest));
      const V v = hn::MulAdd(a, set(node[0][line]),
                             hn::MulAdd(b, set(node[1][line]), hn::Mul(c, set(node[2][line]))));
      hn::Store(hn::Max(v, zero()), D(), out + group * Samples::kGroup + i);
    }
  }
}

/// Irradiance along the tile's lines. False where the lamp is so near that three samples of a line
/// are too few.
HWY_INLINE bool shade_lines(const Face& face, const Samples::Lines& lines, float* irradiance) {
  HWY_ALIGN float node[3][Samples::kGroups];
  const V apart = set(kLengths * kLengths * lines.longest * lines.longest);
  for (std::size_t j = 0; j < lines.count; j += lanes())
    for (std::size_t k = 0; k < 3; ++k) {
      const auto load = [&](std::size_t c) HWY_ATTR {
        return hn::Load(D(), lines.nodes + (6 * k + c) * Samples::kGroups + j);
      };
      const Sight s(face, {load(0), load(1), load(2)}, {load(3), load(4), load(5)});
      const M real = hn::FirstN(D(), lines.count - j);
      if (!hn::AllFalse(D(), hn::And(real, hn::Lt(s.square, apart)))) return false;
      hn::Store(arriving(face, s).lux, D(), node[k] + j);
    }
  fill_lines(lines, node, irradiance);
  return true;
}

bool ShadeFaceQuickly(const Samples& samples, const twin::Light& light, std::size_t tile,
                      const float* visible, float* irradiance, float* glossy) {
  const Face face(light);
  const V few = set(static_cast<float>(twin::kFewPointsUpTo));
  const Samples::Lines lines = samples.lines(tile);
  const std::uint64_t done =
      lines.count > 0 && shade_lines(face, lines, irradiance) ? lines.groups : 0;
  for (std::size_t g = 0; g < Samples::kGroups; ++g) {
    const bool line = (done >> g & 1) != 0;
    if (line && glossy == nullptr) continue;
    for (std::size_t i = g * Samples::kGroup; i < (g + 1) * Samples::kGroup; i += lanes()) {
      const bool hidden = !line && visible != nullptr &&
                          hn::AllFalse(D(), hn::Gt(hn::Load(D(), visible + i), zero()));
      if (hidden) hn::Store(zero(), D(), irradiance + i);
      if (line || hidden) {
        if (glossy != nullptr) hn::Store(zero(), D(), glossy + i);
        continue;
      }
      const Group group{samples, tile * kTile + i};
      const Sight s(face, group.position(), group.normal());
      if (too_near(face, s)) return false;
      const Light there = arriving(face, s);
      hn::Store(there.lux, D(), irradiance + i);
      if (glossy == nullptr) continue;
      const V gloss = group.load(Samples::specular);
      const M shines = hn::And(there.lit, hn::Gt(gloss, zero()));
      V shine = zero();
      if (!hn::AllFalse(D(), shines)) {
        const M sharp = hn::Gt(group.load(Samples::shininess), few);
        if (!hn::AllFalse(D(), hn::And(shines, sharp))) return false;
        shine = hn::Mul(hn::Mul(gloss, hn::Mul(there.head_on, there.share)), lobe(face, s, group));
      }
      hn::Store(shine, D(), glossy + i);
    }
  }
  return true;
}

}  // namespace chiaro::render::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace chiaro::render::kernels {

HWY_EXPORT(ShadeFaceQuickly);

bool shade_face_quickly(const Samples& samples, const twin::Light& light, std::size_t tile,
                        const float* visible, float* irradiance, float* glossy) {
  return HWY_DYNAMIC_DISPATCH(ShadeFaceQuickly)(samples, light, tile, visible, irradiance, glossy);
}

}  // namespace chiaro::render::kernels
#endif
