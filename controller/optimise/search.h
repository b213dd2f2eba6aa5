// SPDX-License-Identifier: Apache-2.0
// What all optimisers share: the task in the unit cube of its free variables, the budget, the stop
// flag, the record. An optimiser that works through these keeps every promise of optimiser.h.
#pragma once

#include <cstddef>
#include <functional>
#include <mutex>

#include "controller/optimise/optimiser.h"

namespace chiaro::optimise {

/// The free variables, each scaled to 0..1. Thread-safe as far as the task's cost is.
class Problem {
 public:
  explicit Problem(const Task& task);
  std::size_t dimension() const { return free_.size(); }
  Point point_of(std::span<const double> unit) const;
  Point unit_of(std::span<const double> point) const;
  /// NaN counts as infeasible.
  double cost(std::span<const double> unit) const;
  /// The same, and its derivatives by the unit variables. Precondition: has_gradient().
  double cost(std::span<const double> unit, std::span<double> gradient) const;
  bool has_gradient() const { return static_cast<bool>(task_.gradient); }
  const Task& task() const { return task_; }

 private:
  const Task& task_;
  std::vector<std::size_t> free_;
};

/// Tells the caller how far the search is. Thread-safe.
class Ledger {
 public:
  explicit Ledger(const Task& task) : task_(task) {}
  bool stopped() const { return task_.stop && task_.stop->load(std::memory_order_relaxed); }
  void finished(double value);

 private:
  const Task& task_;
  std::mutex mutex_;
  std::uint64_t trials_ = 0;
  double best_ = std::numeric_limits<double>::infinity();
};

/// One sequential search with its own share of the budget.
class Run {
 public:
  Run(const Problem& problem, Ledger& ledger, std::uint64_t budget)
      : problem_(&problem), ledger_(&ledger), budget_(budget) {}
  /// +infinity, and nothing evaluated, once the share is used up or the caller has stopped.
  double evaluate(std::span<const double> unit);
  /// With derivatives, one trial too; they are 0 where nothing was evaluated.
  double evaluate(std::span<const double> unit, std::span<double> gradient);
  bool over() const { return used_ >= budget_ || stopped_ || ledger_->stopped(); }

  const Point& best() const { return best_; }  ///< unit; empty before the first trial
  double value() const { return value_; }
  std::uint64_t used() const { return used_; }
  bool stopped() const { return stopped_; }
  const std::vector<Outcome::Step>& steps() const { return steps_; }

 private:
  template <class Cost>
  double tried(std::span<const double> unit, const Cost& cost);

  const Problem* problem_;
  Ledger* ledger_;
  std::uint64_t budget_, used_ = 0;
  bool stopped_ = false;
  Point best_;
  double value_ = std::numeric_limits<double>::infinity();
  std::vector<Outcome::Step> steps_;
};

/// Puts runs together in the order in which they were planned, not in which they ended: so the
/// outcome does not depend on threads.
class Record {
 public:
  explicit Record(const Problem& problem) : problem_(problem) {}
  void absorb(const Run& run, bool is_basin);
  /// A local optimum that no single run stands for.
  void basin(const Point& unit, double value) { ends_.emplace_back(unit, value); }
  const Point& best() const { return best_; }
  double value() const { return outcome_.value; }
  std::uint64_t trials() const { return outcome_.trials; }
  std::uint64_t left() const;
  bool stopped() const { return outcome_.stopped; }
  Outcome finish();

 private:
  const Problem& problem_;
  Outcome outcome_;
  Point best_;
  std::vector<std::pair<Point, double>> ends_;  // unit
};

/// Runs body(0) .. body(count - 1), on that many threads at most.
void for_each_task(int threads, std::size_t count, const std::function<void(std::size_t)>& body);

/// Evaluates each point once, in parallel, and absorbs them in order. Points beyond the budget are
/// left at +infinity.
std::vector<double> evaluate_all(const Problem& problem, Ledger& ledger, Record& record,
                                 std::span<const Point> units);

/// How optimisers begin. Without a free variable there is one point, and the task is done; else the
/// caller's starts are tried: the best of them in the unit cube, its middle where none is feasible.
Outcome only_point(const Problem& problem, Ledger& ledger, Record& record);
Point best_start(const Problem& problem, Ledger& ledger, Record& record);

/// Of points sorted by value, the first `most` that are at least `apart` from each other in the
/// unit cube (a root mean square distance per variable). Infeasible ones are left out.
std::vector<std::size_t> distinct(std::span<const Point> units, std::span<const double> values,
                                  double apart, std::size_t most);

/// Point i of an evenly spread endless sequence in the unit cube, shifted by `seed`
/// (Roberts' additive recurrence on the generalised golden ratio).
Point spread_point(std::uint64_t i, std::size_t dimension, std::uint64_t seed);

}  // namespace chiaro::optimise
