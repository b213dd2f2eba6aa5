// SPDX-License-Identifier: Apache-2.0
// From light and what is seen of it to a picture: products, blends and sums of planes.
#include "controller/render/kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "controller/render/relight_kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target: both are read once per instruction set.
#include <hwy/highway.h>

#include "controller/render/shading-inl.h"

HWY_BEFORE_NAMESPACE();
namespace chiaro::render::kernels::HWY_NAMESPACE {

void Combine(const float* albedo, const float* irradiance, const float* glossy,
             const float* visible, float k, float g, float* out, std::size_t n) {
  const V kv = set(k), gv = set(g);
  for (std::size_t i = 0; i < n; i += lanes()) {
    V v = hn::Mul(hn::Mul(kv, hn::LoadU(D(), albedo + i)), hn::LoadU(D(), irradiance + i));
    if (glossy != nullptr) v = hn::MulAdd(gv, hn::LoadU(D(), glossy + i), v);
    if (visible != nullptr) v = hn::Mul(v, hn::LoadU(D(), visible + i));
    hn::StoreU(v, D(), out + i);
  }
}

void CombineRgb(const Samples& samples, std::size_t tile, const float* irradiance,
                const float* glossy, const float* visible, const float* rgb, float g, float* out) {
  const V r = set(rgb[0]), gr = set(rgb[1]), b = set(rgb[2]), gv = set(g);
  for (std::size_t i = 0; i < kTile; i += lanes()) {
    const Group group{samples, tile * kTile + i};
    const V albedo = hn::MulAdd(
        r, group.load(Samples::diffuse_r),
        hn::MulAdd(gr, group.load(Samples::diffuse_g), hn::Mul(b, group.load(Samples::diffuse_b))));
    V v = hn::Mul(albedo, hn::LoadU(D(), irradiance + i));
    if (glossy != nullptr) v = hn::MulAdd(gv, hn::LoadU(D(), glossy + i), v);
    if (visible != nullptr) v = hn::Mul(v, hn::LoadU(D(), visible + i));
    hn::StoreU(v, D(), out + i);
  }
}

void BlendBits(std::span<const Bits> places, float* out, std::size_t n) {
  for (std::size_t i = 0; i < n; i += lanes()) {
    V sum = zero();
    for (const Bits& place : places) {
      // A mask is read from at least 8 bytes; the lists are padded for that.
      const std::uint8_t* from = place.bits + i / 8;
      std::uint8_t shifted[8];
      if (lanes() < 8) {
        shifted[0] = static_cast<std::uint8_t>(from[0] >> (i % 8));
        from = shifted;
      }
      const M open = hn::LoadMaskBits(D(), from);
      sum = hn::Add(sum, hn::IfThenElseZero(open, set(place.weight)));
    }
    hn::StoreU(sum, D(), out + i);
  }
}

void BlendBytes(std::span<const Bytes> places, float* out, std::size_t n) {
  const hn::RebindToSigned<D> di;
  const hn::Rebind<std::uint8_t, D> du8;
  for (std::size_t i = 0; i < n; i += lanes()) {
    V sum = zero();
    for (const Bytes& place : places) {
      const auto bytes = hn::PromoteTo(di, hn::LoadU(du8, place.bytes + i));
      sum = hn::MulAdd(set(place.weight * (1.0f / 255)), hn::ConvertTo(D(), bytes), sum);
    }
    hn::StoreU(sum, D(), out + i);
  }
}

void Mix(std::span<const float* const> planes, std::span<const float> levels, const float* ambient,
         float* out, std::size_t n) {
  const std::size_t step = lanes();
  std::size_t i = 0;
  // Two accumulators: the additions of one plane do not wait for the last's.
  for (; i + 2 * step <= n; i += 2 * step) {
    V a = hn::LoadU(D(), ambient + i), b = hn::LoadU(D(), ambient + i + step);
    for (std::size_t k = 0; k < planes.size(); ++k) {
      const V level = set(levels[k]);
      a = hn::MulAdd(level, hn::LoadU(D(), planes[k] + i), a);
      b = hn::MulAdd(level, hn::LoadU(D(), planes[k] + i + step), b);
    }
    hn::StoreU(a, D(), out + i);
    hn::StoreU(b, D(), out + i + step);
  }
  for (; i < n; ++i) {
    float v = ambient[i];
    for (std::size_t k = 0; k < planes.size(); ++k) v += levels[k] * planes[k][i];
    out[i] = v;
  }
}

}  // namespace chiaro::render::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace chiaro::render::kernels {

HWY_EXPORT(Combine);
HWY_EXPORT(CombineRgb);
HWY_EXPORT(BlendBits);
HWY_EXPORT(BlendBytes);
HWY_EXPORT(Mix);

void combine(const float* albedo, const float* irradiance, const float* glossy,
             const float* visible, float k, float g, float* out, std::size_t n) {
  HWY_DYNAMIC_DISPATCH(Combine)(albedo, irradiance, glossy, visible, k, g, out, n);
}
void combine_rgb(const Samples& samples, std::size_t tile, const float* irradiance,
                 const float* glossy, const float* visible, const float rgb[3], float glossy_gain,
                 float* out) {
  HWY_DYNAMIC_DISPATCH(CombineRgb)
  (samples, tile, irradiance, glossy, visible, rgb, glossy_gain, out);
}
void blend_bits(std::span<const Bits> places, float* out, std::size_t n) {
  HWY_DYNAMIC_DISPATCH(BlendBits)(places, out, n);
}
void blend_bytes(std::span<const Bytes> places, float* out, std::size_t n) {
  HWY_DYNAMIC_DISPATCH(BlendBytes)(places, out, n);
}
void mix(std::span<const float* const> planes, std::span<const float> levels, const float* ambient,
         float* out, std::size_t n) {
  HWY_DYNAMIC_DISPATCH(Mix)(planes, levels, ambient, out, n);
}

}  // namespace chiaro::render::kernels
#endif
