// SPDX-License-Identifier: Apache-2.0
// Pictures pre-integrated: for fixed light positions the mean, variance, RMS gradient and every
// Haar coefficient of linear light are linear or quadratic forms of the levels, so that one
// evaluation costs nanoseconds and by-example wavelet lighting is a small least-squares problem.
#pragma once

#include <span>
#include <vector>

#include "controller/core/picture.h"
#include "controller/measure/measure.h"

namespace chiaro::measure {

/// x' Q x - 2 q' x + c, Q symmetric positive semi-definite, row-major n x n.
struct QuadraticForm {
  std::size_t n = 0;
  std::vector<double> q_matrix, q_vector;
  double constant = 0;
  double at(std::span<const double> x) const;
};

/// The squared wavelet distance (haar_distance squared, on the given planes' own scale) of
/// offset + sum x_k columns[k] to `target` as a form of x. Planes are square, side a power of two.
QuadraticForm haar_form(std::span<const core::Plane* const> columns, const core::Plane& offset,
                        const core::Plane& target);
/// Sum over pixels of weight * (offset + sum x_k columns[k] - target)^2; weight may be null (= 1).
QuadraticForm least_squares_form(std::span<const core::Plane* const> columns,
                                 const core::Plane& offset, const core::Plane& target,
                                 const core::Plane* weight);
/// Mean, variance and mean squared gradient over surface pixels as forms.
struct MomentForms {
  std::vector<double> mean;  ///< mean_k, and mean of the offset last
  QuadraticForm variance, squared_gradient;
};
MomentForms moment_forms(std::span<const core::Plane* const> columns, const core::Plane& offset,
                         const PixelMap& map);

}  // namespace chiaro::measure
