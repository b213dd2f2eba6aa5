// SPDX-License-Identifier: Apache-2.0
#include "controller/design/search.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "controller/optimise/search.h"

namespace chiaro::design {
namespace {

// Basins worth a look at the larger size: the best, and others that cost hardly more.
constexpr std::size_t kPolished = 3;
constexpr double kHardlyMore = 1.1;
// How far from a coarse basin its larger optimum may lie, as a share of each variable's range.
constexpr double kNeighbourhood = 0.08;
constexpr std::uint64_t kPolishTrials = 12;  // per variable and basin
constexpr std::uint64_t kAsLongAsTimeLasts = 50'000'000;

std::uint64_t wanted_trials(const Options& options, std::size_t variables) {
  if (options.trials > 0) return options.trials;
  return options.budget_s ? kAsLongAsTimeLasts : default_trials(variables);
}

optimise::Outcome minimise(const optimise::Task& task, const Options& options) {
  return optimise::make_optimiser(options.optimiser)->minimise(task);
}

optimise::Task task_for(const Setting& setting, Workspaces& workspaces, const Options& options,
                        Watch& watch) {
  optimise::Task task;
  task.bounds = setting.variables.bounds();
  task.seed = options.seed;
  task.threads = options.threads;
  task.stop = watch.flag();
  task.progress = [&watch](std::uint64_t trials, double best) { watch.report(trials, best); };
  task.cost = [&setting, &workspaces, &watch](std::span<const double> point) {
    watch.over();
    auto workspace = workspaces.borrow();
    const double cost = workspace->solve(setting.variables.rig(point), Effort::quick).cost;
    workspaces.give_back(std::move(workspace));
    return cost;
  };
  return task;
}

/// The bounds, narrowed to what lies near a point.
std::vector<core::Range> near(const std::vector<core::Range>& bounds,
                              const optimise::Point& point) {
  std::vector<core::Range> narrow = bounds;
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    const double reach = kNeighbourhood * bounds[i].width();
    narrow[i] = {bounds[i].clamp(point[i] - reach), bounds[i].clamp(point[i] + reach)};
  }
  return narrow;
}

}  // namespace

std::uint64_t default_trials(std::size_t variables) {
  return variables == 0 ? 1 : 200 + 70 * static_cast<std::uint64_t>(variables);
}

std::vector<Found> search(const Setting& coarse, const Options& options, Watch& watch) {
  if (coarse.variables.moving.empty()) return {Found{{}, 0}};
  Workspaces workspaces(coarse);
  const std::uint64_t budget = wanted_trials(options, coarse.variables.moving.size());
  watch.begin("search", budget);
  const Starts starts = starts_for(coarse, workspaces, options.threads, watch);
  watch.end(starts.trials);
  optimise::Task task = task_for(coarse, workspaces, options, watch);
  task.starts = starts.points;
  task.trials = budget > starts.trials ? budget - starts.trials : 1;
  const optimise::Outcome outcome = minimise(task, options);
  watch.end(outcome.trials);

  std::vector<Found> basins{{outcome.best, outcome.value}};
  for (const auto& [point, value] : outcome.basins)
    if (std::isfinite(value) && point != outcome.best) basins.push_back({point, value});
  return basins;
}

namespace {

/// One basin's neighbourhood, searched by one thread: several are searched at once.
optimise::Outcome polished(const Setting& full, Workspaces& workspaces, const Found& basin,
                           std::uint64_t trials, std::atomic<std::uint64_t>& tried,
                           const Options& options, Watch& watch) {
  optimise::Task task = task_for(full, workspaces, options, watch);
  task.progress = [&](std::uint64_t, double best) { watch.report(++tried, best); };
  task.bounds = near(task.bounds, basin.point);
  task.starts = {basin.point};
  task.threads = 1;
  task.trials = trials;
  // A time stop leaves the coarse answer: its neighbourhood was not looked at, its cost was.
  if (trials == 1) task.stop = nullptr;
  return minimise(task, options);
}

}  // namespace

Found polish(const Setting& full, const std::vector<Found>& basins, const Options& options,
             Watch& watch) {
  Found best = basins.front();
  if (full.variables.moving.empty() || !std::isfinite(best.cost)) return best;
  std::size_t count = 1;
  while (!watch.over() && count < std::min(kPolished, basins.size()) &&
         basins[count].cost <= kHardlyMore * best.cost)
    ++count;
  const std::uint64_t trials = watch.over() ? 1 : kPolishTrials * full.variables.moving.size();
  watch.begin("polish", trials * count);
  Workspaces workspaces(full);
  std::vector<optimise::Outcome> outcomes(count);
  std::atomic<std::uint64_t> tried{0};
  optimise::for_each_task(options.threads, count, [&](std::size_t i) {
    outcomes[i] = polished(full, workspaces, basins[i], trials, tried, options, watch);
  });
  watch.end(tried);
  best.cost = std::numeric_limits<double>::infinity();
  for (const optimise::Outcome& outcome : outcomes)
    if (outcome.value < best.cost) best = {outcome.best, outcome.value};
  return best;
}

ReferenceFound reference_search(const Setting& full, const Options& options, Watch& watch) {
  const Variables& variables = full.variables;
  const std::size_t places = variables.moving.size();
  const auto rig_of = [&](std::span<const double> point) {
    return with_levels(variables, variables.rig(point.first(places)), point.subspan(places));
  };
  optimise::Task task;
  task.bounds = variables.bounds();
  task.bounds.insert(task.bounds.end(), variables.limits.begin(), variables.limits.end());
  task.seed = options.seed;
  task.stop = watch.flag();
  task.trials = wanted_trials(options, task.bounds.size());
  task.progress = [&](std::uint64_t trials, double best) { watch.report(trials, best); };
  task.cost = [&](std::span<const double> point) {
    watch.over();
    // A workspace of its own: the reference remembers nothing from trial to trial.
    return Workspace(full).score(rig_of(point)).cost;
  };
  optimise::Point start = variables.point(variables.base);
  for (const core::Range& limit : variables.limits) start.push_back(limit.most / 2);
  task.starts = {start};
  watch.begin("search", task.trials);
  const optimise::Outcome outcome = minimise(task, options);
  watch.end(outcome.trials);
  return {rig_of(outcome.best.empty() ? start : outcome.best), outcome.value};
}

}  // namespace chiaro::design
