// SPDX-License-Identifier: Apache-2.0
#include "controller/optimise/search.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include "controller/core/random.h"

namespace chiaro::optimise {
namespace {

/// Ends nearer than this to a better one are the same basin.
constexpr double kBasinsApart = 0.03;
constexpr std::size_t kMostBasins = 8;

double distance(std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return a.empty() ? 0 : std::sqrt(sum / static_cast<double>(a.size()));
}

}  // namespace

Problem::Problem(const Task& task) : task_(task) {
  for (std::size_t i = 0; i < task.bounds.size(); ++i)
    if (task.bounds[i].width() > 0) free_.push_back(i);
}

Point Problem::point_of(std::span<const double> unit) const {
  Point out(task_.bounds.size());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = task_.bounds[i].least;
  for (std::size_t k = 0; k < free_.size(); ++k) {
    const core::Range& b = task_.bounds[free_[k]];
    out[free_[k]] = b.clamp(b.least + unit[k] * b.width());
  }
  return out;
}

Point Problem::unit_of(std::span<const double> point) const {
  Point out(free_.size());
  for (std::size_t k = 0; k < free_.size(); ++k) {
    const core::Range& b = task_.bounds[free_[k]];
    out[k] = (b.clamp(point[free_[k]]) - b.least) / b.width();
  }
  return out;
}

double Problem::cost(std::span<const double> unit) const {
  const double value = task_.cost(point_of(unit));
  return std::isnan(value) ? std::numeric_limits<double>::infinity() : value;
}

double Problem::cost(std::span<const double> unit, std::span<double> gradient) const {
  Point whole(task_.bounds.size());
  const double value = task_.gradient(point_of(unit), whole);
  for (std::size_t k = 0; k < free_.size(); ++k)
    gradient[k] = whole[free_[k]] * task_.bounds[free_[k]].width();
  return std::isnan(value) ? std::numeric_limits<double>::infinity() : value;
}

void Ledger::finished(double value) {
  if (!task_.progress) return;
  const std::lock_guard lock(mutex_);
  best_ = std::min(best_, value);
  task_.progress(++trials_, best_);
}

template <class Cost>
double Run::tried(std::span<const double> unit, const Cost& cost) {
  stopped_ = stopped_ || ledger_->stopped();
  if (stopped_ || used_ >= budget_) return std::numeric_limits<double>::infinity();
  const double value = cost();
  ++used_;
  if (best_.empty() || value < value_) {
    best_.assign(unit.begin(), unit.end());
    value_ = value;
    steps_.push_back({used_, value});
  }
  ledger_->finished(value);
  return value;
}

double Run::evaluate(std::span<const double> unit) {
  return tried(unit, [&] { return problem_->cost(unit); });
}

double Run::evaluate(std::span<const double> unit, std::span<double> gradient) {
  std::fill(gradient.begin(), gradient.end(), 0.0);
  return tried(unit, [&] { return problem_->cost(unit, gradient); });
}

void Record::absorb(const Run& run, bool is_basin) {
  outcome_.stopped = outcome_.stopped || run.stopped();
  if (run.used() > 0) {
    for (const Outcome::Step& step : run.steps())
      if (step.value < outcome_.value)
        outcome_.trace.push_back({outcome_.trials + step.trial, outcome_.value = step.value});
    // A first infeasible point is still an answer of the right length.
    if (best_.empty() || run.value() <= outcome_.value) best_ = run.best();
    if (is_basin && std::isfinite(run.value())) ends_.emplace_back(run.best(), run.value());
  }
  outcome_.trials += run.used();
}

std::uint64_t Record::left() const {
  const std::uint64_t budget = problem_.task().trials;
  return budget > outcome_.trials ? budget - outcome_.trials : 0;
}

Outcome Record::finish() {
  const Task& task = problem_.task();
  outcome_.stopped = outcome_.stopped || (task.stop && task.stop->load(std::memory_order_relaxed));
  if (best_.empty())
    best_ = task.starts.empty() ? Point(problem_.dimension(), 0.5)
                                : problem_.unit_of(task.starts.front());
  outcome_.best = problem_.point_of(best_);
  std::vector<Point> units;
  std::vector<double> values;
  if (std::isfinite(outcome_.value)) ends_.emplace_back(best_, outcome_.value);
  for (const auto& [unit, value] : ends_) {
    units.push_back(unit);
    values.push_back(value);
  }
  for (const std::size_t k : distinct(units, values, kBasinsApart, kMostBasins))
    outcome_.basins.emplace_back(problem_.point_of(units[k]), values[k]);
  return std::move(outcome_);
}

void for_each_task(int threads, std::size_t count, const std::function<void(std::size_t)>& body) {
  if (threads <= 1 || count <= 1) {
    for (std::size_t i = 0; i < count; ++i) body(i);
    return;
  }
  // More than the machine has would only make TBB complain.
  tbb::task_arena arena(std::min(threads, tbb::info::default_concurrency()));
  arena.execute([&] { tbb::parallel_for(std::size_t{0}, count, body, tbb::simple_partitioner{}); });
}

std::vector<double> evaluate_all(const Problem& problem, Ledger& ledger, Record& record,
                                 std::span<const Point> units) {
  std::vector<double> values(units.size(), std::numeric_limits<double>::infinity());
  const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(units.size(), record.left()));
  std::vector<Run> runs(count, Run(problem, ledger, 1));
  for_each_task(problem.task().threads, count,
                [&](std::size_t i) { values[i] = runs[i].evaluate(units[i]); });
  for (const Run& run : runs) record.absorb(run, false);
  return values;
}

Outcome only_point(const Problem& problem, Ledger& ledger, Record& record) {
  evaluate_all(problem, ledger, record, std::vector<Point>{{}});
  return record.finish();
}

Point best_start(const Problem& problem, Ledger& ledger, Record& record) {
  std::vector<Point> starts;
  for (const Point& start : problem.task().starts) starts.push_back(problem.unit_of(start));
  evaluate_all(problem, ledger, record, starts);
  return std::isfinite(record.value()) ? record.best() : Point(problem.dimension(), 0.5);
}

std::vector<std::size_t> distinct(std::span<const Point> units, std::span<const double> values,
                                  double apart, std::size_t most) {
  std::vector<std::size_t> order(units.size()), chosen;
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  for (const std::size_t k : order) {
    if (chosen.size() == most || !std::isfinite(values[k])) break;
    const bool near = std::any_of(chosen.begin(), chosen.end(), [&](std::size_t other) {
      return distance(units[k], units[other]) < apart;
    });
    if (!near) chosen.push_back(k);
  }
  return chosen;
}

Point spread_point(std::uint64_t i, std::size_t dimension, std::uint64_t seed) {
  double ratio = 2;
  for (int k = 0; k < 40; ++k)
    ratio = std::pow(1 + ratio, 1 / (static_cast<double>(dimension) + 1));
  core::Random random(seed, 0x5eed);
  Point out(dimension);
  double step = 1;
  for (double& x : out) {
    step /= ratio;
    const double at = random.uniform() + static_cast<double>(i + 1) * step;
    x = at - std::floor(at);
  }
  return out;
}

}  // namespace chiaro::optimise
