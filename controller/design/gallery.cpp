// SPDX-License-Identifier: Apache-2.0
#include "controller/design/gallery.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "controller/core/random.h"
#include "controller/design/colours.h"
#include "controller/design/trial.h"
#include "controller/design/words.h"

namespace chiaro::design {
namespace {

constexpr core::Size kCells{16, 16};
// Lamps are dark in a third of the rigs, else within five stops of each other.
constexpr double kDark = 1.0 / 3, kStops = 5;
// The subject's mean L*, and what no photographer would keep: burnt or lost in black.
constexpr core::Range kLightness{22, 68};
constexpr double kBurnt = 0.03, kLost = 0.85, kBlack = 6;
constexpr int kPlaces = 20;  // tries for a place where every lamp may stand

struct Sample {
  studio::Rig rig;
  std::vector<float> signature;
};

bool feasible(const Layers& layers, const Variables& variables, const studio::Rig& rig) {
  for (const std::size_t fixture : variables.movers())
    if (!layers.infeasible(rig, fixture).empty()) return false;
  return true;
}

std::optional<studio::Rig> random_places(const Layers& layers, const Variables& variables,
                                         core::Random& random) {
  for (int i = 0; i < kPlaces; ++i) {
    optimise::Point point;
    for (const Variable& variable : variables.moving)
      point.push_back(random.uniform(variable.range.least, variable.range.most));
    studio::Rig rig = variables.rig(point);
    if (feasible(layers, variables, rig)) return rig;
  }
  return std::nullopt;
}

/// Means and shares over the subject, or over everything where none is known.
struct Seen {
  double lightness = 0, burnt = 0, black = 0;
};
Seen seen_in(const core::Plane& luminance, const core::GeometryPlanes* planes) {
  Seen seen;
  double count = 0;
  for (std::size_t i = 0; i < luminance.values.size(); ++i) {
    if (planes != nullptr && planes->subject.values[i] == 0) continue;
    const double y = luminance.values[i], l = core::lightness(std::min(1.0, y));
    ++count;
    seen.lightness += l;
    seen.burnt += y >= 1;
    seen.black += l < kBlack;
  }
  if (count == 0) return seen;
  return {seen.lightness / count, seen.burnt / count, seen.black / count};
}

/// `rig` with its lit lamps scaled together, within their limits, until the subject's mean L* is
/// near `wanted`; a few rounds of the power law between light and L*.
studio::Rig exposed(const Setting& setting, Workspace& workspace, studio::Rig rig, double wanted,
                    core::Plane& picture) {
  const Variables& variables = setting.variables;
  std::vector<double> levels;
  for (const std::size_t fixture : variables.lit)
    levels.push_back(rig.states[fixture].get(core::Dof::intensity));
  const Columns& columns = workspace.columns(rig);
  for (int round = 0; round < 4; ++round) {
    mix(columns, levels, picture);
    const double now = std::max(1.0, seen_in(picture, setting.layers.geometry()).lightness);
    const double more = std::pow((wanted + 16) / (now + 16), 3);
    double most = 0;
    for (std::size_t k = 0; k < levels.size(); ++k)
      most = std::max(most, levels[k] / std::max(variables.limits[k].most, 1e-9));
    for (double& level : levels) level *= most > 0 ? std::min(more, 1 / most) : 0;
  }
  mix(columns, levels, picture);
  return with_levels(variables, std::move(rig), levels);
}

std::optional<Sample> sample(const Setting& setting, Workspace& workspace, core::Random random) {
  const Variables& variables = setting.variables;
  auto rig = random_places(setting.layers, variables, random);
  if (!rig) return std::nullopt;
  std::vector<double> levels;
  for (std::size_t k = 0; k < variables.lit.size(); ++k)
    levels.push_back(random.uniform() < kDark
                         ? 0
                         : variables.limits[k].most * std::exp2(-random.uniform(0, kStops)));
  core::Plane picture;
  Sample out;
  out.rig = exposed(setting, workspace, with_levels(variables, *std::move(rig), levels),
                    random.uniform(kLightness.least, kLightness.most), picture);
  const Seen seen = seen_in(picture, setting.layers.geometry());
  if (!kLightness.contains(seen.lightness) || seen.burnt > kBurnt || seen.black > kLost)
    return std::nullopt;
  out.signature = signature_of(picture);
  return out;
}

std::vector<Sample> samples_of(const Setting& setting, const GalleryOptions& options) {
  std::vector<std::optional<Sample>> found(options.samples);
  Workspaces workspaces(setting);
  std::mutex mutex;
  std::size_t tried = 0;
  tbb::task_arena arena(std::max(1, options.threads));
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, options.samples, [&](std::size_t i) {
      if (options.stop != nullptr && *options.stop) return;
      auto workspace = workspaces.borrow();
      found[i] = sample(setting, *workspace, core::Random(options.seed, i));
      workspaces.give_back(std::move(workspace));
      const std::lock_guard lock(mutex);
      ++tried;
      if (options.progress) options.progress(tried);
    });
  });
  std::vector<Sample> samples;
  for (auto& each : found)
    if (each) samples.push_back(std::move(*each));
  return samples;
}

/// The least distance of `candidate` from the chosen ones, leaving out place `without`.
double least_apart(const std::vector<std::vector<float>>& signatures,
                   const std::vector<std::size_t>& chosen, std::size_t candidate,
                   std::size_t without) {
  double least = 1e9;
  for (std::size_t i = 0; i < chosen.size(); ++i)
    if (i != without) least = std::min(least, apart(signatures[candidate], signatures[chosen[i]]));
  return least;
}

/// From the brightest on, each time the look nearest to the last one: neighbours resemble.
std::vector<std::size_t> in_rows(const std::vector<std::vector<float>>& signatures,
                                 std::vector<std::size_t> chosen) {
  const auto brightness = [&](std::size_t i) {
    double sum = 0;
    for (const float l : signatures[i]) sum += double{l};
    return sum;
  };
  std::iter_swap(chosen.begin(),
                 std::max_element(chosen.begin(), chosen.end(), [&](std::size_t a, std::size_t b) {
                   return brightness(a) < brightness(b);
                 }));
  for (std::size_t i = 1; i + 1 < chosen.size(); ++i) {
    const auto nearest = std::min_element(chosen.begin() + static_cast<std::ptrdiff_t>(i),
                                          chosen.end(), [&](std::size_t a, std::size_t b) {
                                            return apart(signatures[chosen[i - 1]], signatures[a]) <
                                                   apart(signatures[chosen[i - 1]], signatures[b]);
                                          });
    std::iter_swap(chosen.begin() + static_cast<std::ptrdiff_t>(i), nearest);
  }
  return chosen;
}

double mean_apart(const std::vector<std::vector<float>>& signatures,
                  const std::vector<std::size_t>& of) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < of.size(); ++i)
    for (std::size_t j = 0; j < i; ++j, ++count) sum += apart(signatures[of[i]], signatures[of[j]]);
  return count > 0 ? sum / count : 0;
}

GalleryLook look_of(const studio::Studio& studio, const Layers& layers, const studio::Rig& rig,
                    std::size_t number, const GalleryOptions& options) {
  GalleryLook out;
  Look& look = out.look;
  look.name = "gallery " + std::to_string(number);
  look.goal = "gallery";
  look.optimiser = "dispersion";
  look.seed = options.seed;
  look.trials = options.samples;
  look.wanted = look.placed = rig;
  look.judgement.verdict = look.placed_judgement.verdict = Verdict::reached;
  look.picture = look.placed_picture = predicted(studio, layers, rig, Accuracy::exact);
  look.instructions = instructions(studio, studio::placed_rig(studio), rig);
  return out;
}

}  // namespace

std::vector<float> signature_of(const core::Plane& luminance) {
  core::Plane shown = luminance;
  for (float& y : shown.values) y = std::min(y, 1.0f);
  std::vector<float> cells = core::resized(shown, kCells).values;
  for (float& y : cells) y = static_cast<float>(core::lightness(double{y}));
  return cells;
}

double apart(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += double{a[i] - b[i]} * double{a[i] - b[i]};
  return a.empty() ? 0 : std::sqrt(sum / static_cast<double>(a.size()));
}

std::vector<std::size_t> most_dispersed(const std::vector<std::vector<float>>& signatures,
                                        std::size_t count) {
  std::vector<std::size_t> chosen;
  if (signatures.empty() || count == 0) return chosen;
  chosen.push_back(0);
  while (chosen.size() < std::min(count, signatures.size())) {
    std::size_t farthest = 0;
    double most = -1;
    for (std::size_t i = 0; i < signatures.size(); ++i) {
      const double least = least_apart(signatures, chosen, i, chosen.size());
      if (least > most) most = least, farthest = i;
    }
    chosen.push_back(farthest);
  }
  for (bool better = true; better;) {
    better = false;
    for (std::size_t place = 0; place < chosen.size(); ++place) {
      double now = least_apart(signatures, chosen, chosen[place], place);
      for (std::size_t i = 0; i < signatures.size(); ++i) {
        const double least = least_apart(signatures, chosen, i, place);
        if (least <= now * (1 + 1e-9)) continue;
        chosen[place] = i;
        now = least;
        better = true;
      }
    }
  }
  return chosen;
}

core::Result<Gallery> gallery(const studio::Studio& studio, const LayersSource& twin,
                              const GalleryOptions& options) {
  Options design;
  design.locked = options.locked;
  design.move_stands = options.move_stands;
  if (auto problems = problems_of(studio, design); core::any_error(problems)) return problems;
  const Variables variables = variables_of(studio, design);
  if (variables.lit.empty())
    return core::Problem{{}, "every lamp is locked: there is nothing to vary", "unlock one"};
  const Layers& small = twin.at(options.sample_size);
  ExampleGoal any;  // layers are wanted, no goal
  any.exemplar = core::Picture(options.sample_size);
  any.objective = Objective::perceptual;
  const Target none = target_of(any, options.sample_size);
  const measure::PixelMap map = measure::flat_pixel_map(options.sample_size);
  const Setting setting{studio, small, variables, none, map, Accuracy::cached};
  const std::vector<Sample> samples = samples_of(setting, options);
  if (samples.empty())
    return core::Problem{{},
                         "none of " + std::to_string(options.samples) +
                             " rigs gives a usable picture of the subject",
                         "check that lamps reach the subject, and the camera's exposure"};
  std::vector<std::vector<float>> signatures;
  for (const Sample& each : samples) signatures.push_back(each.signature);
  const auto chosen = in_rows(signatures, most_dispersed(signatures, options.looks));

  Gallery out;
  out.tried = options.samples;
  out.usable = samples.size();
  out.mean_apart = mean_apart(signatures, chosen);
  std::vector<std::size_t> first(std::min<std::size_t>(samples.size(), 100));
  for (std::size_t i = 0; i < first.size(); ++i) first[i] = i;
  out.mean_random = mean_apart(signatures, first);
  out.least_apart = 1e9;
  const Layers& full = twin.at(options.picture_size);
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    out.looks.push_back(look_of(studio, full, samples[chosen[i]].rig, i + 1, options));
    out.looks.back().apart = chosen.size() > 1 ? least_apart(signatures, chosen, chosen[i], i) : 0;
    out.least_apart = std::min(out.least_apart, out.looks.back().apart);
  }
  for (const auto& signature : signatures) {
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < chosen.size(); ++i)
      if (apart(signature, signatures[chosen[i]]) < apart(signature, signatures[chosen[nearest]]))
        nearest = i;
    out.looks[nearest].share += 1.0 / static_cast<double>(samples.size());
  }
  return out;
}

core::Picture contact_sheet(const Gallery& gallery) {
  constexpr int kGap = 6;
  constexpr double kGrey = 0.05;
  if (gallery.looks.empty()) return {};
  const core::Size one = gallery.looks.front().look.picture.size();
  const int count = static_cast<int>(gallery.looks.size());
  const int columns = std::max(std::min(3, count),
                               static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count)))));
  const int rows = (count + columns - 1) / columns;
  core::Picture sheet({columns * (one.width + kGap) + kGap, rows * (one.height + kGap) + kGap});
  for (int y = 0; y < sheet.size().height; ++y)
    for (int x = 0; x < sheet.size().width; ++x) sheet.set(x, y, {kGrey, kGrey, kGrey});
  for (int i = 0; i < count; ++i) {
    const core::Picture& picture = gallery.looks[static_cast<std::size_t>(i)].look.picture;
    const int left = kGap + (i % columns) * (one.width + kGap);
    const int top = kGap + (i / columns) * (one.height + kGap);
    for (int y = 0; y < one.height; ++y)
      for (int x = 0; x < one.width; ++x) sheet.set(left + x, top + y, picture.at(x, y));
  }
  return sheet;
}

}  // namespace chiaro::design
