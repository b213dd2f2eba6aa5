// SPDX-License-Identifier: Apache-2.0
// Figures 5.6 to 5.14 [I-35]: three scenes, three targets each, two lamps, simulated annealing: how
// the wavelet distance falls, by the corrected and by the printed form, and the first 64
// coefficients of target and result.
#include <algorithm>
#include <cmath>
#include <mutex>
#include <ostream>

#include "controller/daemon/study/lab.h"
#include "controller/daemon/study/study.h"

namespace chiaro::daemon::study {
namespace {

constexpr core::Size kSize{64, 64};
constexpr std::size_t kCoefficients = 64;

/// Mean, then level by level from the whole picture down, all h, all v.
std::vector<double> first_coefficients(const measure::HaarSpectrum& spectrum) {
  std::vector<double> out{spectrum.mean};
  for (std::size_t level = 0; level < spectrum.horizontal.size(); ++level)
    for (const auto* values : {&spectrum.horizontal[level], &spectrum.vertical[level]})
      for (const float v : *values)
        if (out.size() < kCoefficients) out.push_back(static_cast<double>(v));
  return out;
}

measure::HaarSpectrum spectrum_of(const core::Plane& luminance) {
  return measure::haar_spectrum(measure::working_scalar(luminance), kSize.width);
}

struct Case {
  core::Plot distance, coefficients;
  double first = 0, last = 0, printed_first = 0, printed_last = 0;
};

core::Series steps(const std::string& name) {
  core::Series out{name, {}, {}};
  out.kind = core::Series::Kind::steps;
  return out;
}

Case run_case(Lab& lab, const std::string& title, std::uint64_t trials, std::uint64_t seed,
              const ports::World& world) {
  const measure::HaarSpectrum wanted = measure::haar_spectrum(lab.target().values, kSize.width);
  Case out;
  core::Series corrected = steps("corrected"), printed = steps("as printed (x 100)");
  optimise::Task task;
  task.bounds = lab.bounds();
  task.starts = {lab.start()};
  task.trials = trials;
  task.seed = seed;
  task.stop = &world.stop;
  double best = std::numeric_limits<double>::infinity();
  std::uint64_t trial = 0;
  optimise::Point found = lab.start();
  task.cost = [&](std::span<const double> point) {
    const double cost = lab.cost(point);
    ++trial;
    if (cost < best) {
      best = cost;
      found.assign(point.begin(), point.end());
      corrected.x.push_back(static_cast<double>(trial));
      corrected.y.push_back(cost);
      printed.x.push_back(static_cast<double>(trial));
      printed.y.push_back(100 * measure::haar_distance_as_printed(
                                    spectrum_of(lab.picture(lab.rig(point))), wanted));
    }
    return cost;
  };
  optimise::make_optimiser("annealing")->minimise(task);
  if (!corrected.y.empty()) {
    out.first = corrected.y.front(), out.last = corrected.y.back();
    out.printed_first = printed.y.front(), out.printed_last = printed.y.back();
    for (core::Series* s : {&corrected, &printed}) {
      s->x.push_back(static_cast<double>(trials));
      s->y.push_back(s->y.back());
    }
  }
  out.distance = {title, {"trial"}, {"distance from the target (grey levels)", false, 0, {}}};
  out.distance.series = {std::move(corrected), std::move(printed)};
  out.coefficients = {
      title + ": first 64 coefficients", {"coefficient (0 is the mean)"}, {"grey levels"}};
  core::Series target{"target", {}, first_coefficients(wanted)},
      result{"result", {}, first_coefficients(spectrum_of(lab.picture(lab.rig(found))))};
  for (std::size_t k = 0; k < kCoefficients; ++k) target.x.push_back(static_cast<double>(k));
  result.x = target.x;
  result.dashed = true;
  out.coefficients.series = {std::move(target), std::move(result)};
  return out;
}

}  // namespace

core::Result<Findings> run_chapter5(const Options& options, ports::World& world) {
  const int targets = options.items_or(3, 1);
  const std::uint64_t trials = options.quick ? 120 : 1000;
  Findings findings;
  Table table{"cases",
              "Wavelet distance at the first trial and the last",
              {"figure", "scene", "target", "first", "last", "printed_first", "printed_last"}};
  std::vector<Stage> stages;
  for (const std::string_view name : scene_names()) {
    auto made = stage(name, {2, {}}, options.threads, world);
    if (!made) return made.problems();
    stages.push_back(*std::move(made));
  }
  int fell = 0, both_fell = 0, cases = 0;
  for (std::size_t k = 0; k < stages.size(); ++k)
    for (int t = 0; t < targets; ++t) {
      if (world.stop) break;
      // As in the thesis: three targets a scene, 5.6 the first.
      const int figure = 6 + std::max(3, targets) * static_cast<int>(k) + t;
      // Targets come from the next scene: other objects in another light, as films are in the
      // thesis.
      const Stage& from = stages[(k + 1) % stages.size()];
      core::Random random(5, static_cast<std::uint64_t>(100 * k) + static_cast<std::uint64_t>(t));
      const auto geometry = twin::build_geometry(from.studio, world.state_folder / "meshes");
      if (!geometry) return geometry.problems();
      const studio::Rig rig = hidden_rig(from.studio, **geometry, core::radians(30), 3, random);
      design::ExampleGoal goal;
      goal.name = "target";
      goal.exemplar = photograph(from.studio, reality(from.studio, Errors{}, random, world), rig,
                                 {{128, 128},
                                  options.quick ? 8 : 24,
                                  static_cast<std::uint64_t>(figure),
                                  options.threads});
      world.err << "  figure 5." << figure << "\n" << std::flush;
      Lab lab(stages[k], goal, kSize, Levels::searched);
      const std::string title = "Figure 5." + std::to_string(figure) + ": " + stages[k].name +
                                ", target " + std::to_string(t + 1) + " (" + from.name + ")";
      const Case one = run_case(lab, title, trials, options.seed, world);
      table.rows.push_back({"5." + std::to_string(figure), stages[k].name, std::to_string(t + 1),
                            one.first, one.last, one.printed_first / 100, one.printed_last / 100});
      const std::string name = "figure-5." + std::to_string(figure);
      findings.drawings.push_back(drawing(name + "-distance", one.distance));
      findings.drawings.push_back(drawing(name + "-coefficients", one.coefficients));
      ++cases;
      fell += one.last < one.first;
      both_fell += one.last < one.first && one.printed_last < one.printed_first;
    }
  findings.claims.push_back({"figures 5.6 to 5.14: annealing brings the distance down in all nine",
                             "9 of 9", std::to_string(both_fell) + " of " + std::to_string(cases),
                             std::to_string(fell) + " of " + std::to_string(cases), fell == cases});
  findings.tables.push_back(std::move(table));
  findings.items = cases;
  return findings;
}

}  // namespace chiaro::daemon::study
