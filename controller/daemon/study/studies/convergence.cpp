// SPDX-License-Identifier: Apache-2.0
// Figures 3.11 and 3.13: the genetic algorithm's best member over its generations, and the three
// optimisers of the thesis, as printed [I-25..I-27], with the product's own beside them: the mean
// over runs on several scenes, places and levels searched together.
#include <cmath>
#include <map>
#include <ostream>

#include "controller/core/statistics.h"
#include "controller/daemon/study/lab.h"
#include "controller/daemon/study/study.h"

namespace chiaro::daemon::study {
namespace {

constexpr core::Size kSize{64, 64};
constexpr std::uint64_t kMembers = 30;
constexpr const char* kNames[] = {"descent", "genetic", "annealing", "sbplx", "cmaes"};

/// Means and deviations over runs at every trial.
struct Curve {
  std::vector<double> mean, deviation;
};
Curve averaged(const std::vector<std::vector<double>>& runs, std::uint64_t trials) {
  Curve out;
  for (std::size_t t = 0; t < trials; ++t) {
    std::vector<double> here;
    for (const auto& run : runs)
      if (std::isfinite(run[t])) here.push_back(run[t]);
    out.mean.push_back(here.empty() ? std::nan("") : core::mean(here));
    out.deviation.push_back(core::standard_deviation(here));
  }
  return out;
}

core::Series series_of(const std::string& name, const std::vector<double>& values,
                       std::size_t every) {
  core::Series out{name, {}, {}};
  for (std::size_t t = 0; t < values.size(); t += every) {
    out.x.push_back(static_cast<double>(t + 1));
    out.y.push_back(values[t]);
  }
  return out;
}

core::Plot generations(const std::vector<std::vector<double>>& runs, std::uint64_t trials) {
  const Curve curve = averaged(runs, trials);
  core::Plot plot{"Genetic algorithm, 30 members: the best member, mean of the runs",
                  {"generation"},
                  {"F of the best member"}};
  core::Series best{"mean", {}, {}}, low{"mean - deviation", {}, {}},
      high{"mean + deviation", {}, {}};
  low.dashed = high.dashed = true;
  for (std::size_t t = kMembers - 1, g = 0; t < curve.mean.size(); t += kMembers, ++g) {
    best.x.push_back(static_cast<double>(g));
    best.y.push_back(curve.mean[t]);
    low.y.push_back(curve.mean[t] - curve.deviation[t]);
    high.y.push_back(curve.mean[t] + curve.deviation[t]);
  }
  low.x = high.x = best.x;
  plot.series = {std::move(best), std::move(low), std::move(high)};
  return plot;
}

}  // namespace

core::Result<Findings> run_convergence(const Options& options, ports::World& world) {
  const int runs = options.items_or(10, 2);
  const std::uint64_t trials = options.quick ? 150 : 900;
  const std::size_t scenes = options.quick ? 1 : scene_names().size();
  std::map<std::string, std::vector<std::vector<double>>> curves;
  Table every{"runs", "Every run", {"scene", "optimiser", "run", "final_F"}, {}, false};
  std::map<std::string, std::vector<double>> finals;
  for (std::size_t k = 0; k < scenes; ++k) {
    auto made = stage(scene_names()[k], {2, {}}, options.threads, world);
    if (!made) return made.problems();
    Lab lab(*made, design::IdealGoal{}, kSize, Levels::searched);
    for (const char* name : kNames) {
      world.err << "  " << made->name << ", " << name << "\n" << std::flush;
      for (int run = 0; run < runs && !world.stop; ++run) {
        const auto found =
            lab.minimise(name, trials, options.seed + static_cast<std::uint64_t>(run),
                         options.threads, world.stop);
        curves[name].push_back(best_by_trial(found, trials));
        finals[name].push_back(found.value);
        every.rows.push_back(
            {made->name, std::string(name), static_cast<double>(run + 1), found.value});
      }
    }
  }
  Findings findings;
  Table table{"finals",
              "F after " + std::to_string(trials) + " trials, and the trials to within 1 % of that",
              {"optimiser", "mean_F", "deviation", "trials_to_1%"}};
  core::Plot plot{
      "Optimisers on ideal lighting: mean over scenes and runs", {"trial"}, {"best F so far"}};
  std::map<std::string, double> mean, soon;
  for (const char* name : kNames) {
    const Curve curve = averaged(curves[name], trials);
    mean[name] = core::mean(finals[name]);
    std::vector<double> when;
    for (std::size_t r = 0; r < curves[name].size(); ++r) {
      std::size_t t = 0;
      while (t + 1 < trials && !(curves[name][r][t] <= 1.01 * finals[name][r])) ++t;
      when.push_back(static_cast<double>(t + 1));
    }
    soon[name] = core::median(when);
    table.rows.push_back(
        {std::string(name), mean[name], core::standard_deviation(finals[name]), soon[name]});
    plot.series.push_back(series_of(name, curve.mean, std::max<std::size_t>(1, trials / 300)));
  }
  const auto order = [&] {
    char text[96];
    std::snprintf(text, sizeof text, "SA %.4f, GA %.4f, greedy %.4f", mean["annealing"],
                  mean["genetic"], mean["descent"]);
    return std::string(text);
  }();
  findings.claims.push_back(
      {"figure 3.13: SA at least as good as GA, GA better than greedy (final F)",
       "SA <= GA < greedy", order, "-",
       mean["annealing"] <= mean["genetic"] && mean["genetic"] < mean["descent"]});
  char speed[96];
  std::snprintf(speed, sizeof speed, "SA %.0f, GA %.0f, greedy %.0f trials", soon["annealing"],
                soon["genetic"], soon["descent"]);
  findings.claims.push_back({"figure 3.13: steepest descent converges fastest", "-", speed, "-",
                             soon["descent"] <= std::min(soon["genetic"], soon["annealing"])});
  findings.tables = {std::move(table), std::move(every)};
  findings.drawings.push_back(drawing("figure-3.13", plot));
  findings.drawings.push_back(drawing("figure-3.11", generations(curves["genetic"], trials)));
  findings.items = runs;
  return findings;
}

}  // namespace chiaro::daemon::study
