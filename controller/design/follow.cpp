// SPDX-License-Identifier: Apache-2.0
#include "controller/design/follow.h"

#include <algorithm>
#include <cmath>

#include "controller/render/lighting.h"
#include "controller/render/samples.h"

namespace chiaro::design {
namespace {

Variables standing(const studio::Studio& studio, const studio::Rig& look,
                   const std::vector<std::string>& locked) {
  Options options;
  options.start = look;
  options.locked = locked;
  options.move_stands = false;
  return variables_of(studio, options);
}

/// What the lamp adds at full level, its shadows traced once per pixel.
void light_alone(const studio::Studio& studio, const render::View& view, std::size_t fixture,
                 const core::FixtureState& state, double gain, core::Plane& out) {
  core::FixtureState full = state;
  full.set(core::Dof::intensity, 1);
  const twin::Light light = twin::light(studio.fixtures[fixture], full, view.tracer->geometry().aim,
                                        studio.exposure.white_balance);
  const render::Traced traced(view, light, render::kHard);
  render::luminance(view, light, gain, &traced, out, render::Shading::quick);
}

}  // namespace

Follower::Follower(const studio::Studio& studio, std::shared_ptr<const twin::Geometry> geometry,
                   const Goal& goal, const studio::Rig& look,
                   const std::vector<std::string>& locked, const FollowOptions& options)
    : studio_(studio),
      options_(options),
      tracer_(geometry),
      geometry_(std::move(geometry)),
      target_(target_of(goal, options.size)),
      lamps_(standing(studio, look, locked)),
      rig_(look),
      gain_(studio::exposure_gain(studio.exposure, studio.main_camera())),
      planes_(lamps_.lit.size(), core::Plane(options.size)) {
  for (const std::size_t fixture : lamps_.lit)
    aims_.push_back(look.states[fixture].get(core::Dof::intensity));
  if (target_.by_geometry) return;  // the map then changes with the view
  map_ = measure::flat_pixel_map(options.size);
  solver_ = level_solver(target_, map_);
}

Follower::~Follower() = default;

void Follower::fetch(const render::View& view) {
  const twin::Scene scene = twin::lit_by(studio_, geometry_, rig_);
  offset_ = core::luminance(render::ambient_layer(view, scene.ambient_irradiance, gain_));
  core::Plane held(options_.size);
  for (const std::size_t fixture : lamps_.held) {
    const auto level = static_cast<float>(rig_.states[fixture].get(core::Dof::intensity));
    if (level <= 0) continue;
    light_alone(studio_, view, fixture, rig_.states[fixture], gain_, held);
    for (std::size_t i = 0; i < held.values.size(); ++i)
      offset_.values[i] += level * held.values[i];
  }
  for (std::size_t k = 0; k < lamps_.lit.size(); ++k)
    light_alone(studio_, view, lamps_.lit[k], rig_.states[lamps_.lit[k]], gain_, planes_[k]);
}

Follower::Frame Follower::follow(const render::Motion& moved, double seconds) {
  const render::View view = render::see(tracer_.at(moved), studio_.main_camera(), options_.size);
  fetch(view);
  if (target_.by_geometry) {
    map_ = measure::pixel_map(core::planes(view.buffer));
    solver_ = level_solver(target_, map_);
  }
  Columns columns;
  for (const core::Plane& plane : planes_) columns.planes.push_back(&plane);
  columns.offset = &offset_;
  columns.bounds = lamps_.limits;
  const Levels wanted = solver_->solve(columns, Effort::quick);

  Frame frame;
  frame.cost = wanted.cost;
  const double share = 1 - std::exp(-std::max(0.0, seconds) / options_.settle_s);
  const double most = options_.most_per_s * std::max(0.0, seconds);
  for (std::size_t k = 0; k < aims_.size(); ++k) {
    if (std::abs(wanted.values[k] - aims_[k]) > options_.dead_band) aims_[k] = wanted.values[k];
    core::FixtureState& state = rig_.states[lamps_.lit[k]];
    const double now = state.get(core::Dof::intensity);
    const double change = std::clamp(share * (aims_[k] - now), -most, most);
    state.set(core::Dof::intensity, lamps_.limits[k].clamp(now + change));
    frame.change = std::max(frame.change, std::abs(state.get(core::Dof::intensity) - now));
  }
  frame.rig = rig_;
  return frame;
}

}  // namespace chiaro::design
