// SPDX-License-Identifier: Apache-2.0
// Hidden-rig recovery: a photograph of a rig that nobody tells, from a world that differs from the
// twin in its colours and its shape and whose light bounces. How near does the design come?
#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>

#include "controller/core/statistics.h"
#include "controller/daemon/bench/stopwatch.h"
#include "controller/daemon/study/scenes.h"
#include "controller/daemon/study/study.h"

namespace chiaro::daemon::study {
namespace {

constexpr double kApart = core::radians(30), kWithin = core::radians(5);
constexpr double kCounts = 0.10;  ///< share of the luminance from which on a lamp is judged
constexpr double kMostStops = 2.5;

struct Asked {
  int lamps;
  double share, seconds;  ///< of all rigs, at least and at most
};
constexpr std::array<Asked, 3> kAsked{{{1, 0.95, 0.5}, {2, 0.95, 0.5}, {3, 0.90, 1.0}}};

struct LampError {
  double angle = 0, stops = 0, share = 0;  ///< radians, found over true, of the luminance
  bool key = false;
  bool counts() const { return share >= kCounts; }
};
struct Recovered {
  std::vector<LampError> lamps;
  double seconds = 0, residual = 0;
  double worst() const {
    double most = 0;
    for (const LampError& e : lamps)
      if (e.counts()) most = std::max(most, e.angle);
    return most;
  }
};

/// Each lamp's share of the picture's luminance, by the twin.
std::vector<double> shares_of(const design::Layers& layers, const studio::Rig& rig) {
  std::vector<double> shares;
  double sum = 0;
  core::Plane light(layers.size());
  for (std::size_t i = 0; i < rig.states.size(); ++i) {
    core::FixtureState full = rig.states[i];
    full.set(core::Dof::intensity, 1);
    layers.luminance(i, full, design::Accuracy::exact, light);
    double total = 0;
    for (const float v : light.values) total += static_cast<double>(v);
    shares.push_back(total * rig.states[i].get(core::Dof::intensity));
    sum += shares.back();
  }
  for (double& share : shares) share /= sum > 0 ? sum : 1;
  return shares;
}

/// The lamps are alike, so the picture cannot tell their names: the assignment with the least angle
/// over those that count.
std::vector<LampError> errors_of(const studio::Studio& studio, const studio::Rig& hidden,
                                 const studio::Rig& found, const std::vector<double>& shares) {
  const std::size_t n = hidden.states.size();
  std::vector<std::size_t> order(n);
  for (std::size_t i = 0; i < n; ++i) order[i] = i;
  std::vector<LampError> best;
  double least = 1e300;
  do {
    std::vector<LampError> errors;
    double cost = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const core::FixtureState &was = hidden.states[i], &is = found.states[order[i]];
      const double ratio =
          std::max(1e-6, lux_of(studio.fixtures[order[i]], is)) / lux_of(studio.fixtures[i], was);
      errors.push_back({core::angle_between(direction_of(was), direction_of(is)), std::log2(ratio),
                        shares[i], false});
      cost += (errors.back().counts() ? 1 : 0.01) * errors.back().angle;
    }
    if (cost < least) least = cost, best = errors;
  } while (std::next_permutation(order.begin(), order.end()));
  for (LampError& e : best)
    e.key = std::all_of(best.begin(), best.end(),
                        [&](const LampError& o) { return o.share <= e.share; });
  return best;
}

/// One studio with so many lamps, its twin, and rigs to be found in it.
class Trial {
 public:
  Trial(studio::Studio studio, std::unique_ptr<design::LayersSource> twin,
        std::unique_ptr<design::LayersSource> direct, const Options& options, ports::World& world)
      : studio_(std::move(studio)),
        twin_(std::move(twin)),
        direct_(std::move(direct)),
        options_(options),
        world_(world) {}

  core::Result<Recovered> recover(std::uint64_t item, const Errors& errors, const Shot& shot,
                                  bool bounced = true) const {
    core::Random random(options_.seed, item);
    const auto geometry = twin::build_geometry(studio_, world_.state_folder / "meshes");
    if (!geometry) return geometry.problems();
    const studio::Rig hidden = hidden_rig(studio_, **geometry, kApart, kMostStops, random);
    const Reality real = reality(studio_, errors, random, world_);
    design::ExampleGoal goal;
    goal.name = "hidden rig";
    goal.exemplar = photograph(studio_, real, hidden, shot);
    design::Options plain = plain_options(options_.seed, options_.threads, world_);
    plain.full_size = shot.size;
    const bench::Stopwatch watch(world_.clock);
    const auto look = design::design(studio_, bounced ? *twin_ : *direct_, goal, plain);
    if (!look) return look.problems();
    Recovered out;
    out.seconds = watch.seconds();
    out.residual = look->judgement.residual;
    out.lamps = errors_of(studio_, hidden, look->wanted, shares_of(twin_->at(shot.size), hidden));
    return out;
  }

 private:
  studio::Studio studio_;
  std::unique_ptr<design::LayersSource> twin_, direct_;  ///< with light between surfaces, without
  Options options_;
  ports::World& world_;
};

core::Result<Trial> trial_with(int lamps, const Options& options, ports::World& world) {
  auto studio = scene("bust", {lamps, {}}, world);
  if (!studio) return studio.problems();
  auto twin = twin_of(*studio, world, options.threads);
  if (!twin) return twin.problems();
  auto direct = twin_of(*studio, world, options.threads, false);
  if (!direct) return direct.problems();
  return Trial(*std::move(studio), *std::move(twin), *std::move(direct), options, world);
}

Shot shot_for(const Options& options, std::uint64_t item) {
  return {options.quick ? core::Size{128, 128} : core::Size{256, 256}, options.quick ? 12 : 24,
          options.seed * 1000 + item, options.threads};
}

std::string percent_with_interval(std::size_t good, std::size_t all) {
  const core::Interval i = core::wilson_interval(good, all);
  char text[80];
  std::snprintf(text, sizeof text, "%.0f %% (%zu of %zu; %.0f to %.0f %%)",
                all > 0 ? 100.0 * static_cast<double>(good) / static_cast<double>(all) : 0, good,
                all, 100 * i.least, 100 * i.most);
  return text;
}
std::string text_of(const char* format, double value) {
  char text[40];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

/// What was found of one number of lamps.
struct Group {
  int lamps = 0;
  std::vector<Recovered> all;

  std::vector<double> worst_degrees() const {
    std::vector<double> out;
    for (const Recovered& r : all) out.push_back(core::degrees(r.worst()));
    return out;
  }
  std::vector<double> seconds() const {
    std::vector<double> out;
    for (const Recovered& r : all) out.push_back(r.seconds);
    return out;
  }
  template <class Take>
  std::vector<double> of_lamps(Take take) const {
    std::vector<double> out;
    for (const Recovered& r : all)
      for (const LampError& e : r.lamps)
        if (e.counts()) out.push_back(take(e));
    return out;
  }
  std::size_t within() const {
    return static_cast<std::size_t>(std::count_if(
        all.begin(), all.end(), [](const Recovered& r) { return r.worst() <= kWithin; }));
  }
  std::size_t keys_within() const {
    std::size_t n = 0;
    for (const Recovered& r : all)
      n += static_cast<std::size_t>(
          std::count_if(r.lamps.begin(), r.lamps.end(),
                        [](const LampError& e) { return e.key && e.angle <= kWithin; }));
    return n;
  }
};

void add_bars(const Group& group, const Asked& asked, Findings& findings) {
  const std::string lamps = std::to_string(asked.lamps) + (asked.lamps > 1 ? " lights" : " light");
  const std::size_t n = group.all.size(), good = group.within();
  findings.bars.push_back({lamps + ": the worst within 5 degrees", percent_with_interval(good, n),
                           text_of("at least %.0f %%", 100 * asked.share),
                           static_cast<double>(good) >= asked.share * static_cast<double>(n)});
  findings.bars.push_back({lamps + ": the key alone within 5 degrees",
                           percent_with_interval(group.keys_within(), n),
                           "-",
                           {}});
  const double seconds = core::median(group.seconds());
  findings.bars.push_back(
      {lamps + ": seconds, median (and 95 % of them)",
       text_of("%.2f", seconds) + text_of(" (%.2f)", core::quantile(group.seconds(), 0.95)),
       text_of("at most %.1f", asked.seconds), seconds <= asked.seconds});
}

void add_rows(const Group& group, Table& rigs, Table& lamps) {
  for (std::size_t i = 0; i < group.all.size(); ++i) {
    const Recovered& r = group.all[i];
    const double item = static_cast<double>(i + 1), count = group.lamps;
    rigs.rows.push_back({count, item, core::degrees(r.worst()), r.residual, r.seconds});
    for (const LampError& e : r.lamps)
      lamps.rows.push_back({count, item, e.share, std::string(e.key ? "key" : ""),
                            std::string(e.counts() ? "yes" : "no"), core::degrees(e.angle),
                            e.stops});
  }
}

std::vector<Cell> summary_row(const std::string& name, const Group& group) {
  const auto angles = group.of_lamps([](const LampError& e) { return core::degrees(e.angle); });
  const auto stops = group.of_lamps([](const LampError& e) { return std::abs(e.stops); });
  return {name,
          percent_with_interval(group.within(), group.all.size()),
          core::median(angles),
          core::quantile(angles, 0.95),
          core::median(stops),
          core::quantile(stops, 0.95),
          core::median(group.seconds())};
}

core::Plot distribution(const std::vector<Group>& groups) {
  core::Plot plot{"Hidden rigs: the worst light's error",
                  {"angle of the worst light that counts (deg)", false, 0, 20},
                  {"rigs with at most this error (%)", false, 0, 100}};
  for (const Group& group : groups) {
    std::vector<double> worst = group.worst_degrees();
    std::sort(worst.begin(), worst.end());
    core::Series series{
        std::to_string(group.lamps) + (group.lamps > 1 ? " lights" : " light"), {0}, {0}};
    series.kind = core::Series::Kind::steps;
    for (std::size_t i = 0; i < worst.size(); ++i) {
      series.x.push_back(std::min(20.0, worst[i]));
      series.y.push_back(100.0 * static_cast<double>(worst[i] > 20 ? i : i + 1) /
                         static_cast<double>(worst.size()));
    }
    series.x.push_back(20);
    series.y.push_back(series.y.back());
    plot.series.push_back(std::move(series));
  }
  plot.levels = {90, 95};
  return plot;
}

/// The same rigs with the world made a little more like the twin, one thing at a time.
core::Result<Table> causes(const Trial& trial, const Options& options, int items,
                           ports::World& world) {
  struct Cause {
    const char* name;
    Errors errors;
    bool bounced;
  };
  Errors exact_albedo, exact_normals, quiet;
  exact_albedo.albedo = 0, exact_normals.normals = 0, quiet.noise = false;
  const Cause all[] = {{"everything wrong", {}, true},
                       {"and the twin knows direct light alone", {}, false},
                       {"colours known", exact_albedo, true},
                       {"shape known", exact_normals, true},
                       {"no noise", quiet, true},
                       {"nothing wrong", kNoErrors, true}};
  Table table{"causes",
              "What costs how much, two lights, the same rigs",
              {"the world", "worst within 5 deg", "median_deg", "95%_deg", "median_stops",
               "95%_stops", "median_s"}};
  for (const Cause& cause : all) {
    Group group{2, {}};
    for (int i = 0; i < items && !world.stop; ++i) {
      const auto item = static_cast<std::uint64_t>(i);
      auto found = trial.recover(item, cause.errors, shot_for(options, item), cause.bounced);
      if (!found) return found.problems();
      group.all.push_back(*std::move(found));
    }
    table.rows.push_back(summary_row(cause.name, group));
  }
  return table;
}

}  // namespace

core::Result<Findings> run_recover(const Options& options, ports::World& world) {
  const int items = options.items_or(50, 4);
  Findings findings;
  Table rigs{"rigs", "Every rig", {"lights", "rig", "worst_deg", "residual", "seconds"}, {}, false};
  Table lamps{"lights",
              "Every light",
              {"lights", "rig", "share", "key", "counts", "angle_deg", "level_stops"},
              {},
              false};
  Table summary{"summary",
                "Lights that give at least 10 % of the luminance",
                {"rigs", "worst within 5 deg", "median_deg", "95%_deg", "median_stops", "95%_stops",
                 "median_s"}};
  std::vector<Group> groups;
  for (const Asked& asked : kAsked) {
    auto trial = trial_with(asked.lamps, options, world);
    if (!trial) return trial.problems();
    Group group{asked.lamps, {}};
    for (int i = 0; i < items && !world.stop; ++i) {
      world.err << "  " << asked.lamps << " lights, rig " << i + 1 << " of " << items << "\n"
                << std::flush;
      const auto item = static_cast<std::uint64_t>(i);
      auto found = trial->recover(item, {}, shot_for(options, item));
      if (!found) return found.problems();
      group.all.push_back(*std::move(found));
    }
    summary.rows.push_back(summary_row(std::to_string(asked.lamps) + " lights", group));
    add_bars(group, asked, findings);
    add_rows(group, rigs, lamps);
    if (asked.lamps == 2 && items >= 4) {
      auto table = causes(*trial, options, std::max(1, items / 5), world);
      if (!table) return table.problems();
      findings.tables.push_back(*std::move(table));
    }
    groups.push_back(std::move(group));
    if (world.stop) break;
  }
  findings.tables.insert(findings.tables.begin(), std::move(summary));
  findings.tables.push_back(std::move(rigs));
  findings.tables.push_back(std::move(lamps));
  findings.drawings.push_back(drawing("distribution", distribution(groups)));
  findings.items = items;
  findings.notes.push_back(
      "Photographs by the path tracer: light bounced 5 times, the sensor's noise, every colour up "
      "to 10 % off, normals 5 degrees off. The twin knows none of that, and the bounced light only "
      "coarsely.");
  return findings;
}

}  // namespace chiaro::daemon::study
