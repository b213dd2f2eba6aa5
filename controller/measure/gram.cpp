// SPDX-License-Identifier: Apache-2.0
#include "controller/measure/gram.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "controller/measure/haar.h"
#include "controller/measure/kernels.h"

namespace chiaro::measure {
namespace {

/// Numbers handled at once: long enough that sums across lanes do not count, short enough that 16
/// columns stay in the second-level cache.
constexpr std::size_t kBlock = 1024;
/// Rows of a Haar strip: all columns' coefficients of a strip stay in the second-level cache too.
constexpr int kStrip = 8;

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

/// The Haar pyramids of all columns, strip by strip: the finest levels of a strip of rows go
/// straight into the products, its means into a small plane per column whose pyramid is the rest.
class HaarGram {
 public:
  HaarGram(std::span<const core::Plane* const> columns, const core::Plane& offset,
           const core::Plane& target)
      : columns_(columns),
        offset_(offset),
        target_(target),
        n_(columns.size()),
        side_(offset.size.width),
        strip_(std::min(kStrip, side_)),
        small_side_(static_cast<std::size_t>(side_ / strip_)),
        gram_(n_ + 1),
        rows_(n_ + 1),
        small_(n_ + 1, std::vector<float>(small_side_ * small_side_)) {
    assert(offset.size.width == offset.size.height && target.size == offset.size);
  }

  QuadraticForm form() {
    const auto area = static_cast<std::size_t>(side_) * static_cast<std::size_t>(strip_);
    coefficients_.resize((n_ + 1) * area);
    means_[0].resize(area / 4);
    means_[1].resize(area / 4);
    std::vector<float> rest(area);
    for (int y = 0; y < side_; y += strip_) {
      std::size_t count = 0;
      for (std::size_t k = 0; k <= n_; ++k) {
        const float* in = k < n_ ? columns_[k]->row(y) : rest.data();
        for (std::size_t i = 0; k == n_ && i < area; ++i)
          rest[i] = offset_.row(y)[i] - target_.row(y)[i];
        float* means = small_[k].data() + static_cast<std::size_t>(y / strip_) * small_side_;
        count = levels(in, static_cast<std::size_t>(side_), static_cast<std::size_t>(strip_),
                       haar_levels(side_) - 1, coefficients_.data() + k * area, means);
        rows_[k] = coefficients_.data() + k * area;
      }
      gram_.add(rows_, count);
    }
    add_the_rest(area);
    return form_of(gram_, n_, 1);
  }

 private:
  /// Halves `in` until it is one row high; scaled coefficients one after the other to `out`, the
  /// last means to `means`. Returns how many coefficients there are.
  std::size_t levels(const float* in, std::size_t width, std::size_t height, int level, float* out,
                     float* means) {
    std::size_t count = 0;
    for (int turn = 0; height > 1; turn ^= 1, --level) {
      width /= 2;
      height /= 2;
      float* to = height == 1 ? means : means_[turn].data();
      const auto scale = static_cast<float>(std::sqrt(haar_level_weight(side_, level)));
      kernels::haar_level(in, width, height, scale, to, out + count, out + count + width * height);
      count += 2 * width * height;
      in = to;
    }
    return count;
  }

  void add_the_rest(std::size_t area) {
    const auto mean_scale = static_cast<float>(std::sqrt(haar_mean_weight(side_)));
    std::size_t count = 0;
    for (std::size_t k = 0; k <= n_; ++k) {
      float* out = coefficients_.data() + k * area;
      float mean = small_[k].front();
      count = levels(small_[k].data(), small_side_, small_side_,
                     haar_levels(static_cast<int>(small_side_)) - 1, out, &mean);
      out[count++] = mean_scale * mean;
    }
    gram_.add(rows_, count);
  }

  std::span<const core::Plane* const> columns_;
  const core::Plane &offset_, &target_;
  std::size_t n_;
  int side_, strip_;
  std::size_t small_side_;
  Gram gram_;
  std::vector<const float*> rows_;
  std::vector<std::vector<float>> small_;
  std::vector<float> coefficients_, means_[2];
};

/// Mean, variance and gradient products, a few rows of all columns at a time.
class MomentGrams {
 public:
  MomentGrams(std::span<const core::Plane* const> columns, const core::Plane& offset,
              const PixelMap& map)
      : n_(columns.size()),
        width_(static_cast<std::size_t>(offset.size.width)),
        height_(offset.size.height),
        values(n_ + 2),
        slopes(n_ + 1),
        map_(map),
        planes_(columns.begin(), columns.end()),
        at_once_(std::clamp<int>(static_cast<int>(kBlock / width_), 1, height_)),
        block_(width_ * static_cast<std::size_t>(at_once_)),
        // One vector more, of ones on surface pixels, turns sums into products with it.
        scratch_((3 * (n_ + 1) + 1) * block_),
        padded_(3 * (width_ + 2)) {
    planes_.push_back(&offset);
    for (int y = 0; y < height_; y += at_once_) add(y, std::min(at_once_, height_ - y));
  }

 private:
  float* part(std::size_t index) { return scratch_.data() + index * block_; }

  const float* padded(const core::Plane& plane, int y, std::size_t slot) {
    float* to = padded_.data() + slot * (width_ + 2) + 1;
    std::copy_n(plane.row(std::clamp(y, 0, height_ - 1)), width_, to);
    to[-1] = to[0];
    to[width_] = to[width_ - 1];
    return to;
  }

  void add(int first, int count) {
    float* mask = part(3 * (n_ + 1));
    const PixelType* types = map_.type.row(first);
    const std::size_t pixels = width_ * static_cast<std::size_t>(count);
    for (std::size_t i = 0; i < pixels; ++i) mask[i] = types[i] == PixelType::surface ? 1.0f : 0.0f;
    std::vector<const float*> value_rows, x_rows, y_rows;
    for (std::size_t k = 0; k <= n_; ++k) {
      const core::Plane& plane = *planes_[k];
      const float* rows[3] = {padded(plane, first - 1, 0), padded(plane, first, 1), nullptr};
      for (int i = 0; i < count; ++i) {
        // The three padded rows take turns.
        const auto slot = static_cast<std::size_t>(i);
        rows[(slot + 2) % 3] = padded(plane, first + i + 1, (slot + 2) % 3);
        const std::size_t at = slot * width_;
        kernels::masked_sobel_row(rows[slot % 3], rows[(slot + 1) % 3], rows[(slot + 2) % 3],
                                  mask + at, width_, part(3 * k) + at, part(3 * k + 1) + at,
                                  part(3 * k + 2) + at);
      }
      value_rows.push_back(part(3 * k));
      x_rows.push_back(part(3 * k + 1));
      y_rows.push_back(part(3 * k + 2));
    }
    value_rows.push_back(mask);
    values.add(value_rows, pixels);
    slopes.add(x_rows, pixels);
    slopes.add(y_rows, pixels);
  }

  std::size_t n_, width_;
  int height_;

 public:
  Gram values, slopes;

 private:
  const PixelMap& map_;
  std::vector<const core::Plane*> planes_;
  int at_once_;
  std::size_t block_;
  std::vector<float> scratch_, padded_;
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
  return HaarGram(columns, offset, target).form();
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
  const MomentGrams grams(columns, offset, map);
  MomentForms out;
  const double scale = map.surfaces > 0 ? 1.0 / static_cast<double>(map.surfaces) : 0;
  for (std::size_t k = 0; k <= n; ++k) out.mean.push_back(scale * grams.values.at(n + 1, k));
  out.squared_gradient = form_of(grams.slopes, n, scale);
  out.variance = form_of(grams.values, n, scale);
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t k = 0; k < n; ++k)
      out.variance.q_matrix[j * n + k] -= out.mean[j] * out.mean[k];
    out.variance.q_vector[j] += out.mean[j] * out.mean[n];
  }
  out.variance.constant -= out.mean[n] * out.mean[n];
  return out;
}

}  // namespace chiaro::measure
