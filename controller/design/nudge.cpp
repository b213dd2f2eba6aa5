// SPDX-License-Identifier: Apache-2.0
#include "controller/design/nudge.h"

#include <algorithm>
#include <cmath>

#include "controller/design/colours.h"
#include "controller/design/nudge_rig.h"
#include "controller/design/words.h"

namespace chiaro::design {
namespace {

constexpr double kDoneFully = 0.9, kDoneHalf = 0.5;  // shares of a step
constexpr double kSmallStep = 0.05;                  // no person sees less
constexpr double kMostInstructionStops = 4;

core::Problems problems_of(const studio::Studio& studio, const Look& look, const Nudge& nudge,
                           const NudgeOptions& options) {
  core::Problems problems;
  for (const studio::Rig* rig : {&look.wanted, &look.placed})
    if (rig->states.size() != studio.fixtures.size())
      return {core::Problem{{},
                            "this look has " + std::to_string(rig->states.size()) +
                                " fixtures, the studio " + std::to_string(studio.fixtures.size()),
                            "choose a look of this studio"}};
  for (const double steps : {nudge.brightness, nudge.warmth, nudge.contrast, nudge.softness})
    if (!(std::abs(steps) <= kMostSteps))
      return {core::Problem{{},
                            "a nudge goes at most " + number(kMostSteps, 0) + " steps",
                            "ask for less, or design the look anew"}};
  std::vector<std::string> names;
  for (const studio::Fixture& fixture : studio.fixtures) names.push_back(fixture.name);
  for (const std::string& name : options.locked) {
    if (studio.fixture_index(name)) continue;
    const std::string near = core::nearest_name(name, names);
    problems.push_back(
        {{},
         "cannot lock \"" + name + "\": the studio has no such fixture",
         near.empty() ? "name one of its fixtures" : "did you mean \"" + near + "\"?"});
  }
  return problems;
}

std::vector<std::size_t> free_fixtures(const studio::Studio& studio,
                                       const std::vector<std::string>& locked) {
  std::vector<std::size_t> free;
  for (std::size_t i = 0; i < studio.fixtures.size(); ++i)
    if (studio.fixtures[i].controlled &&
        std::find(locked.begin(), locked.end(), studio.fixtures[i].name) == locked.end())
      free.push_back(i);
  return free;
}

/// The share of one wish that was met; 1 where nothing was asked.
double share(double asked, double done) {
  return std::abs(asked) < kSmallStep ? 1 : std::clamp(done / asked, 0.0, 1.0);
}

std::string light_by_hand(const studio::Studio& studio, const NudgedRig& result,
                          const Nudge& nudge) {
  if (result.dim.empty()) return "";
  const Limit& worst = result.dim.front();
  const std::string name = studio.fixtures[worst.fixture].name;
  const double stops = std::min(worst.missing, kMostInstructionStops);
  const double distance = result.rig.states[worst.fixture].get(core::Dof::distance);
  std::string ways =
      distance > 0
          ? "bring it to " + number(std::max(0.6, distance * std::exp2(-stops / 2)), 2) + " m, or "
          : "";
  return std::string(nudge.brightness > 0 ? "brighter: " : "more contrast: ") + name +
         " is at full, " + stops_in_words(stops) + " short: " + ways + "open the camera by as much";
}

std::string contrast_by_hand(const Nudge& nudge, double met) {
  if (met >= kDoneHalf || nudge.contrast == 0) return "";
  return nudge.contrast > 0
             ? "more contrast: no lamp that may change fills the shadows any more: hang a black "
               "cloth beside the shadow side"
             : "less contrast: no lamp that may change lights the shadows: put a white reflector "
               "or a fill light on the shadow side";
}

std::string colour_by_hand(const studio::Studio& studio, const NudgedRig& result,
                           const Nudge& nudge, double met) {
  if (met >= kDoneFully || result.off_colour.empty()) return "";
  const Limit& worst = result.off_colour.front();
  const studio::Fixture& fixture = studio.fixtures[worst.fixture];
  const bool warmer = nudge.warmth > 0;
  const double balance =
      1e6 / (1e6 / studio.exposure.white_balance.value - kNudgeMired * nudge.warmth * (1 - met));
  return (warmer ? "warmer: " : "cooler: ") + fixture.name + " can go no further: put " +
         (warmer ? "an orange" : "a blue") + " gel of " + number(std::abs(worst.missing), 0) +
         " mired on it" +
         (balance > 1500 && balance < 20000 ? ", or set the camera's white balance to " +
                                                  number(std::round(balance / 50) * 50, 0) + " K"
                                            : "");
}

std::vector<std::string> by_hand(const studio::Studio& studio, const NudgedRig& result,
                                 const Nudge& nudge) {
  std::vector<std::string> lines;
  const auto add = [&](std::string line) {
    if (!line.empty()) lines.push_back(std::move(line));
  };
  const double light = share(nudge.brightness, result.done.brightness);
  const double contrast = share(nudge.contrast, result.done.contrast);
  if (std::min(light, contrast) < kDoneFully) add(light_by_hand(studio, result, nudge));
  if (lines.empty()) add(contrast_by_hand(nudge, contrast));
  add(colour_by_hand(studio, result, nudge, share(nudge.warmth, result.done.warmth)));
  if (std::abs(nudge.softness) >= kSmallStep)
    add(softness_by_hand(studio, result.rig, nudge.softness));
  return lines;
}

Judgement judgement(const studio::Studio& studio, const NudgedRig& result, const Nudge& nudge) {
  double asked = 0, met = 0;
  const auto weigh = [&](double wish, double done) {
    asked += std::abs(wish);
    met += std::abs(wish) * share(wish, done);
  };
  weigh(nudge.brightness, result.done.brightness);
  weigh(nudge.warmth, result.done.warmth);
  weigh(nudge.contrast, result.done.contrast);
  weigh(nudge.softness, 0);
  const double part = asked > 0 ? met / asked : 1;
  Judgement out;
  out.residual = 1 - part;
  out.verdict = part >= kDoneFully  ? Verdict::reached
                : part >= kDoneHalf ? Verdict::near
                                    : Verdict::not_reachable;
  if (!result.dim.empty()) {
    out.limiting_fixture = studio.fixtures[result.dim.front().fixture].name;
    out.missing_stops = result.dim.front().missing;
  }
  const auto lines = by_hand(studio, result, nudge);
  if (!lines.empty()) out.remedy = lines.front();
  return out;
}

bool something_shines(const Layers& layers, const studio::Rig& rig) {
  for (const core::FixtureState& state : rig.states)
    if (state.get(core::Dof::intensity) > 0) return true;
  const core::Plane ambient = core::luminance(layers.ambient());
  return std::any_of(ambient.values.begin(), ambient.values.end(), [](float v) { return v > 0; });
}

}  // namespace

core::Result<Nudged> nudged(const studio::Studio& studio, const LayersSource& twin,
                            const Look& look, const Nudge& nudge, const NudgeOptions& options) {
  core::Problems problems = problems_of(studio, look, nudge, options);
  if (!problems.empty()) return problems;
  const Layers& layers = twin.at(options.working_size);
  const NudgeSetting setting{studio, layers, free_fixtures(studio, options.locked)};
  if (setting.free.empty())
    return core::Problem{{}, "every lamp is locked: nothing can change", "unlock one"};
  if (!something_shines(layers, look.placed))
    return core::Problem{
        {}, "every lamp is dark: there is nothing to nudge", "choose a look first"};
  const bool stands = look.wanted == look.placed;
  const NudgedRig placed = nudged_rig(setting, look.placed, nudge);
  const NudgedRig wanted = stands ? placed : nudged_rig(setting, look.wanted, nudge);
  Nudged out;
  out.done = placed.done;
  out.by_hand = by_hand(studio, placed, nudge);
  out.look = look;
  out.look.placed = placed.rig;
  out.look.wanted = wanted.rig;
  out.look.goal = look.goal + (look.goal.empty() ? "" : ", ") + nudge_in_words(nudge);
  out.look.placed_judgement = judgement(studio, placed, nudge);
  out.look.judgement = judgement(studio, wanted, nudge);
  out.look.components.clear();  // they were the old picture's
  out.look.instructions.insert(out.look.instructions.begin(), out.by_hand.begin(),
                               out.by_hand.end());
  const Layers& full = twin.at(options.picture_size);
  out.look.placed_picture = predicted(studio, full, out.look.placed, Accuracy::exact);
  out.look.picture =
      stands ? out.look.placed_picture : predicted(studio, full, out.look.wanted, Accuracy::exact);
  return out;
}

}  // namespace chiaro::design
