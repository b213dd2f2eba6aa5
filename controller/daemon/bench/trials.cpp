// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <memory>

#include "controller/daemon/bench/bench.h"
#include "controller/daemon/bench/stopwatch.h"
#include "controller/design/geometric_layers.h"
#include "controller/design/stages.h"
#include "controller/optimise/search.h"

namespace chiaro::daemon::bench {
namespace {

constexpr std::size_t kLights = 3;
/// Bytes that a trial must touch per pixel: 12 surface numbers and 8 grid neighbours' visibility
/// for the layer, twice 4 written (layer, shadow), 4 layers read and a picture written, and
/// picture, shadow and pixel type read by the measures.
constexpr double kLayerBytes = 12 * 4 + 8 + 2 * 4;
constexpr double kTrialBytes = kLayerBytes + 5 * 4 + 2 * 4 + 1;

/// The first lamps of the studio that a design may light, the one that can be moved first.
std::vector<std::size_t> chosen_lights(const studio::Studio& studio) {
  std::vector<std::size_t> lights;
  for (std::size_t i = 0; i < studio.fixtures.size(); ++i)
    if (studio.fixtures[i].controlled) lights.push_back(i);
  std::stable_partition(lights.begin(), lights.end(), [&](std::size_t i) {
    return design::region_of(studio.fixtures[i]) != nullptr;
  });
  lights.resize(std::min(lights.size(), kLights));
  return lights;
}

/// States of that lamp spread over its region.
std::vector<core::FixtureState> places(const studio::Studio& studio, std::size_t fixture, int n) {
  const studio::Rig rig = studio::placed_rig(studio);
  std::vector<core::FixtureState> out;
  for (int i = 0; i < n; ++i) {
    core::FixtureState state = rig.states[fixture];
    if (const studio::Region* region = design::region_of(studio.fixtures[fixture])) {
      const auto at = optimise::spread_point(static_cast<std::uint64_t>(i), 3, 1);
      const auto within = [](core::Range r, double share) { return r.least + share * r.width(); };
      state.set(core::Dof::azimuth, within(region->azimuth, at[0]));
      state.set(core::Dof::elevation, within(region->elevation, at[1]));
      state.set(core::Dof::distance, within(region->distance, at[2]));
    }
    state.set(core::Dof::intensity, 1);
    out.push_back(state);
  }
  return out;
}

studio::Studio with_optic(studio::Studio studio, const studio::Optic& optic) {
  for (studio::Fixture& fixture : studio.fixtures) {
    fixture.modifiers.clear();
    fixture.profile.optic = optic;
  }
  return studio;
}

/// One trial: the moved lamp's layer, the mix, all six components, as the design engine does it.
class Trial {
 public:
  Trial(const design::Layers& layers, const std::vector<std::size_t>& lights,
        const studio::Rig& rig, design::Accuracy accuracy)
      : layers_(layers),
        lights_(lights),
        accuracy_(accuracy),
        map_(measure::pixel_map(*layers.geometry())),
        planes_(lights.size(), core::Plane(layers.size())),
        ambient_(core::luminance(layers.ambient())),
        picture_(layers.size()),
        lit_(layers.size()),
        levels_(lights.size(), 0.3) {
    for (std::size_t k = 0; k < lights.size(); ++k) {
      fetch(k, rig.states[lights[k]]);
      columns_.push_back(&planes_[k]);
    }
  }
  void fetch(std::size_t k, const core::FixtureState& state) {
    layers_.luminance(lights_[k], state, accuracy_, planes_[k]);
  }
  /// The layer and what is seen of the lamp, for the shadow weights.
  void move(const core::FixtureState& state) {
    layers_.luminance_and_visibility(lights_[0], state, accuracy_, planes_[0], lit_);
  }
  double rest() {
    render::relit(columns_, levels_, ambient_, picture_);
    const auto now = measure::components_of_luminance(picture_, map_, &lit_);
    return measure::ideal_cost(now, {});
  }

 private:
  const design::Layers& layers_;
  const std::vector<std::size_t>& lights_;
  design::Accuracy accuracy_;
  measure::PixelMap map_;
  std::vector<core::Plane> planes_;
  core::Plane ambient_, picture_, lit_;
  std::vector<double> levels_;
  std::vector<const core::Plane*> columns_;
};

struct Timed {
  double layer_us = 0, trial_us = 0, traced_layer_us = 0, reference_us = 0;
};

core::Result<Timed> time_trials(const Plan& plan, const studio::Studio& studio,
                                ports::World& world) {
  const auto twin = design::geometric_layers(
      studio, {.mesh_cache = world.state_folder / "meshes", .reference = false, .threads = 1});
  if (!twin) return twin.problems();
  const design::Layers& layers = (*twin)->at(plan.size);
  const auto lights = chosen_lights(studio);
  if (lights.empty())
    return core::Problem{{studio.file.string()}, "no lamp that a design may light", "add one"};
  const studio::Rig rig = studio::placed_rig(studio);
  const auto states = places(studio, lights.front(), plan.quick ? 8 : 48);

  Timed out;
  Trial fast(layers, lights, rig, design::Accuracy::cached);
  for (const auto& state : states) fast.move(state);  // fills the visibility cache
  std::vector<double> layer, trial;
  for (int round = 0; round < (plan.quick ? 2 : 10); ++round)
    for (const auto& state : states) {
      const Stopwatch watch(world.clock);
      fast.move(state);
      layer.push_back(watch.seconds() * 1e6);
      fast.rest();
      trial.push_back(watch.seconds() * 1e6);
    }
  out.layer_us = median(layer);
  out.trial_us = median(trial);

  // The reference remembers nothing: every lamp is traced again, those that stand still too.
  const auto bare = design::geometric_layers(
      studio, {.mesh_cache = world.state_folder / "meshes", .reference = true, .threads = 1});
  if (!bare) return bare.problems();
  std::vector<double> traced, reference;
  Trial exact((*bare)->at(plan.size), lights, rig, design::Accuracy::exact);
  for (std::size_t i = 0; i < std::min<std::size_t>(states.size(), plan.quick ? 1 : 4); ++i) {
    const Stopwatch watch(world.clock);
    exact.move(states[i]);
    traced.push_back(watch.seconds() * 1e6);
    for (std::size_t k = 1; k < lights.size(); ++k) exact.fetch(k, rig.states[lights[k]]);
    exact.rest();
    reference.push_back(watch.seconds() * 1e6);
  }
  out.traced_layer_us = median(traced);
  out.reference_us = median(reference);
  return out;
}

}  // namespace

core::Result<core::Done> trials(const Plan& plan, ports::World& world, Report& report) {
  const auto size = std::to_string(plan.size.width) + " x " + std::to_string(plan.size.height);
  const double roof_us = 1e6 * kTrialBytes * static_cast<double>(plan.size.pixels()) /
                         std::max(1.0, read_bandwidth(world.clock, 8u << 20, plan.quick));
  report.heading("One trial: one of 3 lamps moved, all six components, " + size + ", one core");
  studio::Optic soft;
  soft.kind = studio::Optic::Kind::rectangle;
  soft.width = 0.6;
  soft.height = 0.9;
  for (const auto& [name, optic] : {std::pair("point", studio::Optic{}), {"rectangle", soft}}) {
    const auto timed = time_trials(plan, with_optic(plan.studio, optic), world);
    if (!timed) return timed.problems();
    const std::string lamp = name;
    const auto reached = [](double roof, double time) {
      char note[64];
      std::snprintf(note, sizeof note, "roof %.0f us, %.0f %% of it reached", roof,
                    time > 0 ? 100 * roof / time : 0);
      return std::string(note);
    };
    report.add("layer, cached visibility, " + lamp, timed->layer_us, "us", {},
               reached(roof_us * kLayerBytes / kTrialBytes, timed->layer_us));
    report.add("trial, " + lamp, timed->trial_us, "us", at_most(200),
               reached(roof_us, timed->trial_us));
    report.add("layer, traced, " + lamp, timed->traced_layer_us, "us");
    report.add("reference trial, " + lamp, timed->reference_us, "us");
    report.add("reference : fast, " + lamp,
               timed->trial_us > 0 ? timed->reference_us / timed->trial_us : 0, "x");
  }
  return core::Done{};
}

core::Result<core::Done> levels(const Plan& plan, ports::World& world, Report& report) {
  report.heading("Levels alone, layers known, one core");
  const auto twin = design::geometric_layers(
      plan.studio, {.mesh_cache = world.state_folder / "meshes", .threads = 1});
  if (!twin) return twin.problems();
  const design::Layers& layers = (*twin)->at(plan.size);
  const design::Options options;
  const design::Variables all = design::variables_of(plan.studio, options);
  for (const auto objective : {design::Objective::wavelet, design::Objective::perceptual}) {
    design::ExampleGoal goal = plan.mood;
    goal.objective = objective;
    const design::Goal wanted = goal;
    const design::Target target = design::target_of(wanted, layers.size());
    const measure::PixelMap map = design::map_for(layers, target);
    const design::Variables lamps = design::searched(plan.studio, all, wanted);
    const design::Setting setting{plan.studio, layers, lamps,
                                  target,      map,    design::Accuracy::cached};
    design::Workspace workspace(setting);
    const design::Columns& columns = workspace.columns(all.base);
    const double us = best_us(world.clock, plan.quick ? 3 : 7, plan.quick ? 1 : 5,
                              [&] { workspace.solver().solve(columns, design::Effort::quick); });
    const bool wavelet = objective == design::Objective::wavelet;
    report.add(std::string("solve ") + std::to_string(columns.planes.size()) + " levels, " +
                   (wavelet ? "wavelet in L*" : "six components"),
               us, "us", wavelet ? at_most(2000) : Bar{});
  }
  return core::Done{};
}

}  // namespace chiaro::daemon::bench
