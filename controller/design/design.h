// SPDX-License-Identifier: Apache-2.0
// From a goal to a look: the stages of the design engine, in the order in which they run.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "controller/core/light_units.h"
#include "controller/core/picture.h"
#include "controller/core/result.h"
#include "controller/design/layers.h"
#include "controller/measure/measure.h"
#include "controller/studio/studio.h"

namespace chiaro::design {

/// Shape shown as well as it can be: the thesis's ideal lighting.
struct IdealGoal {
  measure::TermWeights weights;
};
/// painted: every pixel for itself, weighted; see paint.h.
enum class Objective { perceptual, wavelet, painted };
struct Matched;  // pattern.h
/// Like this picture. `targets3d` comes with a 3D exemplar, whose geometry was known.
struct ExampleGoal {
  std::string name;  ///< of the mood, or the file
  core::Picture exemplar;
  Objective objective = Objective::wavelet;
  std::optional<measure::Targets> targets3d;
  measure::TermWeights weights;
  /// Painted pictures: how much each pixel counts, and what it was before; square, of one size.
  core::Plane emphasis, unpainted;
  bool follow_colour = true;  ///< false: lamps keep their colours
  /// The shipped sitter before the shipped studio's camera, as chiaro-draw draws moods: face and
  /// skin are known.
  bool drawn_here = false;
  double sitter_turn = 0;  ///< radians, of a mood drawn with its sitter turned (moods.h)
  std::shared_ptr<const Matched> matched;  ///< the engine's own: callers leave it null
};
using Goal = std::variant<IdealGoal, ExampleGoal>;

struct Wishes;  // wishes.h

struct Progress {
  std::uint64_t trial = 0, trials = 0;
  double best = 0;
  std::string stage;  ///< "search", "polish", "back light", "colour"
};

struct Options {
  std::string optimiser = "sbplx";
  std::uint64_t seed = 1;
  std::uint64_t trials = 0;          ///< 0 = a default by the number of moving DOFs
  std::optional<double> budget_s;    ///< searching stops at 70 % of it: the rest finishes the look
  std::vector<std::string> locked;   ///< fixtures that keep their placed state
  std::optional<studio::Rig> start;  ///< warm start
  bool move_stands = true;           ///< false: solve levels and colours for the placed rig only
  bool advise_exposure = false;
  /// By example: lay the exemplar on the subject, by its face or its outline; mirrored where its
  /// sitter is turned the other way. Both of these off is the thesis.
  bool align = false;
  /// As it was decided for a look before: levels solved again for stands as they are must follow
  /// the same picture. Nothing: decided anew.
  std::optional<bool> mirrored;
  /// By example: compare how the light falls on the face, whatever the skin, the clothes and the
  /// background; see pattern.h. Levels then do not depend on our sitter's skin.
  bool normalise = false;
  std::shared_ptr<const Wishes> wishes;  ///< beside the goal; null: none
  bool glasses = false;    ///< the sitter wears them: places whose lamp shows in them cost more
  bool reference = false;  ///< yardstick: no cache, one thread, levels searched
  /// Squares whose side is a power of two. Search: where tracing is cheapest. Polish: the best few
  /// basins. Full: the last levels, colours and verdicts, exact visibility.
  core::Size search_size{64, 64}, polish_size{128, 128}, full_size{256, 256};
  int threads = 2;
  const std::atomic<bool>* stop = nullptr;
  std::function<void(const Progress&)> progress;  ///< one thread at a time
  std::function<double()> seconds;  ///< monotonic; for the record of time and budget_s
};

enum class Verdict { reached, near, not_reachable };
std::string_view name_of(Verdict verdict);

/// "key 1.3 stops short: bring it to 1.2 m, or ISO 400"
struct Judgement {
  Verdict verdict = Verdict::near;
  double residual = 0;           ///< relative distance from the goal, 0 = met
  std::string limiting_fixture;  ///< empty when nothing limits
  double missing_stops = 0;
  std::string remedy;
};

struct Component {
  std::string name;
  std::optional<double> target;
  double value = 0;
};

/// A named rig with its picture and where it came from.
struct Look {
  std::string name;
  studio::Rig wanted;  ///< placements where the lamps should stand, levels for them
  studio::Rig placed;  ///< the same goal with levels solved for where the lamps stand now
  Judgement judgement, placed_judgement;
  std::vector<Component> components;
  std::vector<std::string>
      instructions;  ///< for a person: "move key to 47° camera left, 38° up, 1.6 m"
  std::vector<std::string> warnings;
  bool mirrored = false;                  ///< the reference picture was taken mirrored
  core::Picture picture, placed_picture;  ///< predictions at full size, display-linear
  std::string goal, optimiser;
  std::uint64_t seed = 0, trials = 0;
  double seconds = 0, cost = 0;
  bool stopped_by_time = false;
  double exposure_advice_stops = 0;  ///< 0 unless advised
  std::optional<double> advised_white_balance_k;
};

/// Thread-safe; the planner's only entry. Same seed and trials, same answer, whatever `threads`.
core::Result<Look> design(const studio::Studio& studio, const LayersSource& twin, const Goal& goal,
                          const Options& options);

/// Ratio key:fill, each alone, incident at the aim; nothing when either is missing or dark.
std::optional<double> key_fill_ratio(const studio::Studio& studio, const studio::Rig& rig);
using core::place_in_words;

/// look.json of the command-line contract (units in the names), and back. Pictures are not in it.
std::string look_to_json(const studio::Studio& studio, const Look& look);
core::Result<Look> look_from_json(const studio::Studio& studio, const std::string& json,
                                  const std::string& file_name);

}  // namespace chiaro::design
