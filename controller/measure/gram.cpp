// SPDX-License-Identifier: Apache-2.0
#include "controller/measure/gram.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "controller/measure/haar.h"
#include "controller/measure/kernels.h"

namespace chiaro::measure {
namespace {

/// Numbers handled at once: with 16 columns they fill about half of a first-level cache.
constexpr std::size_t kBlock = 512;

/// Lower triangle of all inner products, summed block by block.
class Gram {
 public:
  explicit Gram(std::size_t vectors) : n_(vectors), sums_(vectors * vectors) {}
  void add(std::span<const float* const> rows, std::size_t count) {
    kernels::add_gram(rows, count, sums_.data());
  }
  double at(std::size_t j, std::size_t k) const {
    return sums_[std::max(j, k) * n_ + std::min(j, k)];
  }

 private:
  std::size_t n_;
  std::vector<double> sums_;
};

/// || last + sum x_k v_k ||^2 as a form, from the products of v_1 .. v_n, last.
QuadraticForm form_of(const Gram& gram, std::size_t n, double scale) {
  QuadraticForm out;
  out.n = n;
  out.q_matrix.resize(n * n);
  out.q_vector.resize(n);
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t k = 0; k < n; ++k) out.q_matrix[j * n + k] = scale * gram.at(j, k);
    out.q_vector[j] = -scale * gram.at(n, j);
  }
  out.constant = scale * gram.at(n, n);
  return out;
}

/// Rows y - 1, y, y + 1 of a plane with one repeated pixel at each end, for Sobel.
class PaddedRows {
 public:
  explicit PaddedRows(const core::Plane& plane)
      : plane_(plane), stride_(static_cast<std::size_t>(plane.size.width) + 2), rows_(3 * stride_) {
    load(0);
  }
  void load(int y) {
    const auto w = static_cast<std::size_t>(plane_.size.width);
    float* to = row(y);
    std::copy_n(plane_.row(y), w, to);
    to[-1] = to[0];
    to[w] = to[w - 1];
  }
  float* row(int y) { return rows_.data() + static_cast<std::size_t>(y % 3) * stride_ + 1; }

 private:
  const core::Plane& plane_;
  std::size_t stride_;
  std::vector<float> rows_;
};

}  // namespace

double QuadraticForm::at(std::span<const double> x) const {
  assert(x.size() == n);
  double value = constant;
  for (std::size_t j = 0; j < n; ++j) {
    double row = -2 * q_vector[j];
    for (std::size_t k = 0; k < n; ++k) row += q_matrix[j * n + k] * x[k];
    value += x[j] * row;
  }
  return value;
}

QuadraticForm haar_form(std::span<const core::Plane* const> columns, const core::Plane& offset,
                        const core::Plane& target) {
  const std::size_t n = columns.size();
  core::Plane rest = offset;
  for (std::size_t i = 0; i < rest.values.size(); ++i) rest.values[i] -= target.values[i];
  std::vector<std::vector<float>> spectra;
  for (const core::Plane* column : columns) spectra.push_back(scaled_haar(*column));
  spectra.push_back(scaled_haar(rest));

  Gram gram(n + 1);
  std::vector<const float*> rows(n + 1);
  const std::size_t count = spectra.back().size();
  for (std::size_t begin = 0; begin < count; begin += kBlock) {
    for (std::size_t k = 0; k <= n; ++k) rows[k] = spectra[k].data() + begin;
    gram.add(rows, std::min(kBlock, count - begin));
  }
  return form_of(gram, n, 1);
}

QuadraticForm least_squares_form(std::span<const core::Plane* const> columns,
                                 const core::Plane& offset, const core::Plane& target,
                                 const core::Plane* weight) {
  const std::size_t n = columns.size(), count = offset.values.size();
  Gram gram(n + 1);
  std::vector<float> scratch((n + 1) * kBlock);
  std::vector<float> root(kBlock, 1.0f);
  std::vector<const float*> rows(n + 1);
  for (std::size_t begin = 0; begin < count; begin += kBlock) {
    const std::size_t here = std::min(kBlock, count - begin);
    float* rest = scratch.data() + n * kBlock;
    for (std::size_t i = 0; i < here; ++i) {
      if (weight) root[i] = std::sqrt(std::max(weight->values[begin + i], 0.0f));
      rest[i] = root[i] * (offset.values[begin + i] - target.values[begin + i]);
    }
    rows[n] = rest;
    for (std::size_t k = 0; k < n; ++k) {
      const float* column = columns[k]->values.data() + begin;
      rows[k] = column;
      if (!weight) continue;
      float* weighted = scratch.data() + k * kBlock;
      for (std::size_t i = 0; i < here; ++i) weighted[i] = root[i] * column[i];
      rows[k] = weighted;
    }
    gram.add(rows, here);
  }
  return form_of(gram, n, 1);
}

MomentForms moment_forms(std::span<const core::Plane* const> columns, const core::Plane& offset,
                         const PixelMap& map) {
  const std::size_t n = columns.size();
  const int height = offset.size.height;
  const auto width = static_cast<std::size_t>(offset.size.width);
  std::vector<PaddedRows> planes;
  for (const core::Plane* column : columns) planes.emplace_back(*column);
  planes.emplace_back(offset);

  // One more vector of ones (on surface pixels) turns sums into products with it.
  Gram values(n + 2), slopes(n + 1);
  std::vector<float> mask(width), scratch((n + 1) * 3 * width);
  std::vector<const float*> value_rows(n + 2), x_rows(n + 1), y_rows(n + 1);
  for (int y = 0; y < height; ++y) {
    for (std::size_t x = 0; x < width; ++x)
      mask[x] = map.type.row(y)[x] == PixelType::surface ? 1.0f : 0.0f;
    for (std::size_t k = 0; k <= n; ++k) {
      PaddedRows& p = planes[k];
      if (y + 1 < height) p.load(y + 1);
      float* v = scratch.data() + k * 3 * width;
      float *gx = v + width, *gy = gx + width;
      kernels::sobel_row(p.row(std::max(y - 1, 0)), p.row(y), p.row(std::min(y + 1, height - 1)),
                         width, gx, gy);
      const float* row = p.row(y);
      for (std::size_t x = 0; x < width; ++x) {
        v[x] = mask[x] * row[x];
        gx[x] *= mask[x];
        gy[x] *= mask[x];
      }
      value_rows[k] = v;
      x_rows[k] = gx;
      y_rows[k] = gy;
    }
    value_rows[n + 1] = mask.data();
    values.add(value_rows, width);
    slopes.add(x_rows, width);
    slopes.add(y_rows, width);
  }

  MomentForms out;
  const double scale = map.surfaces > 0 ? 1.0 / static_cast<double>(map.surfaces) : 0;
  for (std::size_t k = 0; k <= n; ++k) out.mean.push_back(scale * values.at(n + 1, k));
  out.squared_gradient = form_of(slopes, n, scale);
  out.variance = form_of(values, n, scale);
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t k = 0; k < n; ++k)
      out.variance.q_matrix[j * n + k] -= out.mean[j] * out.mean[k];
    out.variance.q_vector[j] += out.mean[j] * out.mean[n];
  }
  out.variance.constant -= out.mean[n] * out.mean[n];
  return out;
}

}  // namespace chiaro::measure
