// SPDX-License-Identifier: Apache-2.0
// Finding the least of a cost function within bounds. Knows nothing of pictures or lamps. Every
// optimiser keeps bounds and budget and is exact in its seed; see optimisers.def for the list.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "controller/core/units.h"

namespace chiaro::optimise {

using Point = std::vector<double>;

/// Thread-safe when `Task::threads` > 1: it is then called from several threads at once. It must be
/// a pure function of the point. +infinity marks an infeasible point.
using Cost = std::function<double(std::span<const double>)>;

/// The cost and, into the second argument, its derivatives by each variable (one per bound).
using Gradient = std::function<double(std::span<const double>, std::span<double>)>;

struct Task {
  Cost cost;
  Gradient gradient;                ///< may be empty; optimisers that can use it do
  std::vector<core::Range> bounds;  ///< finite; least == most fixes a variable
  std::vector<Point> starts;    ///< tried first, in order; more are drawn when the budget allows
  std::uint64_t trials = 1000;  ///< evaluations, over all threads
  std::uint64_t seed = 1;
  int threads = 1;                          ///< results are the same for any number
  const std::atomic<bool>* stop = nullptr;  ///< a time budget or a cancel; the best so far is kept
  /// Called as trials finish with (trials so far, best so far), from any thread, one at a time.
  std::function<void(std::uint64_t, double)> progress;
};

struct Outcome {
  Point best;
  double value = std::numeric_limits<double>::infinity();
  std::uint64_t trials = 0;
  bool stopped = false;  ///< by `stop`, so not reproducible by seed alone
  struct Step {
    std::uint64_t trial;
    double value;
  };
  std::vector<Step> trace;  ///< each improvement
  std::vector<std::pair<Point, double>>
      basins;  ///< best distinct local optima, best first, at most 8
};

class Optimiser {
 public:
  virtual ~Optimiser() = default;
  virtual Outcome minimise(const Task& task) const = 0;
};

struct OptimiserEntry {
  std::string_view name, summary;
  std::unique_ptr<Optimiser> (*make)();
};
std::span<const OptimiserEntry> optimisers();
/// Null when there is none of that name.
std::unique_ptr<Optimiser> make_optimiser(std::string_view name);

}  // namespace chiaro::optimise
