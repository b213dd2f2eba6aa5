// SPDX-License-Identifier: Apache-2.0
// Experiment 1 [I-39]: the 64 settings of the six weights [I-12], each lighting our scenes, and how
// well the pictures show their subjects by measures that are in no objective. Setting 45 won the
// thesis's vote.
#include <algorithm>
#include <numeric>
#include <ostream>

#include "controller/core/statistics.h"
#include "controller/daemon/study/judges.h"
#include "controller/daemon/study/lab.h"
#include "controller/daemon/study/study.h"

namespace chiaro::daemon::study {
namespace {

constexpr int kSettings = 64, kWinner = 45;
constexpr core::Size kSize{64, 64};

/// Six bits e m g v h c, the most significant first; a 1 is 0.2, a 0 is 0.8.
measure::TermWeights weights_of(int setting) {
  const auto weight = [&](int bit) { return (setting >> bit) & 1 ? 0.2 : 0.8; };
  measure::TermWeights weights;
  weights.edge = weight(5);
  weights.mean = weight(4);
  weights.gradient = weight(3);
  weights.variance = weight(2);
  weights.histogram = weight(1);
  weights.contrast = weight(0);
  return weights;
}

}  // namespace

core::Result<Findings> run_weights(const Options& options, ports::World& world) {
  const auto trials = static_cast<std::uint64_t>(options.items_or(160, 24));
  const std::size_t scenes = options.quick ? 1 : scene_names().size();
  std::vector<double> score(kSettings, 0);
  Table every{"settings",
              "Every setting on every scene",
              {"setting", "scene", "edge", "mean", "gradient", "variance", "histogram", "contrast",
               "shape", "edge_f1", "entropy_bits", "clipped", "overall"},
              {},
              false};
  for (std::size_t k = 0; k < scenes; ++k) {
    auto made = stage(scene_names()[k], {2, {}}, options.threads, world);
    if (!made) return made.problems();
    const design::Layers& layers = made->twin->at(kSize);
    const measure::PixelMap map = measure::pixel_map(*layers.geometry());
    const Subject subject{*layers.geometry(), map};
    for (int setting = 0; setting < kSettings && !world.stop; ++setting) {
      if (setting % 16 == 0)
        world.err << "  " << made->name << ", setting " << setting << "\n" << std::flush;
      design::IdealGoal goal;
      goal.weights = weights_of(setting);
      Lab lab(*made, goal, kSize, Levels::solved);
      const auto found = lab.minimise("sbplx", trials, options.seed, options.threads, world.stop);
      Lab lit(*made, goal, kSize, Levels::searched);
      design::Options still = plain_options(options.seed, options.threads, world);
      still.move_stands = false;
      still.start = lab.rig(found.best.empty() ? lab.start() : found.best);
      still.full_size = still.polish_size = still.search_size = kSize;
      const auto look = design::design(made->studio, *made->twin, goal, still);
      if (!look) return look.problems();
      const Shown one = shown(subject, lit.picture(look->wanted));
      score[static_cast<std::size_t>(setting)] += overall(one) / static_cast<double>(scenes);
      const measure::TermWeights& w = goal.weights;
      every.rows.push_back({static_cast<double>(setting), made->name, w.edge, w.mean, w.gradient,
                            w.variance, w.histogram, w.contrast, one.shape, one.edges, one.entropy,
                            one.clipped, overall(one)});
    }
  }
  std::vector<int> order(kSettings);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return score[static_cast<std::size_t>(a)] > score[static_cast<std::size_t>(b)];
  });
  const auto rank = std::find(order.begin(), order.end(), kWinner) - order.begin() + 1;
  Findings findings;
  Table best{"ranking",
             "The best ten settings, and the thesis's winner",
             {"rank", "setting", "edge mean gradient variance histogram contrast", "overall"}};
  for (int r = 0; r < kSettings; ++r) {
    const int setting = order[static_cast<std::size_t>(r)];
    if (r >= 10 && setting != kWinner) continue;
    const measure::TermWeights w = weights_of(setting);
    char text[64];
    std::snprintf(text, sizeof text, "%.1f %.1f %.1f %.1f %.1f %.1f", w.edge, w.mean, w.gradient,
                  w.variance, w.histogram, w.contrast);
    best.rows.push_back({static_cast<double>(r + 1), static_cast<double>(setting),
                         std::string(text), score[static_cast<std::size_t>(setting)]});
  }
  core::Plot plot{
      "64 settings of the weights (setting 45, the thesis's winner, in the second colour)",
      {"setting"},
      {"overall, mean over scenes"}};
  plot.width = 1100;
  core::Series others{"others", {}, {}}, winner{"setting 45", {}, {}};
  others.kind = winner.kind = core::Series::Kind::points;
  for (int s = 0; s < kSettings; ++s) {
    core::Series& series = s == kWinner ? winner : others;
    series.x.push_back(s);
    series.y.push_back(score[static_cast<std::size_t>(s)]);
  }
  plot.series = {std::move(others), std::move(winner)};
  findings.claims.push_back({"experiment 1: setting 45 is rated best of 64", "4.20 of 5, rank 1",
                             "-", "rank " + std::to_string(rank) + " by machine judges",
                             rank == 1});
  findings.tables = {std::move(best), std::move(every)};
  findings.drawings.push_back(drawing("figure-7.2", plot));
  findings.items = static_cast<int>(trials);
  return findings;
}

}  // namespace chiaro::daemon::study
