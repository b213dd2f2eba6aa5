// SPDX-License-Identifier: Apache-2.0
// chiaro design: one look on the command line, with a live progress line.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <ostream>
#include <thread>

#include "controller/core/picture_file.h"
#include "controller/daemon/command.h"
#include "controller/daemon/named_goal.h"
#include "controller/daemon/problems.h"
#include "controller/design/blend.h"
#include "controller/design/by_hand.h"
#include "controller/design/environment.h"
#include "controller/design/geometric_layers.h"
#include "controller/design/moods.h"
#include "controller/design/words.h"
#include "controller/measure/picture_terms/picture_term.h"
#include "controller/studio/load.h"

namespace chiaro::daemon {
namespace {

/// As typed.
struct Asked {
  std::string studio, mood, exemplar, environment, targets, goal = "wavelet", optimiser,
                                                            exposure = "locked";
  std::string align = "auto", normalise = "auto", out, picture, budget, blend;
  std::vector<std::string> lock, term;
  std::uint64_t seed = 1, trials = 0;
  int threads = 0;
  bool ideal = false, reference = false, glasses = false;
};

double seconds_of(const ports::World& world) {
  return std::chrono::duration<double>(world.clock.now().time_since_epoch()).count();
}

/// One line on the person's stream, redrawn in place on a terminal; else a line per stage.
class ProgressLine {
 public:
  explicit ProgressLine(ports::World& world) : world_(world), started_(seconds_of(world)) {}
  ~ProgressLine() { clear(); }
  void clear() {
    if (drawn_) world_.err << "\r\x1b[K" << std::flush;
    drawn_ = false;
  }
  void show(const design::Progress& progress) {
    if (!world_.err_is_terminal) {
      if (progress.stage != stage_) world_.err << progress.stage << " …\n" << std::flush;
      stage_ = progress.stage;
      return;
    }
    const double now = seconds_of(world_);
    if (drawn_ && now - last_ < 0.05) return;
    last_ = now;
    drawn_ = true;
    world_.err << "\r\x1b[K" << line(progress, now - started_) << std::flush;
  }

 private:
  static std::string line(const design::Progress& progress, double elapsed) {
    std::string text = progress.stage + ": trial " + std::to_string(progress.trial);
    const bool endless = progress.trials > 10'000'000;
    if (!endless) text += " of " + std::to_string(progress.trials);
    if (std::isfinite(progress.best)) text += ", best " + design::number(progress.best, 3);
    if (!endless && progress.trial > 20 && progress.trials > progress.trial) {
      const double left = elapsed * static_cast<double>(progress.trials - progress.trial) /
                          static_cast<double>(progress.trial);
      text += ", " + design::number(left, 1) + " s left";
    }
    return text;
  }
  ports::World& world_;
  const double started_;
  double last_ = 0;
  bool drawn_ = false;
  std::string stage_;
};

/// "0.4" of "other=0.4"; nothing when that is not a share.
std::optional<double> share_of(const std::string& blend) {
  const std::size_t equals = blend.rfind('=');
  if (equals == std::string::npos || equals == 0) return std::nullopt;
  double share = 0;
  char rest = 0;
  if (std::sscanf(blend.c_str() + equals + 1, "%lf%c", &share, &rest) != 1) return std::nullopt;
  return share >= 0 && share <= 1 ? std::optional(share) : std::nullopt;
}

/// The goal on the way to a second exemplar: a mood by name, else a picture file.
core::Result<design::Goal> blended_goal(const design::Goal& from, const Asked& asked,
                                        const studio::Folders& folders, design::Objective objective,
                                        ports::World& world) {
  const std::string other = asked.blend.substr(0, asked.blend.rfind('='));
  auto to = std::filesystem::exists(other) ? picture_goal(other, objective)
                                           : mood_goal(other, folders, objective, world);
  if (!to) return to.problems();
  return design::Goal(design::blended(std::get<design::ExampleGoal>(from),
                                      std::get<design::ExampleGoal>(*to),
                                      share_of(asked.blend).value_or(0)));
}

bool is_by_hand(const Asked& asked) {
  return asked.goal != "wavelet" && asked.goal != "perceptual";
}

/// "entropy=0.5", "key_fill:8=1"; nothing when it is not so written.
std::optional<design::TermShare> term_of(const std::string& text) {
  const std::size_t equals = text.rfind('='), colon = text.find(':');
  if (equals == std::string::npos || equals == 0) return std::nullopt;
  design::TermShare share;
  share.name = text.substr(0, std::min(colon, equals));
  char rest = 0;
  if (std::sscanf(text.c_str() + equals + 1, "%lf%c", &share.weight, &rest) != 1 ||
      !(share.weight >= 0 && share.weight <= 100))
    return std::nullopt;
  if (colon > equals) return share;
  double wanted = 0;
  if (std::sscanf(text.c_str() + colon + 1, "%lf%c", &wanted, &rest) != 2 || rest != '=')
    return std::nullopt;
  share.wanted = wanted;
  return share;
}

bool named(const Asked& asked) {
  return asked.ideal || !asked.mood.empty() || !asked.exemplar.empty() ||
         !asked.environment.empty();
}

/// The file of --goal, and what else was typed as what it should be like.
core::Result<design::GoalByHand> hand_from(Asked& asked, const studio::Studio& studio) {
  const auto text = text_of(asked.goal);
  if (!text) return text.problems();
  const auto folder = std::filesystem::absolute(asked.goal).parent_path();
  auto hand = design::goal_from_json(*text, asked.goal, studio, folder);
  if (!hand) return hand;
  using Like = design::GoalByHand::Like;
  if (named(asked) && hand->like != Like::nothing)
    return core::Problem{{asked.goal},
                         "what the picture should be like stands in the file and on the command "
                         "line",
                         "leave out --ideal, --mood or --exemplar, or \"like\""};
  asked.ideal = asked.ideal || hand->like == Like::ideal;
  if (hand->like == Like::mood) asked.mood = hand->name;
  if (hand->like == Like::exemplar) asked.exemplar = hand->name;
  asked.goal = hand->objective == design::Objective::perceptual ? "perceptual" : "wavelet";
  return hand;
}

/// The rig whose picture is painted on.
core::Result<studio::Rig> rig_of(const design::GoalByHand& hand, const studio::Studio& studio) {
  if (hand.like != design::GoalByHand::Like::look) return studio::placed_rig(studio);
  const auto text = text_of(hand.name);
  if (!text) return text.problems();
  auto look = design::look_from_json(studio, *text, hand.name);
  if (!look) return look.problems();
  return look->wanted;
}

core::Result<design::Goal> goal_from(const Asked& asked, const studio::Folders& folders,
                                     ports::World& world) {
  if (asked.ideal) return design::Goal(design::IdealGoal{});
  const design::Objective objective =
      asked.goal == "perceptual" ? design::Objective::perceptual : design::Objective::wavelet;
  auto goal = asked.mood.empty() ? picture_goal(asked.exemplar, objective)
                                 : mood_goal(asked.mood, folders, objective, world);
  if (goal && !asked.targets.empty()) {
    auto targets = design::load_targets(asked.targets);
    if (!targets) return targets.problems();
    std::get<design::ExampleGoal>(*goal).targets3d = *targets;
  }
  if (!goal || asked.blend.empty()) return goal;
  return blended_goal(*goal, asked, folders, objective, world);
}

std::optional<double> budget_seconds(const std::string& text) {
  double value = 0;
  char unit[4] = "";
  const int read = std::sscanf(text.c_str(), "%lf%3s", &value, unit);
  const std::string word = unit;
  if (read < 2 || !(value > 0) || !std::isfinite(value)) return std::nullopt;
  if (word == "ms") return value / 1000;
  if (word == "s") return value;
  return std::nullopt;
}

design::Options options_from(const Asked& asked, ports::World& world, ProgressLine& line) {
  design::Options options;
  // As printed in the thesis, its reference searches by annealing.
  options.optimiser = !asked.optimiser.empty() ? asked.optimiser
                      : asked.reference        ? "annealing"
                                               : "sbplx";
  options.seed = asked.seed;
  options.trials = asked.trials;
  if (!asked.budget.empty()) options.budget_s = budget_seconds(asked.budget);
  options.locked = asked.lock;
  options.advise_exposure = asked.exposure == "advise";
  // The yardstick is the thesis, which compares pixel with pixel.
  options.align = asked.align == "auto" && !asked.reference;
  options.normalise = asked.normalise == "auto" && !asked.reference;
  options.glasses = asked.glasses;
  options.reference = asked.reference;
  const int cores = static_cast<int>(std::thread::hardware_concurrency());
  options.threads = asked.reference ? 1 : asked.threads > 0 ? asked.threads : std::max(1, cores);
  options.stop = &world.stop;
  options.seconds = [&world] { return seconds_of(world); };
  options.progress = [&line](const design::Progress& progress) { line.show(progress); };
  return options;
}

std::string per_cent(double share) { return design::number(100 * share, share < 0.1 ? 1 : 0); }

void print_lamps(const studio::Studio& studio, const studio::Rig& rig, std::ostream& out) {
  for (std::size_t i = 0; i < studio.fixtures.size(); ++i) {
    const core::FixtureState& state = rig.states[i];
    const double level = state.get(core::Dof::intensity);
    out << "  " << studio.fixtures[i].name << ": ";
    if (level <= 0.0005) {
      out << "dark\n";
      continue;
    }
    out << design::level_in_words(level);
    if (level < 0.89) out << " (" << design::stops_in_words(std::log2(level)) << " below full)";
    if (state.has(core::Dof::azimuth) && state.has(core::Dof::distance))
      out << ", "
          << design::place_in_words({state.get(core::Dof::azimuth), state.get(core::Dof::elevation),
                                     state.get(core::Dof::distance)});
    if (state.has(core::Dof::cct))
      out << ", " << design::number(state.get(core::Dof::cct), 0) << " K";
    out << "\n";
  }
}

/// What was asked by hand, beside what came of it.
void print_wishes(const design::Look& look, std::ostream& out) {
  for (const design::Component& each : look.components)
    if (each.name.find(' ') != std::string::npos && each.target)
      out << "  " << each.name << ": " << design::number(each.value, each.value < 10 ? 2 : 0)
          << ", asked " << design::number(*each.target, *each.target < 10 ? 2 : 0) << "\n";
}

void print_summary(const studio::Studio& studio, const design::Look& look, std::ostream& out) {
  out << look.name << " (" << look.goal << "): " << design::name_of(look.judgement.verdict) << ", "
      << per_cent(look.judgement.residual) << " % off\n";
  if (!look.judgement.remedy.empty()) out << "  " << look.judgement.remedy << "\n";
  print_wishes(look, out);
  print_lamps(studio, look.wanted, out);
  if (const std::string ratio = design::ratio_in_words(studio, look.wanted); !ratio.empty())
    out << "  " << ratio << "\n";
  if (!look.instructions.empty()) out << "By hand:\n";
  for (const std::string& line : look.instructions) out << "  " << line << "\n";
  if (!(look.placed == look.wanted))
    out << "As the lamps stand now: " << design::name_of(look.placed_judgement.verdict) << ", "
        << per_cent(look.placed_judgement.residual) << " % off\n";
  for (const std::string& line : look.warnings) out << "warning: " << line << "\n";
  out << look.trials << " trials in " << design::number(look.seconds, 2) << " s"
      << (look.stopped_by_time ? ", stopped by time" : "") << "\n";
}

ports::Exit write_results(const Asked& asked, const studio::Studio& studio,
                          const design::Look& look, bool json, ports::World& world) {
  const std::string text = design::look_to_json(studio, look);
  if (!asked.out.empty()) {
    std::ofstream file(asked.out, std::ios::trunc);
    file << text;
    if (!file.flush()) {
      return refuse({{{asked.out},
                      "the look cannot be written",
                      "is there such a folder, and may you write in it?"}},
                    world, false);
    }
  }
  if (!asked.picture.empty()) {
    const auto written = core::write_png(asked.picture, core::encoded(look.picture));
    if (!written) return refuse(written.problems(), world, false);
  }
  if (json) world.out << text;
  print_summary(studio, look, json ? world.err : world.out);
  return ports::Exit::done;
}

/// Mid grey on average: what a meter in that place would make of the subject.
core::Result<design::Goal> place_goal(const std::string& file, const studio::Studio& studio,
                                      const design::LayersSource& twin, core::Size size) {
  const auto probe = core::read_linear(file);
  if (!probe) return probe.problems();
  auto goal = design::environment_goal(studio, twin, *probe,
                                       std::filesystem::path(file).stem().string(), 50, size);
  if (!goal) return goal.problems();
  return design::Goal(*std::move(goal));
}

ports::Exit run_design(Asked asked, ports::World& world, bool json) {
  const studio::Folders folders{world.config_folder};
  auto loaded = studio::load_studio(asked.studio, folders);
  if (!loaded) return refuse(loaded.problems(), world, json);
  world.err << core::to_string(loaded->warnings);
  std::optional<design::GoalByHand> hand;
  if (is_by_hand(asked)) {
    auto read = hand_from(asked, loaded->studio);
    if (!read) return refuse(read.problems(), world, json);
    hand = *std::move(read);
  }
  std::optional<design::Goal> like;
  if ((!hand || named(asked)) && asked.environment.empty()) {
    auto goal = goal_from(asked, folders, world);
    if (!goal) return refuse(goal.problems(), world, json);
    like = *std::move(goal);
  }
  const auto rig = hand ? rig_of(*hand, loaded->studio)
                        : core::Result<studio::Rig>(studio::placed_rig(loaded->studio));
  if (!rig) return refuse(rig.problems(), world, json);
  if (!asked.term.empty() && !hand) hand.emplace();
  for (const std::string& term : asked.term) hand->wishes->terms.push_back(*term_of(term));
  ProgressLine line(world);
  const design::Options options = options_from(asked, world, line);
  design::GeometricOptions geometric;
  geometric.mesh_cache = world.state_folder / "meshes";
  geometric.reference = asked.reference;
  geometric.threads = options.threads;
  auto twin = design::bounced_layers(loaded->studio, geometric);
  if (!twin) return refuse(twin.problems(), world, json);
  if (!asked.environment.empty()) {
    auto goal = place_goal(asked.environment, loaded->studio, **twin, options.full_size);
    if (!goal) return refuse(goal.problems(), world, json);
    like = *std::move(goal);
  }
  if (hand)
    if (auto problems = design::with_twins(*hand->wishes, loaded->studio, geometric);
        !problems.empty())
      return refuse(problems, world, json);
  core::Result<design::Look> look =
      hand ? design::design_by_hand(loaded->studio, **twin, *hand, like, *rig, options)
           : design::design(loaded->studio, **twin, *like, options);
  line.clear();
  if (!look) return refuse(look.problems(), world, json);
  return write_results(asked, loaded->studio, *look, json, world);
}

void add_options(CLI::App& verb, Asked& asked) {
  verb.add_option("STUDIO", asked.studio, "the studio file")->required();
  auto* what = verb.add_option_group("what to aim at");
  what->add_flag("--ideal", asked.ideal, "show the subject's shape as well as can be");
  what->add_option("--mood", asked.mood, "a mood by name");
  what->add_option("--exemplar", asked.exemplar, "any picture whose lighting you like");
  what->add_option(
          "--environment", asked.environment,
          "a place's light: a light probe or panorama twice as wide as high (.exr, .hdr or "
          "any picture), its middle towards the camera")
      ->check(CLI::ExistingFile);
  what->require_option(0, 1);
  verb.add_option(
          "--goal", asked.goal,
          "how a picture is compared: wavelet (default) or perceptual; or a goal by hand: a "
          "JSON file of what is painted, wished and must hold (see config/goals)")
      ->check(CLI::IsMember({"perceptual", "wavelet"}) | CLI::ExistingFile);
  verb.add_option("--targets", asked.targets, "edge and contrast targets of a 3D exemplar (YAML)")
      ->check(CLI::ExistingFile)
      ->needs("--exemplar");
  verb.add_option("--blend", asked.blend,
                  "part of the way to another mood or picture, as in split=0.4")
      ->excludes("--ideal")
      ->check([](const std::string& text) {
        return share_of(text) ? std::string()
                              : "\"" + text + "\" is not a name and a share such as split=0.4";
      });
  std::string terms;
  for (const auto& term : measure::terms::picture_terms())
    terms += (terms.empty() ? "" : ", ") + std::string(term.name);
  verb.add_option("--term", asked.term,
                  "NAME=WEIGHT or NAME:WANTED=WEIGHT: asks for more beside the goal (may be "
                  "repeated): " +
                      terms)
      ->allow_extra_args(false)
      ->check([](const std::string& text) {
        return term_of(text) ? std::string()
                             : "\"" + text + "\" is not a term and its weight such as entropy=0.5";
      });
  verb.add_option("--optimiser", asked.optimiser, "how places are searched (default sbplx)");
  verb.add_option("--seed", asked.seed, "same seed and trials, same look (default 1)");
  auto* trials = verb.add_option("--trials", asked.trials, "how many places to try, at least 1")
                     ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1'000'000'000}));
  verb.add_option("--budget", asked.budget, "or how long, as in 2s or 500ms")
      ->excludes(trials)
      ->check([](const std::string& text) {
        return budget_seconds(text) ? std::string()
                                    : "\"" + text + "\" is not a time such as 2s or 500ms";
      });
  verb.add_option("--lock", asked.lock, "a fixture to leave as it is (may be repeated)")
      ->allow_extra_args(false);
  verb.add_option("--exposure", asked.exposure,
                  "advise: may tell you to change the camera (default locked)")
      ->check(CLI::IsMember({"locked", "advise"}));
  verb.add_option("--align", asked.align,
                  "auto: lays the picture on the subject by face or outline (default auto)")
      ->check(CLI::IsMember({"auto", "none"}));
  verb.add_option("--normalise", asked.normalise,
                  "auto: compares light, whatever skin, clothes and background (default auto)")
      ->check(CLI::IsMember({"auto", "none"}));
  verb.add_flag("--glasses", asked.glasses,
                "the sitter wears glasses: lamps keep from where they would show in them");
  verb.add_option("--out", asked.out, "where to write the look (look.json)");
  verb.add_option("--picture", asked.picture, "where to write the predicted picture (PNG)");
  verb.add_flag("--reference", asked.reference,
                "the yardstick: everything rendered anew, one thread, levels searched");
  verb.add_option("--threads", asked.threads, "planner threads (default: one a core)")
      ->check(CLI::Range(1, 256));
}

}  // namespace

void declare_design(CLI::App& app, ports::World& world, Verdict& verdict) {
  auto asked = std::make_shared<Asked>();
  CLI::App* verb = app.add_subcommand("design", "a look from a mood, a picture or none");
  add_options(*verb, *asked);
  verb->callback([asked, &world, &verdict] {
    if (!is_by_hand(*asked) && !named(*asked))
      throw CLI::RequiredError(
          "one of --ideal, --mood, --exemplar, --environment, or --goal FILE.json");
    verdict.exit = run_design(*asked, world, verdict.json);
  });
}

}  // namespace chiaro::daemon
