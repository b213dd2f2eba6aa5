// SPDX-License-Identifier: Apache-2.0
// One look, from goal to picture: read design() aloud.
#include "controller/design/design.h"

#include <cmath>

#include "controller/design/beyond.h"
#include "controller/design/colours.h"
#include "controller/design/comfort.h"
#include "controller/design/exposure.h"
#include "controller/design/judge.h"
#include "controller/design/match.h"
#include "controller/design/roles.h"
#include "controller/design/stages.h"
#include "controller/design/words.h"

namespace chiaro::design {
namespace {

core::Problems every_problem(const studio::Studio& studio, const LayersSource& twin,
                             const Goal& goal, const Options& options) {
  core::Problems problems = problems_of(studio, options);
  if (core::any_error(problems)) return problems;
  problems = problems_of(goal, twin.at(options.full_size).geometry() != nullptr);
  if (!options.wishes || core::any_error(problems)) return problems;
  return problems_of(*options.wishes, studio, twin.at(options.full_size));
}

std::string goal_in_words(const Goal& goal) {
  const auto* example = std::get_if<ExampleGoal>(&goal);
  if (example == nullptr) return "ideal";
  if (example->objective == Objective::painted) return "by hand: " + example->name;
  return std::string("by example, ") +
         (example->objective == Objective::wavelet ? "wavelet" : "perceptual") + ": " +
         example->name;
}

/// Where the lamps should stand.
studio::Rig wanted_placements(const studio::Studio& studio, const Sizes& sizes, const Goal& goal,
                              const Options& options, const Variables& all, Watch& watch,
                              std::vector<std::string>& warnings) {
  const Variables lamps = searched(studio, all, goal);
  if (lamps.moving.empty() || options.reference) return all.base;
  const Prepared &small = sizes.small, &middle = sizes.middle;
  const Setting coarse{studio, small.layers, lamps, small.target, small.map, Accuracy::cached};
  const Setting fine{studio, middle.layers, lamps, middle.target, middle.map, Accuracy::cached};
  const Found found = with_roles_kept(
      fine, polish(fine, search(coarse, options, watch), options, watch), options, watch);
  if (std::isfinite(found.cost)) return lamps.rig(found.point);
  warnings.push_back(watch.stopped()
                         ? "no place was tried before time was up: the lamps stay where they are"
                         : "no allowed place was found for the lamps together: they stay where "
                           "they are");
  return all.base;
}

void warn_of_places(const studio::Studio& studio, const Layers& layers, const studio::Rig& placed,
                    std::vector<std::string>& warnings) {
  for (std::size_t i = 0; i < studio.fixtures.size(); ++i) {
    const std::string why = layers.infeasible(placed, i);
    if (!why.empty())
      warnings.push_back(studio.fixtures[i].name + " stands where it should not: " + why);
  }
}

/// `shown`: what the camera will see; `full` may show our subject in another's skin.
void describe(const studio::Studio& studio, const Layers& shown, const Prepared& full,
              const Variables& all, Look& look) {
  const Variables lamps = judged(studio, full.target, all, look.wanted);
  const Setting setting{studio, full.layers, lamps, full.target, full.map, Accuracy::exact};
  Workspace workspace(setting);
  look.judgement = judge(setting, workspace, look.wanted);
  look.components = component_list(setting, workspace, look.wanted);
  look.cost = workspace.score(look.wanted).cost;
  look.placed_judgement =
      look.placed == look.wanted ? look.judgement : judge(setting, workspace, look.placed);
  look.picture = predicted(studio, shown, look.wanted, Accuracy::exact);
  look.placed_picture = look.placed == look.wanted
                            ? look.picture
                            : predicted(studio, shown, look.placed, Accuracy::exact);
  judge_colour(full.target, look.picture, look.judgement);
  judge_colour(full.target, look.placed_picture, look.placed_judgement);
  judge_locked(all, look.judgement);
  judge_locked(all, look.placed_judgement);
}

/// Where the lamps stand now; held ones also shine as the design holds them. Motors need nobody:
/// what is wanted of them is where they will be.
studio::Rig placed_now(const studio::Studio& studio, const Variables& all,
                       const studio::Rig& wanted) {
  using core::Dof;
  studio::Rig rig = studio::placed_rig(studio);
  for (const std::size_t fixture : all.lit)
    for (const Dof dof : {Dof::pan, Dof::tilt, Dof::arc, Dof::track})
      if (rig.states[fixture].has(dof) && wanted.states[fixture].has(dof))
        rig.states[fixture].set(dof, wanted.states[fixture].get(dof));
  for (const std::size_t fixture : all.held) rig.states[fixture] = all.base.states[fixture];
  return rig;
}

/// The yardstick's whole rig, levels as its search left them.
studio::Rig reference_rig(const studio::Studio& studio, const Goal& goal, const Options& options,
                          const Variables& all, const Prepared& full, Watch& watch) {
  const Variables lamps = searched(studio, all, goal);
  const Setting setting{studio, full.layers, lamps, full.target, full.map, Accuracy::exact};
  return reference_search(setting, options, watch).rig;
}

/// The camera's change that would let the limited lamp do, as a factor per channel, and in words.
core::Rgb advised_exposure(const studio::Studio& studio, const Prepared& full, Look& look) {
  core::Rgb factor{1, 1, 1};
  if (look.judgement.missing_stops > 0) {
    look.exposure_advice_stops = std::ceil(3 * look.judgement.missing_stops - 1e-6) / 3;
    factor = std::exp2(look.exposure_advice_stops) * factor;
    look.instructions.push_back("expose the camera " + stops_in_words(look.exposure_advice_stops) +
                                " more");
  }
  const core::Kelvin now = studio.exposure.white_balance;
  look.advised_white_balance_k = better_white_balance(full.target, look.picture, now);
  if (look.advised_white_balance_k) {
    factor = factor * core::white_light(now, 0, core::Kelvin{*look.advised_white_balance_k});
    look.instructions.push_back("set the camera's white balance to " +
                                number(*look.advised_white_balance_k, 0) + " K");
  }
  return factor;
}

/// The warmth that is wished, and the bounds kept once more after the last stage.
studio::Rig as_wished(const studio::Studio& studio, const Sizes& sizes, const Options& options,
                      const Variables& all, const studio::Rig& rig) {
  if (!options.wishes) return rig;
  const studio::Rig warm =
      with_warmth(studio, sizes.small.layers, all.lit, rig, options.wishes->warmth_mired);
  const Prepared& small = sizes.small;
  const Setting setting{studio, small.layers, all, small.target, small.map, Accuracy::cached};
  return within_bounds(*options.wishes, studio, all,
                       with_term_colours(setting, small.layers, warm));
}

void warn_of_bounds(const studio::Studio& studio, const Prepared& full, const Variables& all,
                    Look& look) {
  if (!full.target.asked) return;
  const Setting setting{studio, full.layers, all, full.target, full.map, Accuracy::exact};
  for (const std::string& word :
       outcome_of(setting, look.wanted, core::luminance(look.picture)).broken)
    look.warnings.push_back(word);
}

/// Solves again for the advised exposure, where there is one; the places stay.
void advise_exposure(const studio::Studio& studio, const Layers& shown, const Sizes& sizes,
                     const Goal& goal, const Options& options, const Variables& all, Watch& watch,
                     Look& look) {
  const core::Rgb factor = advised_exposure(studio, sizes.full, look);
  if (factor == core::Rgb{1, 1, 1}) return;
  const ReexposedLayers small(sizes.small.layers, factor), middle(sizes.middle.layers, factor),
      full(sizes.full.layers, factor);
  const Sizes again = prepare(studio, goal, all, small, middle, full, options.wishes);
  const auto solved = [&](const studio::Rig& rig) {
    return as_wished(studio, again, options, all, completed(studio, again, all, rig, false, watch));
  };
  look.wanted = solved(look.wanted);
  look.placed = solved(look.placed);
  describe(studio, ReexposedLayers(shown, factor), again.full, all, look);
}

}  // namespace

core::Result<Look> design(const studio::Studio& studio, const LayersSource& twin, const Goal& asked,
                          const Options& options) {
  core::Problems problems = every_problem(studio, twin, asked, options);
  if (core::any_error(problems)) return problems;
  Watch watch(options);
  Look look;
  const auto* example = std::get_if<ExampleGoal>(&asked);
  look.name = example != nullptr ? example->name : "ideal";
  look.goal = goal_in_words(asked);
  look.optimiser = options.optimiser;
  look.seed = options.seed;

  const Variables all = variables_of(studio, options);
  const Match match = matched(studio, twin, asked, options, all, watch);
  const Goal& goal = match.goal;
  look.mirrored = match.mirrored;
  look.warnings = match.words;
  const Compared compared(twin, match.skin);
  const Layers& layers = twin.at(options.full_size);
  const Sizes sizes =
      prepare(studio, goal, all, compared.at(options.search_size), compared.at(options.polish_size),
              compared.at(options.full_size), options.wishes);
  const studio::Rig placements =
      wanted_placements(studio, sizes, goal, options, all, watch, look.warnings);
  look.wanted = options.reference
                    ? reference_rig(studio, goal, options, all, sizes.full, watch)
                    : completed(studio, sizes, all, placements, options.move_stands, watch);
  look.wanted = as_wished(studio, sizes, options, all, look.wanted);
  look.placed =
      as_wished(studio, sizes, options, all,
                completed(studio, sizes, all, placed_now(studio, all, look.wanted), false, watch));
  describe(studio, layers, sizes.full, all, look);
  if (options.advise_exposure)
    advise_exposure(studio, layers, sizes, goal, options, all, watch, look);
  warn_of_bounds(studio, sizes.full, all, look);

  if (std::string unseen = unseen_in_words(studio, layers); !unseen.empty())
    look.warnings.push_back(std::move(unseen));
  if (std::string black = black_in_words(sizes.full.target); !black.empty())
    look.warnings.push_back(std::move(black));
  const auto moves = instructions(studio, studio::placed_rig(studio), look.wanted);
  look.instructions.insert(look.instructions.end(), moves.begin(), moves.end());
  warn_of_places(studio, layers, studio::placed_rig(studio), look.warnings);
  if (layers.geometry() != nullptr)
    for (const std::string& word :
         comfort_in_words(studio, look.wanted,
                          comfort_of(studio, layers, look.wanted, look.picture), options.glasses))
      look.warnings.push_back(word);
  if (const std::string mixed = mixed_light_in_words(studio, look.wanted); !mixed.empty())
    look.warnings.push_back(mixed);
  look.trials = watch.trials();
  look.stopped_by_time = watch.stopped();
  look.seconds = watch.elapsed();
  return look;
}

}  // namespace chiaro::design
