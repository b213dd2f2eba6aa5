// SPDX-License-Identifier: Apache-2.0
// Bounded least squares for the levels: minimise x'Qx - 2q'x within bounds. Convex: one optimum.
#pragma once

#include <span>
#include <vector>

#include "controller/core/units.h"

namespace chiaro::optimise {

/// Q is n x n row-major, symmetric positive semi-definite (a tiny ridge is added where a column is
/// 0). Exact to 1e-9 of the bounds' width. No allocation beyond the answer.
/// `start` may be empty. Complexity: O(n^2) per sweep, a few sweeps.
std::vector<double> bounded_least_squares(std::span<const double> q_matrix,
                                          std::span<const double> q_vector,
                                          std::span<const core::Range> bounds,
                                          std::span<const double> start = {});

}  // namespace chiaro::optimise
