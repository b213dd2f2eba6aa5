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

/// Polynomials by Estrin's scheme: the pairs do not wait for each other, as Horner's steps would.
/// x2 and x4 are the powers of x. Seven coefficients or nine, from the constant upwards.
HWY_INLINE V pair(V x, float c0, float c1) { return hn::MulAdd(set(c1), x, set(c0)); }
HWY_INLINE V polynomial(V x, V x2, V x4, float c0, float c1, float c2, float c3, float c4, float c5,
                        float c6) {
  const V low = hn::MulAdd(pair(x, c2, c3), x2, pair(x, c0, c1));
  return hn::MulAdd(hn::MulAdd(set(c6), x2, pair(x, c4, c5)), x4, low);
}
HWY_INLINE V polynomial(V x, V x2, V x4, float c0, float c1, float c2, float c3, float c4, float c5,
                        float c6, float c7, float c8) {
  const V low = hn::MulAdd(pair(x, c2, c3), x2, pair(x, c0, c1));
  const V middle = hn::MulAdd(pair(x, c6, c7), x2, pair(x, c4, c5));
  return hn::MulAdd(hn::MulAdd(set(c8), x4, middle), x4, low);
}

/// acos(x) / sqrt(1 - x^2) for -1 < x <= 1: angle over sine, what Lambert's formula asks of an
/// edge. A Chebyshev fit on 0..1 (error 1.4e-7), reflected below 0.
HWY_INLINE V acute_angle_over_sine(V y) {
  const V y2 = hn::Mul(y, y);
  return polynomial(y, y2, hn::Mul(y2, y2), 1.570796251296997f, -0.9999822378158569f,
                    0.7848962545394897f, -0.6610894799232483f, 0.5570220351219177f,
                    -0.4245661795139313f, 0.2532384693622589f, -0.0979687049984932f,
                    0.01765366829931736f);
}
HWY_INLINE V angle_over_sine(V x) {
  const V y = hn::Min(hn::Abs(x), set(1));
  const V p = acute_angle_over_sine(y);
  const M obtuse = hn::Lt(x, zero());
  if (hn::AllFalse(D(), obtuse)) return p;
  const V square_sine = hn::Max(hn::NegMulAdd(y, y, set(1)), set(1e-7f));
  const V reflected = hn::MulSub(set(3.14159265f), inverse_root(square_sine), p);
  return hn::IfThenElse(obtuse, reflected, p);
}
/// acos for |x| <= 1.
HWY_INLINE V arc_cosine(V x) {
  const V y = hn::Abs(x);
  const V sine = hn::Sqrt(hn::Max(hn::Mul(hn::Sub(set(1), y), hn::Add(set(1), y)), zero()));
  const V acute = hn::Mul(acute_angle_over_sine(y), sine);
  return hn::IfThenElse(hn::Lt(x, zero()), hn::Sub(set(3.14159265f), acute), acute);
}

/// 1 / v for |v| of 1e-30 .. 1e30.
HWY_INLINE V reciprocal(V v) {
  V r = hn::ApproximateReciprocal(v);
#if HWY_ARCH_ARM
  r = hn::Mul(r, hn::NegMulAdd(v, r, set(2)));
#endif
  return hn::Mul(r, hn::NegMulAdd(v, r, set(2)));
}

/// log2 of x >= 1e-30; of the logarithm of the mantissa 4e-7 may be wrong.
HWY_INLINE V log2_of(V x) {
  const hn::RebindToSigned<D> di;
  const auto bits = hn::BitCast(di, hn::Max(x, set(1e-30f)));
  const auto exponent = hn::ShiftRight<23>(hn::Sub(bits, hn::Set(di, 0x3f3504f3)));
  const V m = hn::BitCast(D(), hn::Sub(bits, hn::ShiftLeft<23>(exponent)));
  const V t = hn::Sub(m, set(1));  // mantissa about 1: -0.29 .. 0.41
  const V t2 = hn::Mul(t, t), t4 = hn::Mul(t2, t2);
  const V p = polynomial(t, t2, t4, -0.500000912f, 0.333341136f, -0.249824512f, 0.199290571f,
                         -0.171323873f, 0.15984096f, -0.101885865f);
  const V ln = hn::MulAdd(t2, p, t);
  return hn::MulAdd(ln, set(1.44269504f), hn::ConvertTo(D(), exponent));
}

/// 2^y for y up to 120, and nothing below 2^-60: it could not be seen, and products with it would
/// turn denormal and slow. To 4e-6.
HWY_INLINE V exp2_or_none(V asked) {
  const hn::RebindToSigned<D> di;
  const V y = hn::Max(asked, set(-60));
  const V whole = hn::Round(y);
  const V f = hn::Sub(y, whole);
  const V f2 = hn::Mul(f, f);
  const V e = hn::MulAdd(hn::MulAdd(set(0.00966636852f), f2, pair(f, 0.24022349f, 0.0559219758f)),
                         f2, pair(f, 1, 0.693121045f));
  const auto scale = hn::ShiftLeft<23>(hn::Add(hn::ConvertTo(di, whole), hn::Set(di, 127)));
  return hn::IfThenZeroElse(hn::Lt(asked, set(-60)), hn::Mul(e, hn::BitCast(D(), scale)));
}

/// x^k for x >= 0 (0 gives 0), by exp2(k log2 x). Relative error about 4e-6 + 4e-7 k |log2 x|.
HWY_INLINE V power(V x, V k) {
  return hn::IfThenZeroElse(hn::Lt(x, set(1e-30f)), exp2_or_none(hn::Mul(k, log2_of(x))));
}

}  // namespace chiaro::render::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
