// SPDX-License-Identifier: Apache-2.0
// The hot loops behind measure.h and gram.h: written once with Highway, compiled for each SIMD
// target, chosen at run time. Sums are taken per row in float lanes and over rows in double, so
// that targets differ by rounding only.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "controller/measure/measure.h"

namespace chiaro::measure::kernels {

/// L* x 2.55 of luminances; `to` may be `from`.
void working_scalar(const float* from, float* to, std::size_t n);

struct PassInput {
  const core::Plane* source = nullptr;
  bool is_luminance = false;  ///< else already the working scalar
  const PixelMap* map = nullptr;
  const core::Plane* lit = nullptr;
  float edge_threshold = 0, shadow_edge_weight = 1;
};
struct PassSums {
  float shift = 0;  ///< mean and variance are summed about this value: no cancellation
  double weight = 0, first = 0, second = 0;
  double squared_gradient = 0;  ///< of Sobel / 8 over surface pixels
  double edge_weight = 0, edge_found = 0;
  std::array<std::uint32_t, 256> histogram{};
  std::vector<float> run_sums;  ///< per slot of the pixel index
};
PassSums pass(const PassInput& input);

/// One level of the Haar pyramid: `in` is 2 width x 2 height, the outputs width x height. The
/// coefficients, not the mean, are multiplied by `scale`.
void haar_level(const float* in, std::size_t width, std::size_t height, float scale, float* mean,
                float* horizontal, float* vertical);

/// Sobel / 8 along x and y of one row and the row itself, all times `mask`. Each of the three input
/// rows is readable from [-1] to [n].
void masked_sobel_row(const float* above, const float* row, const float* below, const float* mask,
                      std::size_t n, float* value, float* along_x, float* along_y);

/// gram[j * rows.size() + k] += sum over n of rows[j] * rows[k], for k <= j.
void add_gram(std::span<const float* const> rows, std::size_t n, double* gram);

/// Sum of all numbers as fast as they can be read: the bench's roofline.
float sum(const float* values, std::size_t n);

/// The SIMD targets that this machine can run, and a way to choose one for tests (0 = best).
std::vector<std::int64_t> targets();
void use_target(std::int64_t target);

}  // namespace chiaro::measure::kernels
