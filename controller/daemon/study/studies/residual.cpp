// SPDX-License-Identifier: Apache-2.0
// Tables 4.1 to 4.3 [I-30]: how near perception-based lighting by example brings each component of
// a scene's picture to an exemplar's, on scenes of our own. A component counts as attainable when a
// search of its own, for it alone and with ten times the trials, comes within 2 % of the target.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <ostream>

#include "controller/core/picture_file.h"
#include "controller/core/statistics.h"
#include "controller/daemon/study/lab.h"
#include "controller/daemon/study/study.h"
#include "controller/design/moods.h"
#include "controller/studio/load.h"

namespace chiaro::daemon::study {
namespace {

constexpr double kAttained = 0.02;
constexpr std::uint64_t kTimesTheTrials = 10;

struct Property {
  const char* name;
  double measure::Components::*value;
  std::optional<double> measure::Targets::*target;
};
constexpr Property kProperties[] = {
    {"edge", &measure::Components::edge, &measure::Targets::edge},
    {"mean", &measure::Components::mean, &measure::Targets::mean},
    {"gradient", &measure::Components::gradient, &measure::Targets::gradient},
    {"variance", &measure::Components::variance, &measure::Targets::variance},
    {"contrast", &measure::Components::contrast, &measure::Targets::contrast}};

/// An exemplar, the scenes that are lit after it, and the thesis's table that it belongs to.
struct Exemplar {
  std::string name, table;
  std::string from;  ///< its own scene; empty for a picture of elsewhere
  design::ExampleGoal goal;
};

double off(double value, double target) {
  return target > 0 ? std::abs(value - target) / target : std::abs(value);
}

design::ExampleGoal perceptual(std::string name, core::Picture picture) {
  design::ExampleGoal goal;
  goal.name = std::move(name);
  goal.exemplar = std::move(picture);
  goal.objective = design::Objective::perceptual;
  return goal;
}

/// A rendered exemplar: a rig on one of our scenes, photographed; for a 3D one with the components
/// that its own geometry gives.
Exemplar rendered(const Stage& at, int number, bool is_3d, const Options& options,
                  ports::World& world) {
  core::Random random(30, static_cast<std::uint64_t>(number));
  const auto geometry = twin::build_geometry(at.studio, world.state_folder / "meshes").value();
  const studio::Rig rig = hidden_rig(at.studio, *geometry, core::radians(30), 2.5, random);
  const Reality real = reality(at.studio, Errors{}, random, world);
  const Shot shot{
      {256, 256}, options.quick ? 8 : 24, static_cast<std::uint64_t>(number), options.threads};
  Exemplar out{at.name + " " + std::to_string(number), is_3d ? "4.2" : "4.1", at.name,
               perceptual(at.name, photograph(at.studio, real, rig, shot))};
  if (is_3d) {
    const design::Layers& layers = at.twin->at(shot.size);
    const measure::PixelMap map = measure::pixel_map(*layers.geometry());
    out.goal.targets3d = measure::targets_of(
        measure::components_of_luminance(core::luminance(out.goal.exemplar), map), true);
  }
  return out;
}

/// Whether a search for one component alone comes near enough.
bool attainable(Lab& lab, const Property& property, double target, std::uint64_t trials,
                std::uint64_t seed, int threads, const ports::World& world) {
  std::atomic<bool> enough{false};
  optimise::Task task;
  task.bounds = lab.bounds();
  task.starts = {lab.start()};
  task.trials = trials;
  task.seed = seed;
  task.threads = threads;
  task.stop = &enough;
  task.cost = [&](std::span<const double> point) {
    if (world.stop) enough = true;
    // Where a lamp must not stand, nothing is attained.
    if (!std::isfinite(lab.cost(point))) return std::numeric_limits<double>::infinity();
    const double now = off(lab.components(lab.rig(point)).*property.value, target);
    if (now <= kAttained) enough = true;
    return now;
  };
  return optimise::make_optimiser("cmaes")->minimise(task).value <= kAttained;
}

struct Seen {
  double residual = 0;
  bool attainable = false;
};

/// Lights one scene after one exemplar; one row for the thesis's table.
core::Result<std::vector<Seen>> light(const Stage& at, const Exemplar& exemplar,
                                      const Options& options, ports::World& world, Table& table,
                                      Table& every) {
  design::Options plain = plain_options(options.seed, options.threads, world);
  const auto look = design::design(at.studio, *at.twin, exemplar.goal, plain);
  if (!look) return look.problems();
  Lab lab(at, exemplar.goal, core::Size{64, 64}, Levels::searched);
  Lab full(at, exemplar.goal, plain.full_size, Levels::searched);
  const measure::Components found = full.components(look->wanted);
  std::vector<Cell> row{exemplar.name, at.name};
  std::vector<Seen> seen;
  for (const Property& property : kProperties) {
    const auto& target = full.target().targets.*property.target;
    const auto& small = lab.target().targets.*property.target;
    row.push_back(target ? found.*property.value : std::numeric_limits<double>::quiet_NaN());
    if (!target || !small) continue;
    Seen one{off(found.*property.value, *target), false};
    one.attainable =
        one.residual <= kAttained ||
        attainable(lab, property, *small,
                   options.quick ? 300 : kTimesTheTrials * std::max<std::uint64_t>(1, look->trials),
                   options.seed, options.threads, world);
    every.rows.push_back({exemplar.table, exemplar.name, at.name, property.name, *target,
                          found.*property.value, one.residual,
                          std::string(one.attainable ? "yes" : "no")});
    seen.push_back(one);
  }
  table.rows.push_back(std::move(row));
  return seen;
}

std::vector<Cell> target_row(const Stage& at, const Exemplar& exemplar) {
  const Lab lab(at, exemplar.goal, {256, 256}, Levels::searched);
  std::vector<Cell> row{exemplar.name, std::string("target")};
  for (const Property& property : kProperties)
    row.push_back(
        (lab.target().targets.*property.target).value_or(std::numeric_limits<double>::quiet_NaN()));
  return row;
}

double mean_residual(const std::vector<Seen>& seen, bool attainable_only) {
  std::vector<double> values;
  for (const Seen& s : seen)
    if (s.attainable || !attainable_only) values.push_back(s.residual);
  return core::mean(values);
}
std::string percent(double share) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f %%", 100 * share);
  return text;
}

/// Moods are drawn from elsewhere: pictures with neither our camera nor our subject.
core::Result<std::vector<Exemplar>> pictures(int count, ports::World& world) {
  const auto moods = design::load_moods(studio::Folders{world.config_folder}.moods()).moods;
  std::vector<Exemplar> out;
  for (const design::Mood& mood : moods) {
    if (static_cast<int>(out.size()) >= count) break;
    const auto picture = core::read_picture(mood.picture);
    if (!picture) return picture.problems();
    out.push_back({mood.name, "4.3", "", perceptual(mood.name, core::linear(*picture))});
  }
  return out;
}

struct Kind {
  std::string table, title, thesis;
  double thesis_residual;
  std::vector<Exemplar> exemplars;
};

}  // namespace

core::Result<Findings> run_residual(const Options& options, ports::World& world) {
  const int count = options.items_or(3, 1);
  std::vector<Stage> stages;
  for (const std::string_view name : scene_names()) {
    auto made = stage(name, {2, {}}, options.threads, world);
    if (!made) return made.problems();
    stages.push_back(*std::move(made));
  }
  std::vector<Kind> kinds{{"4.1", "Table 4.1: 2D exemplars, rendered", "33 %", 0.33, {}},
                          {"4.2", "Table 4.2: 3D exemplars", "9.9 %", 0.099, {}},
                          {"4.3", "Table 4.3: pictures from elsewhere", "53 %", 0.53, {}}};
  for (int k = 0; k < count; ++k) {
    const Stage& at = stages[static_cast<std::size_t>(k) % stages.size()];
    kinds[0].exemplars.push_back(rendered(at, 2 * k + 1, false, options, world));
    kinds[1].exemplars.push_back(rendered(at, 2 * k + 2, true, options, world));
  }
  auto elsewhere = pictures(count, world);
  if (!elsewhere) return elsewhere.problems();
  kinds[2].exemplars = *std::move(elsewhere);

  Findings findings;
  Table every{
      "components",
      "Every component",
      {"table", "exemplar", "scene", "component", "target", "found", "residual", "attainable"},
      {},
      false};
  Table summary{"summary",
                "Mean residual of the components",
                {"table", "thesis", "all", "attainable", "unattainable share"}};
  std::vector<Seen> everything;
  for (const Kind& kind : kinds) {
    Table table{"table-" + kind.table,
                kind.title,
                {"exemplar", "scene", "edge", "mean", "gradient", "variance", "contrast"}};
    std::vector<Seen> seen;
    for (const Exemplar& exemplar : kind.exemplars) {
      table.rows.push_back(target_row(stages[0], exemplar));
      int lit = 0;
      for (const Stage& at : stages) {
        if (at.name == exemplar.from || world.stop || ++lit > (options.quick ? 1 : 2)) continue;
        world.err << "  table " << kind.table << ": " << exemplar.name << " on " << at.name << "\n"
                  << std::flush;
        auto one = light(at, exemplar, options, world, table, every);
        if (!one) return one.problems();
        seen.insert(seen.end(), one->begin(), one->end());
      }
    }
    const auto out = static_cast<double>(
        std::count_if(seen.begin(), seen.end(), [](const Seen& s) { return !s.attainable; }));
    const double share = seen.empty() ? 0 : out / static_cast<double>(seen.size());
    summary.rows.push_back({kind.table, kind.thesis, percent(mean_residual(seen, false)),
                            percent(mean_residual(seen, true)), percent(share)});
    findings.claims.push_back({kind.title + ": mean residual", kind.thesis, "-",
                               percent(mean_residual(seen, false)) +
                                   " (attainable: " + percent(mean_residual(seen, true)) + ")",
                               mean_residual(seen, false) <= kind.thesis_residual});
    findings.tables.push_back(std::move(table));
    everything.insert(everything.end(), seen.begin(), seen.end());
  }
  const auto out = static_cast<double>(std::count_if(everything.begin(), everything.end(),
                                                     [](const Seen& s) { return !s.attainable; }));
  const double share = everything.empty() ? 0 : out / static_cast<double>(everything.size());
  findings.bars.push_back({"mean residual of attainable components",
                           percent(mean_residual(everything, true)), "at most 5 %",
                           mean_residual(everything, true) <= 0.05});
  findings.bars.push_back(
      {"unattainable components", percent(share), "at most 20 %", share <= 0.2});
  findings.tables.insert(findings.tables.begin(), std::move(summary));
  findings.tables.push_back(std::move(every));
  findings.notes.push_back(
      "Table 4.3's photographs are not ours to ship: the moods' pictures stand in.");
  findings.items = count;
  return findings;
}

}  // namespace chiaro::daemon::study
