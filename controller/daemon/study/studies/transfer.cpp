// SPDX-License-Identifier: Apache-2.0
// Lighting by another person's photograph: portraits of other heads, other skin, other walls and
// framing, in light that is known, are given as exemplars. Where does the key come out, and how
// strong the fill? And do lamps move when our own sitter's skin is another's?
#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>

#include "controller/core/statistics.h"
#include "controller/daemon/study/strangers.h"
#include "controller/daemon/study/study.h"
#include "controller/design/moods.h"
#include "controller/design/words.h"

namespace chiaro::daemon::study {
namespace {

constexpr double kKeyWithin = core::radians(15), kRatioWithin = 2.0 / 3, kLampWithin = 1.0 / 3;
constexpr double kAsked = 0.8;
constexpr std::array<double, 4> kSkins{0.06, 0.12, 0.25, 0.45};
constexpr double kCounts = 0.05;  ///< of the key's light at the face, from where on a lamp counts

struct Transferred {
  std::string head;
  double angle = 0,
         ratio = 0;  ///< radians; found over true in stops, infinite where none was found
  double skin = 1, residual = 0;
  bool mirrored = false;
  std::string verdict;
  bool key_good() const { return angle <= kKeyWithin; }
  bool ratio_good() const { return std::abs(ratio) <= kRatioWithin; }
};

design::Options usual_options(const Options& options, bool normal, ports::World& world) {
  design::Options usual = plain_options(options.seed, options.threads, world);
  usual.align = usual.normalise = normal;
  if (options.quick) {
    usual.trials = 120;
    usual.full_size = {128, 128};
  }
  return usual;
}

double ratio_error(const studio::Studio& studio, const studio::Rig& truth,
                   const studio::Rig& found) {
  const auto was = design::key_fill_ratio(studio, truth),
             is = design::key_fill_ratio(studio, found);
  return was && is ? std::log2(*is / *was) : std::numeric_limits<double>::infinity();
}

class Trial {
 public:
  Trial(studio::Studio studio, std::unique_ptr<design::LayersSource> twin, const Options& options,
        ports::World& world)
      : studio_(std::move(studio)), twin_(std::move(twin)), options_(options), world_(world) {}

  const studio::Studio& studio() const { return studio_; }
  /// The seeded portrait of one item.
  core::Result<Portrait> portrait(std::uint64_t item, const std::vector<Head>& heads,
                                  Sitting& asked) const {
    core::Random random(options_.seed, item);
    asked = sitting(studio_, heads[item % heads.size()], random);
    const core::Size size = options_.quick ? core::Size{128, 128} : core::Size{256, 256};
    return drawn(studio_, asked,
                 {size, options_.quick ? 6 : 16, options_.seed * 1000 + item, options_.threads},
                 world_);
  }
  core::Result<design::Look> look(core::Picture exemplar, bool normal) const {
    design::ExampleGoal goal;
    goal.name = "stranger";
    goal.exemplar = std::move(exemplar);
    return design::design(studio_, *twin_, goal, usual_options(options_, normal, world_));
  }
  core::Result<Transferred> transfer(std::uint64_t item, const std::vector<Head>& heads,
                                     bool normal) const {
    Sitting asked;
    const auto portrait = this->portrait(item, heads, asked);
    if (!portrait) return portrait.problems();
    const auto found = look(portrait->picture, normal);
    if (!found) return found.problems();
    // The sitter faces the camera, so nothing gives a reason to follow the picture mirrored: where
    // that is done it counts as the error that it is.
    const studio::Rig& truth = portrait->truth;
    const std::size_t key = *studio_.fixture_index("key");
    Transferred out;
    out.head = asked.head.name;
    out.angle = core::angle_between(direction_of(truth.states[key]),
                                    direction_of(found->wanted.states[key]));
    out.ratio = ratio_error(studio_, truth, found->wanted);
    out.skin = asked.skin;
    out.mirrored = asked.mirrored;
    out.residual = found->judgement.residual;
    out.verdict = design::name_of(found->judgement.verdict);
    return out;
  }

 private:
  studio::Studio studio_;
  std::unique_ptr<design::LayersSource> twin_;
  Options options_;
  ports::World& world_;
};

core::Result<Trial> trial_of(studio::Studio studio, const Options& options, ports::World& world) {
  auto twin = twin_of(studio, world, options.threads);
  if (!twin) return twin.problems();
  return Trial(std::move(studio), *std::move(twin), options, world);
}

std::string per_cent(std::size_t good, std::size_t all) {
  const core::Interval i = core::wilson_interval(good, all);
  return design::number(all > 0 ? 100.0 * static_cast<double>(good) / static_cast<double>(all) : 0,
                        0) +
         " % (" + std::to_string(good) + " of " + std::to_string(all) + "; " +
         design::number(100 * i.least, 0) + " to " + design::number(100 * i.most, 0) + " %)";
}

template <class Good>
std::size_t count(const std::vector<Transferred>& all, Good good) {
  return static_cast<std::size_t>(std::count_if(all.begin(), all.end(), good));
}

std::vector<Cell> row_of(const std::string& name, const std::vector<Transferred>& all) {
  std::vector<double> angles, ratios;
  for (const Transferred& one : all) {
    angles.push_back(core::degrees(one.angle));
    ratios.push_back(std::min(6.0, std::abs(one.ratio)));
  }
  return {name,
          per_cent(count(all, [](const auto& t) { return t.key_good(); }), all.size()),
          core::median(angles),
          core::quantile(angles, 0.8),
          per_cent(count(all, [](const auto& t) { return t.ratio_good(); }), all.size()),
          core::median(ratios),
          core::quantile(ratios, 0.8)};
}

Table summary_of(const std::vector<Transferred>& ours, const std::vector<Transferred>& thesis) {
  Table table{"summary",
              "Another person's portrait as the exemplar",
              {"compared", "keys within 15 deg", "median_deg", "80%_deg", "ratios within 2/3 stop",
               "median_stops", "80%_stops"}};
  table.rows.push_back(row_of("light alone", ours));
  if (!thesis.empty()) table.rows.push_back(row_of("pixel by pixel (thesis)", thesis));
  std::vector<std::string> heads;
  for (const Transferred& one : ours)
    if (std::find(heads.begin(), heads.end(), one.head) == heads.end()) heads.push_back(one.head);
  for (const std::string& head : heads) {
    std::vector<Transferred> of_it;
    std::copy_if(ours.begin(), ours.end(), std::back_inserter(of_it),
                 [&](const Transferred& t) { return t.head == head; });
    table.rows.push_back(row_of("  " + head, of_it));
  }
  return table;
}

/// The shipped studio with a sitter of that skin.
studio::Studio with_skin(studio::Studio studio, double reflectance) {
  for (studio::Subject& subject : studio.subjects) {
    studio::Material material = subject.material.value_or(studio::Material{});
    material.diffuse = (reflectance / core::luminance(material.diffuse)) * material.diffuse;
    subject.material = material;
  }
  return studio;
}

/// One goal for four sitters: how far each lamp's level moves, stops from least to most.
struct Spread {
  std::string goal, lamp;
  double stops = 0;
};
core::Result<std::vector<Spread>> spreads(const std::vector<design::ExampleGoal>& goals,
                                          const Options& options, ports::World& world) {
  auto plain = portrait_studio(world);
  if (!plain) return plain.problems();
  const std::size_t lamps = plain->fixtures.size();
  std::vector<std::vector<std::array<double, kSkins.size()>>> lux(
      goals.size(), std::vector<std::array<double, kSkins.size()>>(lamps));
  for (std::size_t s = 0; s < kSkins.size(); ++s) {
    const studio::Studio studio = with_skin(*plain, kSkins[s]);
    auto twin = twin_of(studio, world, options.threads);
    if (!twin) return twin.problems();
    for (std::size_t g = 0; g < goals.size() && !world.stop; ++g) {
      const auto look =
          design::design(studio, **twin, goals[g], usual_options(options, true, world));
      if (!look) return look.problems();
      for (std::size_t i = 0; i < lamps; ++i)
        lux[g][i][s] = design::lux_at_face(studio, look->wanted, i);
    }
  }
  std::vector<Spread> out;
  for (std::size_t g = 0; g < goals.size(); ++g) {
    double strongest = 0;
    for (const auto& each : lux[g]) strongest = std::max(strongest, each.front());
    for (std::size_t i = 0; i < lamps; ++i) {
      const auto [least, most] = std::minmax_element(lux[g][i].begin(), lux[g][i].end());
      if (*most < kCounts * strongest) continue;
      out.push_back({goals[g].name, plain->fixtures[i].name,
                     std::log2(*most / std::max(*least, 1e-3 * strongest))});
    }
  }
  return out;
}

core::Result<std::vector<design::ExampleGoal>> skin_goals(const Trial& trial,
                                                          const std::vector<Head>& heads,
                                                          const Options& options,
                                                          ports::World& world) {
  std::vector<design::ExampleGoal> goals;
  const design::Moods moods = design::load_moods(world.config_folder / "moods");
  for (const design::Mood& mood : moods.moods)
    if (mood.name == "rembrandt" || (!options.quick && mood.name == "loop")) {
      auto goal = design::goal_of(mood, design::Objective::wavelet);
      if (!goal) return goal.problems();
      goals.push_back(*std::move(goal));
    }
  Sitting asked;
  auto portrait = trial.portrait(0, heads, asked);
  if (!portrait) return portrait.problems();
  design::ExampleGoal stranger;
  stranger.name = "stranger (" + asked.head.name + ")";
  stranger.exemplar = std::move(portrait->picture);
  goals.push_back(std::move(stranger));
  return goals;
}

void add_bars(const std::vector<Transferred>& all, const std::vector<Spread>& skins,
              Findings& findings) {
  const std::size_t n = all.size();
  const auto enough = [&](std::size_t good) {
    return static_cast<double>(good) >= kAsked * static_cast<double>(n);
  };
  const std::size_t keys = count(all, [](const auto&t) { return t.key_good(); }),
                    ratios = count(all, [](const auto&t) { return t.ratio_good(); });
  findings.bars.push_back(
      {"keys within 15 degrees", per_cent(keys, n), "at least 80 %", enough(keys)});
  findings.bars.push_back(
      {"key to fill within 2/3 stop", per_cent(ratios, n), "at least 80 %", enough(ratios)});
  double widest = 0;
  for (const Spread& spread : skins) widest = std::max(widest, spread.stops);
  findings.bars.push_back({"four skins (0.06 to 0.45), one picture: the most a lamp moves",
                           design::number(widest, 2) + " stops", "at most 1/3 stop",
                           widest <= kLampWithin});
}

Table rows_of(const std::vector<Transferred>& all) {
  Table table{
      "portraits",
      "Every portrait",
      {"item", "head", "skin_factor", "mirrored", "key_deg", "ratio_stops", "residual", "verdict"},
      {},
      false};
  for (std::size_t i = 0; i < all.size(); ++i)
    table.rows.push_back({static_cast<double>(i + 1), all[i].head, all[i].skin,
                          std::string(all[i].mirrored ? "yes" : "no"), core::degrees(all[i].angle),
                          all[i].ratio, all[i].residual, all[i].verdict});
  return table;
}

core::Plot distribution(const std::vector<Transferred>& ours,
                        const std::vector<Transferred>& thesis) {
  core::Plot plot{"Another person's portrait: the key's error",
                  {"angle between the key and the truth (deg)", false, 0, 90},
                  {"portraits with at most this error (%)", false, 0, 100}};
  const auto add = [&](const char* name, const std::vector<Transferred>& all) {
    if (all.empty()) return;
    std::vector<double> angles;
    for (const Transferred& one : all) angles.push_back(std::min(90.0, core::degrees(one.angle)));
    std::sort(angles.begin(), angles.end());
    core::Series series{name, {0}, {0}};
    series.kind = core::Series::Kind::steps;
    for (std::size_t i = 0; i < angles.size(); ++i) {
      series.x.push_back(angles[i]);
      series.y.push_back(100.0 * static_cast<double>(i + 1) / static_cast<double>(angles.size()));
    }
    plot.series.push_back(std::move(series));
  };
  add("light alone", ours);
  add("pixel by pixel", thesis);
  plot.levels = {80};
  return plot;
}

}  // namespace

core::Result<Findings> run_transfer(const Options& options, ports::World& world) {
  const int items = options.items_or(52, 4);
  auto studio = portrait_studio(world);
  if (!studio) return studio.problems();
  auto trial = trial_of(*std::move(studio), options, world);
  if (!trial) return trial.problems();
  const std::vector<Head> heads = heads_in(options.assets);
  std::vector<Transferred> ours, thesis;
  for (int i = 0; i < items && !world.stop; ++i) {
    world.err << "  portrait " << i + 1 << " of " << items << "\n" << std::flush;
    const auto item = static_cast<std::uint64_t>(i);
    auto found = trial->transfer(item, heads, true);
    if (!found) return found.problems();
    ours.push_back(*std::move(found));
    // The thesis's own comparison on a third of them shows what the rest is good for.
    if (i % 3 != 0) continue;
    auto plain = trial->transfer(item, heads, false);
    if (!plain) return plain.problems();
    thesis.push_back(*std::move(plain));
  }
  const auto goals = skin_goals(*trial, heads, options, world);
  if (!goals) return goals.problems();
  const auto skins = spreads(*goals, options, world);
  if (!skins) return skins.problems();
  Findings findings;
  add_bars(ours, *skins, findings);
  findings.tables.push_back(summary_of(ours, thesis));
  Table moved{"skins",
              "One picture, four sitters of reflectance 0.06, 0.12, 0.25 and 0.45",
              {"picture", "lamp", "moves_stops"}};
  for (const Spread& spread : *skins)
    moved.rows.push_back({spread.goal, spread.lamp, spread.stops});
  findings.tables.push_back(std::move(moved));
  findings.tables.push_back(rows_of(ours));
  findings.drawings.push_back(drawing("distribution", distribution(ours, thesis)));
  findings.items = items;
  findings.notes.push_back(
      "Drawn by the path tracer: skin 0.25 to 2 times as bright, framed up to 20 % aside and 0.7 "
      "to "
      "1.4 times as large, other walls, half of them mirrored; light bounces, sensors are noisy.");
  if (heads.front().mesh.empty())
    findings.notes.push_back(
        "No other heads were found (give --assets the folder of tests/support/fetch_assets.sh): "
        "the "
        "shipped bust was made wider, narrower, flatter and longer instead.");
  return findings;
}

}  // namespace chiaro::daemon::study
