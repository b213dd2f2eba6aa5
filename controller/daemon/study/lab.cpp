// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/study/lab.h"

#include <limits>

namespace chiaro::daemon::study {
namespace {

design::Prepared prepared_for(const Stage& stage, const design::Goal& goal,
                              const design::Variables& all, core::Size size) {
  const design::Layers& layers = stage.twin->at(size);
  return design::prepare(stage.studio, goal, all, layers, layers, layers).full;
}

}  // namespace

core::Result<Stage> stage(std::string_view name, const Lamps& lamps, int threads,
                          ports::World& world) {
  auto studio = scene(name, lamps, world);
  if (!studio) return studio.problems();
  auto twin = twin_of(*studio, world, threads);
  if (!twin) return twin.problems();
  return Stage{std::string(name), *std::move(studio), *std::move(twin)};
}

Lab::Lab(const Stage& stage, const design::Goal& goal, core::Size size, Levels levels)
    : levels_(levels),
      all_(design::variables_of(stage.studio, design::Options{})),
      lamps_(design::searched(stage.studio, all_, goal)),
      prepared_(prepared_for(stage, goal, all_, size)),
      setting_{stage.studio,     prepared_.layers, lamps_,
               prepared_.target, prepared_.map,    design::Accuracy::cached},
      workspaces_(setting_) {}

std::vector<core::Range> Lab::bounds() const {
  std::vector<core::Range> bounds = lamps_.bounds();
  if (levels_ == Levels::searched)
    bounds.insert(bounds.end(), lamps_.limits.begin(), lamps_.limits.end());
  return bounds;
}

optimise::Point Lab::start() const {
  optimise::Point start = lamps_.point(lamps_.base);
  if (levels_ == Levels::searched)
    for (const core::Range& limit : lamps_.limits) start.push_back(limit.most / 2);
  return start;
}

studio::Rig Lab::rig(std::span<const double> point) const {
  const std::size_t places = lamps_.moving.size();
  const studio::Rig rig = lamps_.rig(point.first(places));
  return levels_ == Levels::searched ? design::with_levels(lamps_, rig, point.subspan(places))
                                     : rig;
}

optimise::Point Lab::point(const studio::Rig& rig) const {
  optimise::Point point = lamps_.point(rig);
  if (levels_ == Levels::searched)
    for (const std::size_t lamp : lamps_.lit)
      point.push_back(rig.states[lamp].get(core::Dof::intensity));
  return point;
}

double Lab::cost(std::span<const double> point) {
  auto workspace = workspaces_.borrow();
  const studio::Rig there = rig(point);
  const double cost = levels_ == Levels::searched
                          ? workspace->score(there).cost
                          : workspace->solve(there, design::Effort::quick).cost;
  workspaces_.give_back(std::move(workspace));
  return cost;
}

core::Plane Lab::picture(const studio::Rig& rig) {
  auto workspace = workspaces_.borrow();
  std::vector<double> levels;
  for (const std::size_t lamp : lamps_.lit)
    levels.push_back(rig.states[lamp].get(core::Dof::intensity));
  core::Plane out;
  design::mix(workspace->columns(rig), levels, out);
  workspaces_.give_back(std::move(workspace));
  return out;
}

measure::Components Lab::components(const studio::Rig& rig) {
  return measure::components_of_luminance(picture(rig), prepared_.map);
}

optimise::Outcome Lab::minimise(std::string_view optimiser, std::uint64_t trials,
                                std::uint64_t seed, int threads, const std::atomic<bool>& stop) {
  optimise::Task task;
  task.bounds = bounds();
  task.starts = {start()};
  task.trials = trials;
  task.seed = seed;
  task.threads = threads;
  task.stop = &stop;
  task.cost = [this](std::span<const double> point) { return cost(point); };
  return optimise::make_optimiser(optimiser)->minimise(task);
}

std::vector<double> best_by_trial(const optimise::Outcome& outcome, std::uint64_t trials) {
  std::vector<double> best(trials, std::numeric_limits<double>::quiet_NaN());
  std::size_t step = 0;
  double value = std::numeric_limits<double>::quiet_NaN();
  for (std::uint64_t t = 0; t < trials; ++t) {
    while (step < outcome.trace.size() && outcome.trace[step].trial <= t + 1)
      value = outcome.trace[step++].value;
    best[t] = value;
  }
  return best;
}

}  // namespace chiaro::daemon::study
