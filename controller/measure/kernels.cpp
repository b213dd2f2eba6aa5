// SPDX-License-Identifier: Apache-2.0
#include "controller/measure/kernels.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "controller/measure/kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace chiaro::measure::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<float>;
using DI = hn::RebindToSigned<D>;
using V = hn::Vec<D>;

HWY_INLINE float sum_of(V v) { return hn::GetLane(hn::SumOfLanes(D(), v)); }

/// x^(-1/3) for x in [1e-3, 1]: a guess from the exponent (3 % off), then two steps of Householder
/// iteration on h = 1 - x r^3, the first with four terms of (1 - h)^(-1/3), the second with three.
/// No division. Largest error over the range is a few units in the last place.
HWY_INLINE V inverse_cube_root(V x) {
  const D d;
  const DI di;
  const auto bits = hn::ConvertTo(d, hn::BitCast(di, x));
  const auto guess = hn::Sub(hn::Set(d, 1419967116.0f), hn::Mul(bits, hn::Set(d, 1.0f / 3.0f)));
  V r = hn::BitCast(d, hn::ConvertTo(di, guess));
  const V one = hn::Set(d, 1.0f);
  V h = hn::NegMulAdd(hn::Mul(x, r), hn::Mul(r, r), one);
  V series = hn::MulAdd(h, hn::Set(d, 14.0f / 81.0f), hn::Set(d, 2.0f / 9.0f));
  series = hn::MulAdd(h, series, hn::Set(d, 1.0f / 3.0f));
  r = hn::MulAdd(hn::Mul(r, h), series, r);
  h = hn::NegMulAdd(hn::Mul(x, r), hn::Mul(r, r), one);
  series = hn::MulAdd(h, hn::Set(d, 2.0f / 9.0f), hn::Set(d, 1.0f / 3.0f));
  return hn::MulAdd(hn::Mul(r, h), series, r);
}

HWY_INLINE V lightness_of(V y) {
  const D d;
  const V knee = hn::Set(d, 0.008856452f);
  // Max takes its second operand for NaN on x86, so NaN becomes 0 rather than spreading.
  y = hn::Min(hn::Max(hn::IfThenElseZero(hn::Eq(y, y), y), hn::Zero(d)), hn::Set(d, 1.0f));
  const V x = hn::Max(y, knee);
  const V r = inverse_cube_root(x);
  const V root = hn::Mul(x, hn::Mul(r, r));
  const V curve = hn::MulSub(root, hn::Set(d, 2.55f * 116.0f), hn::Set(d, 2.55f * 16.0f));
  const V line = hn::Mul(y, hn::Set(d, 2.55f * 903.2963f));
  return hn::IfThenElse(hn::Gt(y, knee), hn::Min(curve, hn::Set(d, 255.0f)), line);
}

void WorkingScalar(const float* from, float* to, std::size_t n) {
  const D d;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t i = 0;
  for (; i + lanes <= n; i += lanes) hn::StoreU(lightness_of(hn::LoadU(d, from + i)), d, to + i);
  if (i == n) return;
  HWY_ALIGN float rest[hn::MaxLanes(d)] = {};
  std::memcpy(rest, from + i, (n - i) * sizeof(float));
  hn::Store(lightness_of(hn::Load(d, rest)), d, rest);
  std::memcpy(to + i, rest, (n - i) * sizeof(float));
}

/// Sum of n floats that may be read up to a vector beyond their end.
HWY_INLINE float sum_padded(const float* v, std::size_t n) {
  const D d;
  const std::size_t lanes = hn::Lanes(d);
  V sum = hn::Zero(d);
  std::size_t i = 0;
  for (; i + lanes <= n; i += lanes) sum = hn::Add(sum, hn::LoadU(d, v + i));
  if (i < n) sum = hn::Add(sum, hn::IfThenElseZero(hn::FirstN(d, n - i), hn::LoadU(d, v + i)));
  return sum_of(sum);
}

struct Gradient {
  V x, y;
};
HWY_INLINE Gradient sobel(const float* a, const float* b, const float* c) {
  const D d;
  const V two = hn::Set(d, 2.0f), eighth = hn::Set(d, 0.125f);
  const V al = hn::LoadU(d, a - 1), ar = hn::LoadU(d, a + 1), cl = hn::LoadU(d, c - 1),
          cr = hn::LoadU(d, c + 1);
  const V across = hn::Sub(hn::LoadU(d, b + 1), hn::LoadU(d, b - 1));
  const V down = hn::Sub(hn::LoadU(d, c), hn::LoadU(d, a));
  const V gx = hn::MulAdd(two, across, hn::Add(hn::Sub(ar, al), hn::Sub(cr, cl)));
  const V gy = hn::MulAdd(two, down, hn::Add(hn::Sub(cl, al), hn::Sub(cr, ar)));
  return {hn::Mul(gx, eighth), hn::Mul(gy, eighth)};
}

void MaskedSobelRow(const float* above, const float* row, const float* below, const float* mask,
                    std::size_t n, float* value, float* along_x, float* along_y) {
  const D d;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t i = 0;
  for (; i + lanes <= n; i += lanes) {
    const Gradient g = sobel(above + i, row + i, below + i);
    const V m = hn::LoadU(d, mask + i);
    hn::StoreU(hn::Mul(m, hn::LoadU(d, row + i)), d, value + i);
    hn::StoreU(hn::Mul(m, g.x), d, along_x + i);
    hn::StoreU(hn::Mul(m, g.y), d, along_y + i);
  }
  for (; i < n; ++i) {
    const float *a = above + i, *b = row + i, *c = below + i;
    const float m = mask[i] * 0.125f;
    value[i] = mask[i] * b[0];
    along_x[i] = (2 * (b[1] - b[-1]) + ((a[1] - a[-1]) + (c[1] - c[-1]))) * m;
    along_y[i] = (2 * (c[0] - a[0]) + ((c[-1] - a[-1]) + (c[1] - a[1]))) * m;
  }
}

/// The fused pass: rows of the working scalar rotate through three padded buffers; each row is
/// visited once for gradient, moments and bins, then for its edges, runs and columns.
class Pass {
 public:
  explicit Pass(const PassInput& in)
      : in_(in),
        width_(static_cast<std::size_t>(in.source->size.width)),
        height_(in.source->size.height),
        padded_((width_ + 2 * kPad - 1) / kPad * kPad + kPad),
        rows_(3 * padded_),
        squared_(padded_),
        lit_(padded_),
        columns_(in.map->index.column_ends.empty() ? 0 : padded_),
        bins_(padded_),
        type_(padded_) {
    sums_.run_sums.resize(in.map->index.run_length.size());
  }

  PassSums run() {
    load(0);
    find_shift();
    for (int y = 0; y < height_; ++y) {
      if (y + 1 < height_) load(y + 1);
      measure_row(y);
      count_row(y);
      find_edges(y);
      sum_runs(y);
    }
    for (std::size_t k = 0; k < 256; ++k)
      sums_.histogram[k] = tables_[0][k] + tables_[1][k] + tables_[2][k] + tables_[3][k];
    return std::move(sums_);
  }

 private:
  static constexpr std::size_t kPad = 64;  // floats: more than a vector on every target

  float* row(int y) { return rows_.data() + static_cast<std::size_t>(y % 3) * padded_ + kPad / 2; }

  void load(int y) {
    float* to = row(y);
    const float* from = in_.source->row(y);
    if (in_.is_luminance)
      WorkingScalar(from, to, width_);
    else
      std::memcpy(to, from, width_ * sizeof(float));
    to[-1] = to[0];
    to[width_] = to[width_ - 1];
  }

  void find_shift() {
    const auto& types = in_.map->type.values;
    const auto first = std::find(types.begin(), types.end(), PixelType::surface);
    if (first == types.end()) return;
    const float v = in_.source->values[static_cast<std::size_t>(first - types.begin())];
    sums_.shift = v;
    if (in_.is_luminance) WorkingScalar(&v, &sums_.shift, 1);
  }

  void measure_row(int y) {
    const float *a = row(std::max(y - 1, 0)), *b = row(y), *c = row(std::min(y + 1, height_ - 1));
    std::memcpy(type_.data(), in_.map->type.row(y), width_);
    if (in_.lit) std::memcpy(lit_.data(), in_.lit->row(y), width_ * sizeof(float));
    const D d;
    const DI di;
    const hn::Rebind<std::uint8_t, D> du;
    const std::size_t lanes = hn::Lanes(d);
    const V shift = hn::Set(d, sums_.shift);
    V weight = hn::Zero(d), first = hn::Zero(d), second = hn::Zero(d), gradient = hn::Zero(d);
    const PixelIndex::Span shown = in_.map->index.shown[static_cast<std::size_t>(y)];
    for (std::size_t x = shown.begin / lanes * lanes; x < shown.end; x += lanes) {
      const auto type = hn::PromoteTo(di, hn::LoadU(du, type_.data() + x));
      const auto surface =
          hn::RebindMask(d, hn::Eq(type, hn::Set(di, static_cast<int>(PixelType::surface))));
      const V v = hn::LoadU(d, b + x);
      const Gradient g = sobel(a + x, b + x, c + x);
      const V squared = hn::MulAdd(g.x, g.x, hn::Mul(g.y, g.y));
      hn::StoreU(squared, d, squared_.data() + x);
      gradient = hn::Add(gradient, hn::IfThenElseZero(surface, squared));
      const V lit = in_.lit ? hn::LoadU(d, lit_.data() + x) : hn::Set(d, 1.0f);
      const V w = hn::IfThenElseZero(surface, lit);
      const V off = hn::IfThenElseZero(surface, hn::Sub(v, shift));
      weight = hn::Add(weight, w);
      first = hn::MulAdd(w, off, first);
      second = hn::MulAdd(hn::Mul(w, off), off, second);
      const auto outside = hn::Eq(type, hn::Zero(di));
      const auto bin = hn::Min(hn::Max(hn::NearestInt(v), hn::Zero(di)), hn::Set(di, 255));
      hn::StoreU(hn::IfThenElse(outside, hn::Set(di, 256), bin), di, bins_.data() + x);
    }
    sums_.weight += static_cast<double>(sum_of(weight));
    sums_.first += static_cast<double>(sum_of(first));
    sums_.second += static_cast<double>(sum_of(second));
    sums_.squared_gradient += static_cast<double>(sum_of(gradient));
  }

  /// Four tables, so that equal neighbours do not wait for each other's store.
  void count_row(int y) {
    const PixelIndex::Span shown = in_.map->index.shown[static_cast<std::size_t>(y)];
    std::size_t x = shown.begin;
    const std::int32_t* bin = bins_.data();
    for (; x + 4 <= shown.end; x += 4)
      for (std::size_t t = 0; t < 4; ++t) ++tables_[t][bin[x + t]];
    for (; x < shown.end; ++x) ++tables_[0][bin[x]];
  }

  void find_edges(int y) {
    const PixelIndex& index = in_.map->index;
    const auto line = static_cast<std::size_t>(y);
    const float least = in_.edge_threshold * in_.edge_threshold;
    const float extra = in_.shadow_edge_weight - 1;
    float all = 0, found = 0;
    for (std::uint32_t k = index.edge_row[line]; k < index.edge_row[line + 1]; ++k) {
      const std::uint32_t x = index.edge_x[k];
      const float weight = in_.lit ? 1 + extra * (1 - lit_[x]) : 1.0f;
      all += weight;
      found += squared_[x] > least ? weight : 0.0f;
    }
    sums_.edge_weight += static_cast<double>(all);
    sums_.edge_found += static_cast<double>(found);
  }

  void sum_runs(int y) {
    if (columns_.empty() && in_.map->index.row_runs.empty()) return;
    const PixelIndex& index = in_.map->index;
    const auto line = static_cast<std::size_t>(y);
    const float* values = row(y);
    for (std::uint32_t k = index.row_runs_row[line]; k < index.row_runs_row[line + 1]; ++k) {
      const PixelIndex::Run& r = index.row_runs[k];
      sums_.run_sums[r.slot] = sum_padded(values + r.begin, r.end - r.begin);
    }
    if (columns_.empty()) return;
    for (std::uint32_t k = index.column_begins_row[line]; k < index.column_begins_row[line + 1];
         ++k)
      columns_[index.column_begins[k]] = 0;
    const D d;
    for (std::size_t x = 0; x < width_; x += hn::Lanes(d))
      hn::StoreU(hn::Add(hn::LoadU(d, columns_.data() + x), hn::LoadU(d, values + x)), d,
                 columns_.data() + x);
    for (std::uint32_t k = index.column_ends_row[line]; k < index.column_ends_row[line + 1]; ++k) {
      const PixelIndex::Mark& end = index.column_ends[k];
      sums_.run_sums[end.slot] = columns_[end.x];
    }
  }

  const PassInput& in_;
  const std::size_t width_;
  const int height_;
  const std::size_t padded_;
  std::vector<float> rows_, squared_, lit_, columns_;
  std::vector<std::int32_t> bins_;
  std::vector<std::uint8_t> type_;
  std::uint32_t tables_[4][257] = {};
  PassSums sums_;
};

PassSums RunPass(const PassInput& input) { return Pass(input).run(); }

/// With `d` of fewer lanes than the widest, the narrow levels at the top are vectors too.
template <class DN>
HWY_INLINE std::size_t haar_row(DN d, const float* up, const float* low, std::size_t begin,
                                std::size_t width, float scale, float* mean, float* horizontal,
                                float* vertical) {
  const auto half = hn::Set(d, 0.5f * scale), quarter = hn::Set(d, 0.25f);
  std::size_t x = begin;
  for (; x + hn::Lanes(d) <= width; x += hn::Lanes(d)) {
    hn::Vec<DN> ul, ur, ll, lr;
    hn::LoadInterleaved2(d, up + 2 * x, ul, ur);
    hn::LoadInterleaved2(d, low + 2 * x, ll, lr);
    const auto left = hn::Add(ul, ll), right = hn::Add(ur, lr);
    hn::StoreU(hn::Mul(hn::Add(left, right), quarter), d, mean + x);
    hn::StoreU(hn::Mul(hn::Sub(left, right), half), d, horizontal + x);
    hn::StoreU(hn::Mul(hn::Sub(hn::Add(ul, ur), hn::Add(ll, lr)), half), d, vertical + x);
  }
  return x;
}

void HaarLevel(const float* in, std::size_t width, std::size_t height, float scale, float* mean,
               float* horizontal, float* vertical) {
  for (std::size_t y = 0; y < height; ++y) {
    const float *up = in + 4 * y * width, *low = up + 2 * width;
    float *m = mean + y * width, *h = horizontal + y * width, *v = vertical + y * width;
    std::size_t x = haar_row(D(), up, low, 0, width, scale, m, h, v);
    x = haar_row(hn::CappedTag<float, 4>(), up, low, x, width, scale, m, h, v);
    for (; x < width; ++x) {
      const float ul = up[2 * x], ur = up[2 * x + 1], ll = low[2 * x], lr = low[2 * x + 1];
      m[x] = ((ul + ll) + (ur + lr)) * 0.25f;
      h[x] = ((ul + ll) - (ur + lr)) * (0.5f * scale);
      v[x] = ((ul + ur) - (ll + lr)) * (0.5f * scale);
    }
  }
}

/// Two rows by four columns of the Gram matrix at a time: eight products for six loads.
template <std::size_t kColumns>
HWY_INLINE void gram_tile(const float* a0, const float* a1, const float* const* b, std::size_t n,
                          float (&out)[2][4]) {
  const D d;
  const std::size_t lanes = hn::Lanes(d);
  V s00 = hn::Zero(d), s01 = s00, s02 = s00, s03 = s00, s10 = s00, s11 = s00, s12 = s00, s13 = s00;
  std::size_t i = 0;
  for (; i + lanes <= n; i += lanes) {
    const V x0 = hn::LoadU(d, a0 + i), x1 = hn::LoadU(d, a1 + i);
    const V y0 = hn::LoadU(d, b[0] + i);
    s00 = hn::MulAdd(x0, y0, s00);
    s10 = hn::MulAdd(x1, y0, s10);
    if constexpr (kColumns > 1) {
      const V y1 = hn::LoadU(d, b[1] + i);
      s01 = hn::MulAdd(x0, y1, s01);
      s11 = hn::MulAdd(x1, y1, s11);
    }
    if constexpr (kColumns > 2) {
      const V y2 = hn::LoadU(d, b[2] + i);
      s02 = hn::MulAdd(x0, y2, s02);
      s12 = hn::MulAdd(x1, y2, s12);
    }
    if constexpr (kColumns > 3) {
      const V y3 = hn::LoadU(d, b[3] + i);
      s03 = hn::MulAdd(x0, y3, s03);
      s13 = hn::MulAdd(x1, y3, s13);
    }
  }
  const V sums[2][4] = {{s00, s01, s02, s03}, {s10, s11, s12, s13}};
  for (std::size_t k = 0; k < kColumns; ++k) {
    out[0][k] = sum_of(sums[0][k]);
    out[1][k] = sum_of(sums[1][k]);
    for (std::size_t r = i; r < n; ++r) {
      out[0][k] += a0[r] * b[k][r];
      out[1][k] += a1[r] * b[k][r];
    }
  }
}

void AddGram(std::span<const float* const> rows, std::size_t n, double* gram) {
  const std::size_t m = rows.size();
  for (std::size_t j = 0; j < m; j += 2) {
    const std::size_t other = std::min(j + 1, m - 1);
    for (std::size_t k = 0; k <= other; k += 4) {
      const std::size_t columns = std::min<std::size_t>(4, m - k);
      float tile[2][4];
      const float* const* b = rows.data() + k;
      if (columns == 4) gram_tile<4>(rows[j], rows[other], b, n, tile);
      if (columns == 3) gram_tile<3>(rows[j], rows[other], b, n, tile);
      if (columns == 2) gram_tile<2>(rows[j], rows[other], b, n, tile);
      if (columns == 1) gram_tile<1>(rows[j], rows[other], b, n, tile);
      for (std::size_t c = 0; c < columns; ++c) {
        if (k + c <= j) gram[j * m + k + c] += static_cast<double>(tile[0][c]);
        if (other != j && k + c <= other)
          gram[other * m + k + c] += static_cast<double>(tile[1][c]);
      }
    }
  }
}

float Sum(const float* values, std::size_t n) {
  const D d;
  const std::size_t lanes = hn::Lanes(d);
  V a = hn::Zero(d), b = a, c = a, e = a;
  std::size_t i = 0;
  for (; i + 4 * lanes <= n; i += 4 * lanes) {
    a = hn::Add(a, hn::LoadU(d, values + i));
    b = hn::Add(b, hn::LoadU(d, values + i + lanes));
    c = hn::Add(c, hn::LoadU(d, values + i + 2 * lanes));
    e = hn::Add(e, hn::LoadU(d, values + i + 3 * lanes));
  }
  float rest = 0;
  for (; i < n; ++i) rest += values[i];
  return sum_of(hn::Add(hn::Add(a, b), hn::Add(c, e))) + rest;
}

}  // namespace chiaro::measure::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace chiaro::measure::kernels {

HWY_EXPORT(WorkingScalar);
HWY_EXPORT(MaskedSobelRow);
HWY_EXPORT(RunPass);
HWY_EXPORT(HaarLevel);
HWY_EXPORT(AddGram);
HWY_EXPORT(Sum);

void working_scalar(const float* from, float* to, std::size_t n) {
  HWY_DYNAMIC_DISPATCH(WorkingScalar)(from, to, n);
}
PassSums pass(const PassInput& input) { return HWY_DYNAMIC_DISPATCH(RunPass)(input); }
void haar_level(const float* in, std::size_t width, std::size_t height, float scale, float* mean,
                float* horizontal, float* vertical) {
  HWY_DYNAMIC_DISPATCH(HaarLevel)(in, width, height, scale, mean, horizontal, vertical);
}
void masked_sobel_row(const float* above, const float* row, const float* below, const float* mask,
                      std::size_t n, float* value, float* along_x, float* along_y) {
  HWY_DYNAMIC_DISPATCH(MaskedSobelRow)(above, row, below, mask, n, value, along_x, along_y);
}
void add_gram(std::span<const float* const> rows, std::size_t n, double* gram) {
  HWY_DYNAMIC_DISPATCH(AddGram)(rows, n, gram);
}

float sum(const float* values, std::size_t n) { return HWY_DYNAMIC_DISPATCH(Sum)(values, n); }

std::vector<std::int64_t> targets() { return hwy::SupportedAndGeneratedTargets(); }
void use_target(std::int64_t target) {
  hwy::SetSupportedTargetsForTest(target);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace chiaro::measure::kernels
#endif
