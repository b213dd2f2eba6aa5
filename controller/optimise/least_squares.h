// SPDX-License-Identifier: Apache-2.0
// Bounded least squares for the levels: minimise x'Qx - 2q'x within bounds. Convex: one optimum.
#pragma once

#include <span>
#include <vector>

#include "controller/core/units.h"

namespace chiaro::optimise {

/// Q is n x n row-major, symmetric positive semi-definite (a ridge of 1e-12 of each diagonal keeps
/// equal columns apart; a variable whose column is 0 stays where it starts). Exact to 1e-9 of the
/// bounds' width where Q is well conditioned. Up to 32 variables nothing but the answer is
/// allocated. `start` may be empty: every variable then starts at its least.
std::vector<double> bounded_least_squares(std::span<const double> q_matrix,
                                          std::span<const double> q_vector,
                                          std::span<const core::Range> bounds,
                                          std::span<const double> start = {});

}  // namespace chiaro::optimise
