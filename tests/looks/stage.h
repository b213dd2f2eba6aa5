// SPDX-License-Identifier: Apache-2.0
// What the tests of looks share: rooms with a sitter turned as a mood asks, designs in them, and
// the virtual studio's camera, which plays the real one.
#pragma once

#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <vector>

#include "controller/core/picture_file.h"
#include "controller/design/design.h"
#include "controller/design/moods.h"
#include "controller/render/view.h"
#include "controller/studio/load.h"
#include "controller/twin/scene.h"
#include "simulator/virtual_studio/camera.h"
#include "simulator/virtual_studio/noise.h"
#include "simulator/virtual_studio/stage.h"
#include "tests/support/fake_world.h"

namespace chiaro::looks {

inline const studio::Folders kFolders{std::filesystem::path(CHIARO_SOURCE) / "config"};
inline constexpr core::Size kSize{160, 120};

/// A studio with everything that stays while moods change.
struct Room {
  studio::Studio studio;
  studio::Camera camera;
  std::shared_ptr<const twin::Geometry> geometry;
  std::shared_ptr<const render::Tracer> tracer;
  core::GBuffer view;
};

inline Room room(studio::Studio studio, const std::filesystem::path& cache) {
  Room out{std::move(studio), {}, {}, {}, {}};
  out.camera = out.studio.main_camera();
  out.camera.size = kSize;
  auto geometry = twin::build_geometry(out.studio, cache);
  if (!geometry) {
    ADD_FAILURE() << core::to_string(geometry.problems());
    return out;
  }
  out.geometry = *geometry;
  out.tracer = std::make_shared<const render::Tracer>(out.geometry);
  out.view = render::see(out.tracer, out.camera, kSize).buffer;
  return out;
}

inline studio::Studio portrait() {
  return studio::load_studio(kFolders.studios() / "portrait.yaml", kFolders)->studio;
}
/// The sitter turned as the mood asks.
inline studio::Studio turned(studio::Studio studio, const design::Mood& mood) {
  for (studio::Subject& subject : studio.subjects) subject.facing += mood.sitter_turn;
  return studio;
}

inline std::vector<design::Mood> moods() { return design::load_moods(kFolders.moods()).moods; }

inline core::Result<design::Look> designed(const Room& room, const design::Mood& mood,
                                           std::uint64_t trials,
                                           const std::filesystem::path& cache) {
  const auto layers = design::geometric_layers(room.studio, {.mesh_cache = cache});
  if (!layers) return layers.problems();
  const auto goal = design::goal_of(mood, design::Objective::wavelet);
  if (!goal) return goal.problems();
  design::Options options;
  options.trials = trials;
  options.align = options.normalise = true;
  return design::design(room.studio, **layers, *goal, options);
}

/// Stands are put where the look says, lamps are asked what it says, and the camera looks.
inline core::Picture photograph(const Room& room, const studio::Rig& rig,
                                const studio::Camera& camera, int samples = 8) {
  simulator::VirtualStage stage(room.studio, room.geometry->aim, simulator::Departures{}, 7);
  for (std::size_t i = 0; i < rig.states.size(); ++i) stage.put(i, rig.states[i]);
  stage.ask(rig);
  stage.advance(5);
  simulator::CameraOptions options;
  options.renderer = simulator::Renderer::path;
  options.samples = samples;
  simulator::VirtualCamera eye(room.studio, camera, room.tracer, options);
  return core::linear(simulator::exposed(eye.picture(stage.lit()), simulator::Sensor{}, 3, 0));
}

}  // namespace chiaro::looks
