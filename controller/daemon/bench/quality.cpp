// SPDX-License-Identifier: Apache-2.0
// Time to quality. The yardstick searches places and levels together by simulated annealing, traces
// every lamp anew in every trial, on one thread. Each variant then changes one thing more. All are
// judged by one measure: the goal's cost at full size with exact shadows.
#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

#include "controller/daemon/bench/bench.h"
#include "controller/daemon/bench/stopwatch.h"
#include "controller/design/stages.h"
#include "controller/optimise/optimiser.h"

namespace chiaro::daemon::bench {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

struct Variant {
  const char* name;
  bool cached, levels_solved;
  const char* optimiser;
  core::Size size;
  int threads;
};

/// A rig that was the best so far, and when it was found.
struct Improvement {
  double seconds;
  studio::Rig rig;
};

design::Prepared prepared_for(const design::Layers& layers, const design::Goal& goal) {
  design::Target target = design::target_of(goal, layers.size());
  measure::PixelMap map = design::map_for(layers, target);
  return {layers, std::move(target), std::move(map)};
}

/// All that one search needs, from a twin of its own: no variant profits from another's cache.
class Search {
 public:
  Search(const Plan& plan, const design::LayersSource& twin, const Variant& variant)
      : variant_(variant),
        goal_(plan.mood),
        all_(design::variables_of(plan.studio, design::Options{})),
        lamps_(design::searched(plan.studio, all_, goal_)),
        prepared_(prepared_for(twin.at(variant.size), goal_)),
        setting_{
            plan.studio,   prepared_.layers,
            lamps_,        prepared_.target,
            prepared_.map, variant.cached ? design::Accuracy::cached : design::Accuracy::exact},
        workspaces_(setting_) {}

  std::vector<Improvement> run(std::uint64_t trials, std::uint64_t seed, ports::World& world) {
    const Stopwatch watch(world.clock);
    optimise::Task task;
    task.bounds = lamps_.bounds();
    optimise::Point start = lamps_.point(lamps_.base);
    if (!variant_.levels_solved)
      for (const core::Range& limit : lamps_.limits) {
        task.bounds.push_back(limit);
        start.push_back(limit.most / 2);
      }
    task.starts = {start};
    task.trials = trials;
    task.seed = seed;
    task.threads = variant_.threads;
    task.stop = &world.stop;
    task.cost = [&](std::span<const double> point) {
      auto [cost, rig] = tried(point);
      const std::lock_guard lock(mutex_);
      if (cost < best_) {
        best_ = cost;
        improvements_.push_back({watch.seconds(), std::move(rig)});
      }
      return cost;
    };
    optimise::make_optimiser(variant_.optimiser)->minimise(task);
    return std::move(improvements_);
  }

 private:
  std::pair<double, studio::Rig> tried(std::span<const double> point) {
    const studio::Rig rig = lamps_.rig(point.first(lamps_.moving.size()));
    const bool remembers = variant_.cached || variant_.levels_solved;
    auto workspace =
        remembers ? workspaces_.borrow() : std::make_unique<design::Workspace>(setting_);
    std::pair<double, studio::Rig> out;
    if (variant_.levels_solved) {
      const auto scored = workspace->solve(rig, design::Effort::quick);
      out = {scored.cost,
             std::isfinite(scored.cost) ? design::with_levels(lamps_, rig, scored.levels) : rig};
    } else {
      const auto lit = design::with_levels(lamps_, rig, point.subspan(lamps_.moving.size()));
      out = {workspace->score(lit).cost, lit};
    }
    if (remembers) workspaces_.give_back(std::move(workspace));
    return out;
  }

  const Variant variant_;
  const design::Goal goal_;
  const design::Variables all_, lamps_;
  const design::Prepared prepared_;
  const design::Setting setting_;
  design::Workspaces workspaces_;
  std::mutex mutex_;
  double best_ = kNever;
  std::vector<Improvement> improvements_;
};

/// The measure of record.
class Judge {
 public:
  Judge(const Plan& plan, const design::LayersSource& twin)
      : goal_(plan.mood),
        all_(design::variables_of(plan.studio, design::Options{})),
        lamps_(design::searched(plan.studio, all_, goal_)),
        prepared_(prepared_for(twin.at(plan.size), goal_)),
        setting_{plan.studio,      prepared_.layers, lamps_,
                 prepared_.target, prepared_.map,    design::Accuracy::exact},
        workspace_(setting_) {}
  double cost(const studio::Rig& rig) { return workspace_.score(rig).cost; }

 private:
  const design::Goal goal_;
  const design::Variables all_, lamps_;
  const design::Prepared prepared_;
  const design::Setting setting_;
  design::Workspace workspace_;
};

/// When the search first had a rig at least that good.
double time_to(double wanted, const std::vector<Improvement>& improvements, Judge& judge) {
  for (const Improvement& i : improvements)
    if (judge.cost(i.rig) <= wanted) return i.seconds;
  return kNever;
}

core::Result<std::vector<Improvement>> searched(const Plan& plan, const Variant& variant,
                                                std::uint64_t trials, std::uint64_t seed,
                                                ports::World& world) {
  const auto twin =
      design::geometric_layers(plan.studio, {.mesh_cache = world.state_folder / "meshes",
                                             .reference = !variant.cached,
                                             .threads = variant.threads});
  if (!twin) return twin.problems();
  return Search(plan, **twin, variant).run(trials, seed, world);
}

struct Reference {
  std::vector<double> seconds, costs;  // per seed: when its best was found, and how good it is
};

core::Result<Reference> reference_runs(const Plan& plan, const Variant& variant, Judge& judge,
                                       ports::World& world) {
  Reference out;
  for (int seed = 1; seed <= plan.seeds && !world.stop; ++seed) {
    world.err << "  reference, seed " << seed << " of " << plan.seeds << "\n" << std::flush;
    const auto found =
        searched(plan, variant, plan.reference_trials, static_cast<std::uint64_t>(seed), world);
    if (!found) return found.problems();
    if (found->empty()) continue;
    out.seconds.push_back(found->back().seconds);
    out.costs.push_back(judge.cost(found->back().rig));
  }
  return out;
}

}  // namespace

core::Result<core::Done> quality(const Plan& plan, ports::World& world, Report& report) {
  const core::Size small = design::Options{}.search_size;
  const Variant reference{
      "reference: annealing, all traced anew", false, false, "annealing", plan.size, 1};
  const Variant variants[] = {
      {"+ visibility cached, layers kept", true, false, "annealing", plan.size, 1},
      {"+ levels solved inside", true, true, "annealing", plan.size, 1},
      {"+ multi-start SBPLX", true, true, "sbplx", plan.size, 1},
      {"+ search on small pictures: the product, thread for thread", true, true, "sbplx", small, 1},
      {"+ two threads: what the product does", true, true, "sbplx", small, 2},
      {"the product without the cache", false, true, "sbplx", small, 2},
      {"the product without solving levels", true, false, "sbplx", small, 2},
      {"the product with annealing", true, true, "annealing", small, 2}};
  report.heading("Time to the quality that the reference's annealing reaches, medians over " +
                 std::to_string(plan.seeds) + " seeds");
  const auto twin =
      design::geometric_layers(plan.studio, {.mesh_cache = world.state_folder / "meshes"});
  if (!twin) return twin.problems();
  Judge judge(plan, **twin);
  const auto yard = reference_runs(plan, reference, judge, world);
  if (!yard) return yard.problems();
  if (world.stop) return core::Done{};
  report.add(reference.name, median(yard->seconds), "s", {},
             std::to_string(plan.reference_trials) + " trials, cost " +
                 std::to_string(median(yard->costs)));
  for (const Variant& variant : variants) {
    world.err << "  " << variant.name << "\n" << std::flush;
    std::vector<double> times, ratios;
    for (std::size_t k = 0; k < yard->costs.size() && !world.stop; ++k) {
      const auto found = searched(plan, variant, plan.reference_trials, k + 1, world);
      if (!found) return found.problems();
      times.push_back(time_to(yard->costs[k], *found, judge));
      ratios.push_back(times.back() > 0 ? yard->seconds[k] / times.back() : 0);
    }
    if (world.stop) break;  // half a variant says nothing
    const bool product = variant.threads == 2 && variant.cached && variant.levels_solved &&
                         std::string_view(variant.optimiser) == "sbplx";
    const auto reached =
        std::count_if(times.begin(), times.end(), [](double t) { return std::isfinite(t); });
    report.add(variant.name, median(times), "s", {},
               std::to_string(reached) + " of " + std::to_string(times.size()) + " reach it");
    report.add("  sooner than the reference", median(ratios), "x", product ? at_least(300) : Bar{});
  }
  return core::Done{};
}

}  // namespace chiaro::daemon::bench
