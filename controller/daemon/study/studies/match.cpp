// SPDX-License-Identifier: Apache-2.0
// The thesis's third experiment with machines for people [I-41]: of three results, which one was
// lit after this exemplar? The other two were lit after exemplars whose key stands 20 to 40 degrees
// elsewhere, or whose fill is a stop stronger or weaker. The judges share no term with either
// objective; exemplars and results are photographed by the path tracer, never by the twin.
#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>

#include "controller/core/statistics.h"
#include "controller/daemon/study/judges.h"
#include "controller/daemon/study/lab.h"
#include "controller/daemon/study/study.h"

namespace chiaro::daemon::study {
namespace {

using core::Dof;

constexpr std::array<const char*, 2> kMethods{"wavelet", "perceptual"};
constexpr std::array<design::Objective, 2> kObjectives{design::Objective::wavelet,
                                                       design::Objective::perceptual};
constexpr std::uint64_t kItemsSeed = 41;  ///< the items were fixed before anything was tuned

/// Three rigs whose exemplars an item shows: the wanted one and two that differ in one thing.
struct Item {
  studio::Rig wanted, other_key, other_ratio;
};

void place(core::FixtureState& state, double azimuth, double elevation, double distance) {
  state.set(Dof::azimuth, core::radians(azimuth));
  state.set(Dof::elevation, core::radians(elevation));
  state.set(Dof::distance, distance);
}
void give(const studio::Fixture& fixture, core::FixtureState& state, double lux) {
  state.set(Dof::intensity, 1);
  state.set(Dof::intensity, std::min(1.0, lux / lux_of(fixture, state)));
}

/// The key moved by 20 to 40 degrees in a direction that stays in its region.
core::FixtureState moved_key(const studio::Fixture& fixture, const core::FixtureState& key,
                             core::Random& random) {
  const auto& region = std::get<studio::StandMount>(fixture.mount).region;
  for (;;) {
    core::FixtureState moved = key;
    moved.set(Dof::azimuth, key.get(Dof::azimuth) + core::radians(random.uniform(-45, 45)));
    moved.set(Dof::elevation, key.get(Dof::elevation) + core::radians(random.uniform(-35, 35)));
    const double angle = core::degrees(core::angle_between(direction_of(key), direction_of(moved)));
    if (angle >= 20 && angle <= 40 && region.azimuth.contains(moved.get(Dof::azimuth)) &&
        region.elevation.contains(moved.get(Dof::elevation)))
      return moved;
  }
}

Item item_for(const studio::Studio& studio, int number) {
  core::Random random(kItemsSeed, static_cast<std::uint64_t>(number));
  const double side = random.uniform() < 0.5 ? -1 : 1, key_lux = random.uniform(600, 900);
  const double stops = random.uniform(1.2, 2.8);
  Item item{studio::placed_rig(studio), {}, {}};
  auto& lamps = item.wanted.states;
  place(lamps[0], side * random.uniform(20, 65), random.uniform(15, 55), random.uniform(1.5, 2.0));
  place(lamps[1], -side * random.uniform(15, 60), random.uniform(2, 30), random.uniform(1.6, 2.2));
  give(studio.fixtures[0], lamps[0], key_lux);
  give(studio.fixtures[1], lamps[1], key_lux * std::exp2(-stops));
  item.other_key = item.other_ratio = item.wanted;
  item.other_key.states[0] = moved_key(studio.fixtures[0], lamps[0], random);
  give(studio.fixtures[1], item.other_ratio.states[1],
       key_lux * std::exp2(-stops + (random.uniform() < 0.5 ? -1 : 1)));
  return item;
}

/// Which judges find the right one, of the item's three results.
struct Verdicts {
  std::array<bool, kJudges.size()> right{};
  bool majority() const {
    return 2 * std::count(right.begin(), right.end(), true) > static_cast<int>(kJudges.size());
  }
};
using ItemVerdicts = std::array<Verdicts, kMethods.size()>;

core::Result<ItemVerdicts> judge_item(const Stage& stage, int number, const Options& options,
                                      ports::World& world) {
  const Item item = item_for(stage.studio, number);
  core::Random random(options.seed, 1000 + static_cast<std::uint64_t>(number));
  const Reality real = reality(stage.studio, Errors{}, random, world);
  Shot shot{{128, 128},
            options.quick ? 10 : 20,
            options.seed * 10000 + static_cast<std::uint64_t>(number),
            options.threads};
  const std::array<const studio::Rig*, 3> rigs{&item.wanted, &item.other_key, &item.other_ratio};
  std::array<core::Picture, 3> exemplars;
  for (std::size_t k = 0; k < rigs.size(); ++k) {
    exemplars[k] = photograph(stage.studio, real, *rigs[k], shot);
    ++shot.seed;
  }
  const design::Layers& layers = stage.twin->at(shot.size);
  const measure::PixelMap map = measure::pixel_map(*layers.geometry());
  const Subject subject{*layers.geometry(), map};
  const core::Plane wanted = core::luminance(exemplars[0]);
  ItemVerdicts out;
  for (std::size_t m = 0; m < kMethods.size(); ++m) {
    std::array<std::array<double, 3>, kJudges.size()> distances{};
    for (std::size_t k = 0; k < rigs.size(); ++k) {
      design::ExampleGoal goal;
      goal.name = "exemplar";
      goal.exemplar = exemplars[k];
      goal.objective = kObjectives[m];
      const auto look = design::design(stage.studio, *stage.twin, goal,
                                       plain_options(options.seed, options.threads, world));
      if (!look) return look.problems();
      const core::Plane result =
          core::luminance(photograph(stage.studio, real, look->wanted, shot));
      ++shot.seed;
      for (std::size_t j = 0; j < kJudges.size(); ++j)
        distances[j][k] = kJudges[j].distance(subject, wanted, result);
    }
    for (std::size_t j = 0; j < kJudges.size(); ++j)
      out[m].right[j] = distances[j][0] < std::min(distances[j][1], distances[j][2]);
  }
  return out;
}

std::string share_in_words(std::size_t right, std::size_t all) {
  const core::Interval i = core::wilson_interval(right, all);
  char text[80];
  std::snprintf(text, sizeof text, "%.1f %% (%zu of %zu; %.0f to %.0f %%)",
                all > 0 ? 100.0 * static_cast<double>(right) / static_cast<double>(all) : 0, right,
                all, 100 * i.least, 100 * i.most);
  return text;
}

struct Counts {
  std::array<std::size_t, kJudges.size() + 1> right{};  ///< each judge, then the majority
};

void summarise(const std::vector<ItemVerdicts>& items, Findings& findings) {
  std::array<Counts, kMethods.size()> counts;
  std::size_t wavelet_only = 0, perceptual_only = 0;
  for (const ItemVerdicts& item : items) {
    for (std::size_t m = 0; m < kMethods.size(); ++m) {
      for (std::size_t j = 0; j < kJudges.size(); ++j) counts[m].right[j] += item[m].right[j];
      counts[m].right[kJudges.size()] += item[m].majority();
    }
    wavelet_only += item[0].majority() && !item[1].majority();
    perceptual_only += !item[0].majority() && item[1].majority();
  }
  const std::size_t n = items.size();
  Table table{"matches",
              "Items whose own result is found among three (chance: 33 %)",
              {"judge", "wavelet", "perceptual"}};
  core::Plot plot{"Results found by their exemplar", {"judge"}, {"found (%)", false, 0, 100}};
  for (std::size_t m = 0; m < kMethods.size(); ++m) {
    plot.series.push_back({kMethods[m], {}, {}});
    plot.series.back().kind = core::Series::Kind::bars;
  }
  for (std::size_t j = 0; j <= kJudges.size(); ++j) {
    const std::string judge = j < kJudges.size() ? std::string(kJudges[j].name) : "majority";
    plot.categories.push_back(judge);
    table.rows.push_back(
        {judge, share_in_words(counts[0].right[j], n), share_in_words(counts[1].right[j], n)});
    for (std::size_t m = 0; m < kMethods.size(); ++m) {
      core::Series& s = plot.series[m];
      const core::Interval i = core::wilson_interval(counts[m].right[j], n);
      s.x.push_back(static_cast<double>(j));
      s.y.push_back(100.0 * static_cast<double>(counts[m].right[j]) / static_cast<double>(n));
      s.least.push_back(100 * i.least);
      s.most.push_back(100 * i.most);
    }
  }
  plot.levels = {100.0 / 3, 95};
  findings.tables.push_back(std::move(table));
  findings.drawings.push_back(drawing("matches", plot));
  const std::size_t wavelet = counts[0].right.back(), perceptual = counts[1].right.back();
  const double p = core::sign_test(wavelet_only, perceptual_only);
  char paired[120];
  std::snprintf(paired, sizeof paired, "wavelet alone %zu, perceptual alone %zu, p = %.2g",
                wavelet_only, perceptual_only, p);
  findings.bars.push_back({"wavelet found by the majority of judges", share_in_words(wavelet, n),
                           "at least 95 %",
                           static_cast<double>(wavelet) >= 0.95 * static_cast<double>(n)});
  findings.bars.push_back({"wavelet not worse than perceptual (McNemar, exact)", paired,
                           "not worse", !(perceptual_only > wavelet_only && p < 0.05)});
  findings.claims.push_back({"experiment 3: wavelet results are recognised", "95.88 %", "-",
                             share_in_words(wavelet, n),
                             core::wilson_interval(wavelet, n).most >= 0.9588});
  findings.claims.push_back({"experiment 3: perceptual results are recognised", "80.29 %", "-",
                             share_in_words(perceptual, n),
                             core::wilson_interval(perceptual, n).most >= 0.8029 &&
                                 core::wilson_interval(perceptual, n).least <= 0.8029});
  findings.claims.push_back({"experiment 3: wavelet above perceptual", "95.88 against 80.29 %", "-",
                             paired, wavelet >= perceptual});
}

}  // namespace

core::Result<Findings> run_match(const Options& options, ports::World& world) {
  const int items = options.items_or(30, 6);
  std::vector<Stage> stages;
  for (const std::string_view name : scene_names()) {
    if (static_cast<int>(stages.size()) >= items) break;
    auto made = stage(name, {2, {}}, options.threads, world);
    if (!made) return made.problems();
    stages.push_back(*std::move(made));
  }
  std::vector<ItemVerdicts> all;
  Table every{"items",
              "Every item",
              {"item", "scene", "method", "illumination", "structure", "regions", "majority"},
              {},
              false};
  for (int i = 0; i < items && !world.stop; ++i) {
    world.err << "  item " << i + 1 << " of " << items << "\n" << std::flush;
    const Stage& at = stages[static_cast<std::size_t>(i) % stages.size()];
    auto verdicts = judge_item(at, i, options, world);
    if (!verdicts) return verdicts.problems();
    all.push_back(*verdicts);
    for (std::size_t m = 0; m < kMethods.size(); ++m) {
      const Verdicts& v = all.back()[m];
      every.rows.push_back({static_cast<double>(i + 1), at.name, kMethods[m],
                            static_cast<double>(v.right[0]), static_cast<double>(v.right[1]),
                            static_cast<double>(v.right[2]), static_cast<double>(v.majority())});
    }
  }
  Findings findings;
  findings.items = static_cast<int>(all.size());
  if (!all.empty()) summarise(all, findings);
  findings.tables.push_back(std::move(every));
  return findings;
}

}  // namespace chiaro::daemon::study
