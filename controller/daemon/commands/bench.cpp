// SPDX-License-Identifier: Apache-2.0
// `chiaro bench`: how fast this machine is at what Chiaro does, beside the reference path and what
// the machine could do at best. Everything is measured in one run; only ratios travel.
#include "controller/daemon/bench/bench.h"

#include <CLI/CLI.hpp>
#include <memory>
#include <ostream>

#include "controller/daemon/command.h"
#include "controller/daemon/problems.h"
#include "controller/design/moods.h"
#include "controller/studio/load.h"

namespace chiaro::daemon {
namespace {

struct Wish {
  std::string studio, mood = "rembrandt", other = "split", only;
  int seeds = 0;
  std::uint64_t trials = 0;
  bool quick = false;
};

core::Result<design::ExampleGoal> mood_named(const std::string& name,
                                             const studio::Folders& folders) {
  const design::Moods moods = design::load_moods(folders.moods());
  std::vector<std::string> names;
  for (const design::Mood& mood : moods.moods) {
    if (mood.name == name) return design::goal_of(mood, design::Objective::wavelet);
    names.push_back(mood.name);
  }
  const std::string near = core::nearest_name(name, names);
  return core::Problem{{folders.moods().string()},
                       "there is no mood called \"" + name + "\"",
                       near.empty() ? "give another with --mood" : "did you mean " + near + "?"};
}

core::Result<bench::Plan> plan_of(const Wish& wish, ports::World& world) {
  const studio::Folders folders{world.config_folder};
  const std::string file =
      wish.studio.empty() ? (folders.studios() / "portrait.yaml").string() : wish.studio;
  auto loaded = studio::load_studio(file, folders);
  if (!loaded) return loaded.problems();
  auto mood = mood_named(wish.mood, folders);
  if (!mood) return mood.problems();
  auto other = mood_named(wish.other, folders);
  if (!other) return other.problems();
  bench::Plan plan{std::move(loaded->studio), *std::move(mood), *std::move(other), wish.quick};
  plan.seeds = wish.seeds > 0 ? wish.seeds : wish.quick ? 2 : 10;
  plan.reference_trials = wish.trials > 0 ? wish.trials : wish.quick ? 40 : 1000;
  if (wish.quick) plan.size = {128, 128};
  return plan;
}

using Part = core::Result<core::Done> (*)(const bench::Plan&, ports::World&, bench::Report&);
struct NamedPart {
  const char* name;
  Part run;
};
constexpr NamedPart kParts[] = {
    {"kernels",
     [](const bench::Plan& plan, ports::World& world, bench::Report& report) {
       bench::kernels(plan, world, report);
       return core::Result<core::Done>(core::Done{});
     }},
    {"trials", bench::trials},
    {"levels", bench::levels},
    {"designs", bench::designs},
    {"moving", bench::moving},
    {"scaling", bench::scaling},
    {"quality", bench::quality}};

ports::Exit run(const Wish& wish, ports::World& world, bool json) {
  const auto plan = plan_of(wish, world);
  if (!plan) return refuse(plan.problems(), world, json);
  world.err << "chiaro bench: other programs slow it down; ratios are safe, times are not\n";
  bench::Report report;
  for (const NamedPart& part : kParts) {
    if (world.stop) break;
    if (!wish.only.empty() && wish.only != part.name) continue;
    world.err << part.name << " …\n" << std::flush;
    if (const auto done = part.run(*plan, world, report); !done)
      return refuse(done.problems(), world, json);
  }
  if (world.stop) world.err << "stopped: what was measured so far follows\n";
  world.out << (json ? report.to_json(plan->studio.name, wish.quick) + "\n" : report.to_text());
  return ports::Exit::done;
}

}  // namespace

void declare_bench(CLI::App& app, ports::World& world, Verdict& verdict) {
  auto* verb = app.add_subcommand("bench", "speeds beside the reference path, and memory");
  auto wish = std::make_shared<Wish>();
  verb->add_option("--studio", wish->studio, "a studio file; the shipped portrait studio if none");
  verb->add_option("--mood", wish->mood, "the mood that is designed")->capture_default_str();
  verb->add_option("--other-mood", wish->other, "the new mood of the warm design")
      ->capture_default_str();
  verb->add_option("--only", wish->only, "one part alone")
      ->check(CLI::IsMember(
          {"kernels", "trials", "levels", "designs", "moving", "scaling", "quality"}));
  verb->add_option("--seeds", wish->seeds, "for the medians of the quality part; 10 if not given")
      ->check(CLI::Range(1, 1000));
  verb->add_option("--trials", wish->trials, "of the reference's annealing; 1000 if not given")
      ->check(CLI::Range(1, 1000000));
  verb->add_flag("--quick", wish->quick, "smaller pictures and budgets: a look, not a record");
  verb->callback([wish, &world, &verdict] { verdict.exit = run(*wish, world, verdict.json); });
}

}  // namespace chiaro::daemon
