// SPDX-License-Identifier: Apache-2.0
// Vector arithmetic that Highway lacks or makes too precise for light: a few 1e-7 relative, a few
// instructions. Included once per instruction set.
#if defined(CHIARO_RENDER_VECTOR_MATH) == defined(HWY_TARGET_TOGGLE)
#ifdef CHIARO_RENDER_VECTOR_MATH
#undef CHIARO_RENDER_VECTOR_MATH
#else
#define CHIARO_RENDER_VECTOR_MATH
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace chiaro::render::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Capped: tiles and visibility bits are laid out in sixteens.
using D = hn::CappedTag<float, 16>;
using V = hn::VFromD<D>;
using M = decltype(hn::Eq(hn::Zero(D()), hn::Zero(D())));

HWY_INLINE V set(float v) { return hn::Set(D(), v); }
HWY_INLINE V zero() { return hn::Zero(D()); }

struct Vec {
  V x, y, z;
};
HWY_INLINE V dot(Vec a, Vec b) {
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}
HWY_INLINE Vec minus(Vec a, Vec b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
HWY_INLINE Vec scaled_sum(Vec a, V k, Vec b) {
  return {hn::MulAdd(k, b.x, a.x), hn::MulAdd(k, b.y, a.y), hn::MulAdd(k, b.z, a.z)};
}

/// 1 / sqrt(v) for v > 0.
HWY_INLINE V inverse_root(V v) {
  const V half = hn::Mul(set(0.5f), v);
  V r = hn::ApproximateReciprocalSqrt(v);
#if HWY_ARCH_ARM
  r = hn::Mul(r, hn::NegMulAdd(hn::Mul(half, r), r, set(1.5f)));
  r = hn::Mul(r, hn::NegMulAdd(hn::Mul(half, r), r, set(1.5f)));
#endif
  return hn::Mul(r, hn::NegMulAdd(hn::Mul(half, r), r, set(1.5f)));
}

/// acos(x) / sqrt(1 - x^2) for -1 < x <= 1: angle over sine, what Lambert's formula asks of an edge.
/// A Chebyshev fit on 0..1 (error 1.4e-7), reflected below 0.
HWY_INLINE V angle_over_sine(V x) {
  const V y = hn::Min(hn::Abs(x), set(1));
  V p = set(0.01765366829931736f);
  p = hn::MulAdd(p, y, set(-0.0979687049984932f));
  p = hn::MulAdd(p, y, set(0.2532384693622589f));
  p = hn::MulAdd(p, y, set(-0.4245661795139313f));
  p = hn::MulAdd(p, y, set(0.5570220351219177f));
  p = hn::MulAdd(p, y, set(-0.6610894799232483f));
  p = hn::MulAdd(p, y, set(0.7848962545394897f));
  p = hn::MulAdd(p, y, set(-0.9999822378158569f));
  p = hn::MulAdd(p, y, set(1.570796251296997f));
  const M obtuse = hn::Lt(x, zero());
  if (hn::AllFalse(D(), obtuse)) return p;
  const V square_sine = hn::Max(hn::NegMulAdd(y, y, set(1)), set(1e-7f));
  const V reflected = hn::MulSub(set(3.14159265f), inverse_root(square_sine), p);
  return hn::IfThenElse(obtuse, reflected, p);
}
/// acos for |x| <= 1.
HWY_INLINE V arc_cosine(V x) {
  const V square_sine = hn::Max(hn::NegMulAdd(x, x, set(1)), set(1e-7f));
  return hn::Mul(angle_over_sine(x), hn::Sqrt(square_sine));
}

/// x^k for x >= 0 (0 gives 0), by exp2(k log2 x). Relative error about 2e-7 (1 + k |log2 x|).
HWY_INLINE V power(V x, V k) {
  const hn::RebindToSigned<D> di;
  const M dark = hn::Lt(x, set(1e-30f));
  const auto bits = hn::BitCast(di, hn::Max(x, set(1e-30f)));
  const auto exponent = hn::ShiftRight<23>(hn::Sub(bits, hn::Set(di, 0x3f3504f3)));
  const V m = hn::BitCast(D(), hn::Sub(bits, hn::ShiftLeft<23>(exponent)));
  const V t = hn::Sub(m, set(1));  // mantissa about 1: -0.29 .. 0.41
  V p = set(7.0376836292e-2f);
  p = hn::MulAdd(p, t, set(-1.1514610310e-1f));
  p = hn::MulAdd(p, t, set(1.1676998740e-1f));
  p = hn::MulAdd(p, t, set(-1.2420140846e-1f));
  p = hn::MulAdd(p, t, set(1.4249322787e-1f));
  p = hn::MulAdd(p, t, set(-1.6668057665e-1f));
  p = hn::MulAdd(p, t, set(2.0000714765e-1f));
  p = hn::MulAdd(p, t, set(-2.4999993993e-1f));
  p = hn::MulAdd(p, t, set(3.3333331174e-1f));
  p = hn::MulAdd(p, t, set(-0.5f));
  const V ln = hn::MulAdd(hn::Mul(t, t), p, t);
  const V log2 = hn::MulAdd(ln, set(1.44269504f), hn::ConvertTo(D(), exponent));
  const V y = hn::Max(hn::Mul(k, log2), set(-120));
  const V whole = hn::Round(y);
  const V f = hn::Sub(y, whole);
  V e = set(1.535336188319500e-4f);
  e = hn::MulAdd(e, f, set(1.339887440266574e-3f));
  e = hn::MulAdd(e, f, set(9.618437357674640e-3f));
  e = hn::MulAdd(e, f, set(5.550332471162809e-2f));
  e = hn::MulAdd(e, f, set(2.402264791363012e-1f));
  e = hn::MulAdd(e, f, set(6.931472028550421e-1f));
  e = hn::MulAdd(e, f, set(1));
  const auto scale = hn::ShiftLeft<23>(hn::Add(hn::ConvertTo(di, whole), hn::Set(di, 127)));
  return hn::IfThenZeroElse(dark, hn::Mul(e, hn::BitCast(D(), scale)));
}

}  // namespace chiaro::render::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
