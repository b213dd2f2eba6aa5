// SPDX-License-Identifier: Apache-2.0
// The thesis's second experiment with measures for people [I-40]: the extended objective against
// Shacked and Lischinski's five terms, and against what anybody could do without a computer.
#include <cmath>
#include <ostream>

#include "controller/core/statistics.h"
#include "controller/daemon/study/judges.h"
#include "controller/daemon/study/lab.h"
#include "controller/daemon/study/study.h"

namespace chiaro::daemon::study {
namespace {

using core::Dof;

constexpr core::Size kSize{128, 128};
constexpr const char* kWays[] = {"extended", "five terms", "flat", "one key at 45", "three-point"};
constexpr std::size_t kWayCount = std::size(kWays);

void put(const Stage& at, studio::Rig& rig, std::size_t lamp, double azimuth, double elevation,
         double lux) {
  core::FixtureState& state = rig.states[lamp];
  state.set(Dof::azimuth, core::radians(azimuth));
  state.set(Dof::elevation, core::radians(elevation));
  state.set(Dof::distance, 1.8);
  state.set(Dof::intensity, 1);
  state.set(Dof::intensity,
            lux > 0 ? std::min(1.0, lux / lux_of(at.studio.fixtures[lamp], state)) : 0);
}

/// Two lamps beside the camera; one at 45 degrees; key, fill a stop and a half below, back light.
studio::Rig by_rule(const Stage& at, std::size_t way) {
  studio::Rig rig = studio::placed_rig(at.studio);
  const bool flat = way == 2, three = way == 4;
  put(at, rig, 0, flat ? -12 : -45, flat ? 8 : 40, flat ? 400 : 700);
  put(at, rig, 1, flat ? 12 : 40, flat ? 8 : 15, flat ? 400 : three ? 700 / 2.83 : 0);
  rig.states[2].set(Dof::intensity, three ? 0.25 : 0);
  return rig;
}

/// A key and a fill in front, a third lamp above and behind.
core::Result<Stage> stage_with_back(std::string_view name, int threads, ports::World& world) {
  auto made = stage(name, {3, {}}, threads, world);
  if (!made) return made;
  studio::Fixture& back = made->studio.fixtures[2];
  back.role = studio::Role::back;
  studio::StandMount mount;
  mount.at = {core::radians(160), core::radians(45), 1.8};
  mount.region = {
      {core::radians(120), core::radians(180)}, {core::radians(30), core::radians(70)}, {1.8, 1.8}};
  back.mount = mount;
  auto twin = twin_of(made->studio, world, threads);
  if (!twin) return twin.problems();
  made->twin = *std::move(twin);
  return made;
}

core::Result<studio::Rig> rig_of(const Stage& at, std::size_t way, std::uint64_t seed,
                                 const Options& options, ports::World& world) {
  if (way >= 2) return by_rule(at, way);
  design::IdealGoal goal;
  design::Options plain = plain_options(seed, options.threads, world);
  if (way == 1) {
    goal.weights.contrast = 0;
    plain.locked = {at.studio.fixtures[2].name};  // no second stage: their framework had none
    studio::Rig dark = studio::placed_rig(at.studio);
    dark.states[2].set(Dof::intensity, 0);
    plain.start = dark;
  }
  if (options.quick) plain.trials = 80;
  const auto look = design::design(at.studio, *at.twin, goal, plain);
  if (!look) return look.problems();
  return look->wanted;
}

}  // namespace

core::Result<Findings> run_ideal(const Options& options, ports::World& world) {
  const int seeds = options.items_or(5, 1);
  Table every{"pictures",
              "Every picture",
              {"scene", "seed", "lighting", "shape", "edge_f1", "entropy_bits", "clipped",
               "overall", "back_level"},
              {},
              false};
  std::vector<Shown> sums[kWayCount];
  std::vector<double> better;  // extended minus five terms, per scene and seed
  std::size_t wins = 0, losses = 0;
  for (const std::string_view name : scene_names()) {
    auto made = stage_with_back(name, options.threads, world);
    if (!made) return made.problems();
    const design::Layers& layers = made->twin->at(kSize);
    const measure::PixelMap map = measure::pixel_map(*layers.geometry());
    const Subject subject{*layers.geometry(), map};
    core::Random none(1);
    const Reality real = reality(made->studio, kNoErrors, none, world);
    for (int s = 0; s < seeds && !world.stop; ++s) {
      world.err << "  " << name << ", seed " << s + 1 << " of " << seeds << "\n" << std::flush;
      double extended = 0, five = 0;
      for (std::size_t way = 0; way < kWayCount; ++way) {
        if (way >= 2 && s > 0) continue;  // rules know no seed
        const auto rig =
            rig_of(*made, way, options.seed + static_cast<std::uint64_t>(s), options, world);
        if (!rig) return rig.problems();
        const core::Plane picture = core::luminance(photograph(
            made->studio, real, *rig, {kSize, options.quick ? 8 : 24, 1, options.threads}));
        const Shown one = shown(subject, picture);
        sums[way].push_back(one);
        every.rows.push_back({std::string(name), static_cast<double>(s + 1),
                              std::string(kWays[way]), one.shape, one.edges, one.entropy,
                              one.clipped, overall(one), rig->states[2].get(Dof::intensity)});
        if (way == 0) extended = overall(one);
        if (way == 1) five = overall(one);
      }
      better.push_back(extended - five);
      wins += extended > five;
      losses += extended < five;
    }
  }
  Findings findings;
  Table means{"means",
              "How well the pictures show the subject (means over scenes and seeds)",
              {"lighting", "shape", "edge_f1", "entropy_bits", "clipped", "overall"}};
  core::Plot plot{"Five ways to light, judged by measures of no objective",
                  {"measure"},
                  {"mean, 0 to 1", false, 0, 1}};
  plot.categories = {"shape", "edge F1", "entropy / 8", "clipped", "overall"};
  double overalls[kWayCount] = {};
  for (std::size_t way = 0; way < kWayCount; ++way) {
    Shown mean;
    const double n = std::max(1.0, static_cast<double>(sums[way].size()));
    for (const Shown& s : sums[way])
      mean.shape += s.shape / n, mean.edges += s.edges / n, mean.entropy += s.entropy / n,
          mean.clipped += s.clipped / n;
    overalls[way] = overall(mean);
    means.rows.push_back({std::string(kWays[way]), mean.shape, mean.edges, mean.entropy,
                          mean.clipped, overalls[way]});
    plot.series.push_back(
        {kWays[way],
         {0, 1, 2, 3, 4},
         {mean.shape, mean.edges, mean.entropy / 8, mean.clipped, overalls[way]}});
    plot.series.back().kind = core::Series::Kind::bars;
  }
  const core::PairedDifference d = core::paired_difference(better);
  char text[160];
  std::snprintf(text, sizeof text, "better in %zu of %zu, by %.3f (%.3f to %.3f), p = %.2g", wins,
                wins + losses, d.mean, d.interval.least, d.interval.most, d.p);
  findings.claims.push_back(
      {"experiment 2: the extended objective is preferred", "72.57 %", "-", text, wins > losses});
  findings.claims.push_back(
      {"ideal lighting beats flat light, a single key and textbook three-point", "-", "-",
       [&] {
         std::string out;
         for (std::size_t w = 0; w < kWayCount; ++w) {
           char part[48];
           std::snprintf(part, sizeof part, "%s%s %.3f", w > 0 ? ", " : "", kWays[w], overalls[w]);
           out += part;
         }
         return out;
       }(),
       overalls[0] > std::max({overalls[2], overalls[3], overalls[4]})});
  findings.tables = {std::move(means), std::move(every)};
  findings.drawings.push_back(drawing("ways", plot));
  findings.items = static_cast<int>(better.size());
  return findings;
}

}  // namespace chiaro::daemon::study
