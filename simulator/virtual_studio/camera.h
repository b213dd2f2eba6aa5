// SPDX-License-Identifier: Apache-2.0
// The virtual studio's camera: one white layer per lamp, drawn again only when that lamp's beam has
// changed, mixed by levels and colours for every frame.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "controller/core/picture.h"
#include "controller/render/bounce.h"
#include "controller/render/view.h"
#include "controller/studio/studio.h"
#include "simulator/virtual_studio/stage.h"

namespace chiaro::simulator {

/// fast: direct light alone. bounced: with what walls and floor give back, coarsely, as the planner
/// predicts it. path: traced like a real room, slowly.
enum class Renderer { fast, bounced, path };

struct CameraOptions {
  Renderer renderer = Renderer::fast;
  int samples = 48;  ///< paths per pixel
  std::uint64_t seed = 1;
  int threads = 0;                          ///< path: 0 = as many as the machine has
  const std::atomic<bool>* stop = nullptr;  ///< path: ends a drawing early
};

/// Thread-bound: the thread that asks for pictures. Borrows the studio and the camera.
class VirtualCamera {
 public:
  VirtualCamera(const studio::Studio& studio, const studio::Camera& camera,
                std::shared_ptr<const render::Tracer> tracer, const CameraOptions& options);

  /// What falls on the sensor now, display-linear, unclipped. Blocks while layers are drawn.
  core::Picture picture(const std::vector<LitLamp>& lamps);
  const studio::Camera& camera() const { return camera_; }
  /// Drawn since construction: for tests, which count instead of timing.
  std::size_t layers_drawn() const { return layers_drawn_; }

 private:
  struct Drawn {
    bool valid = false;
    twin::Light beam;  ///< in white
    core::Picture white;
  };
  core::Picture draw(const twin::Light& white);
  core::Picture draw_ambient();

  const studio::Studio& studio_;
  const studio::Camera& camera_;
  std::shared_ptr<const render::Tracer> tracer_;
  CameraOptions options_;
  double gain_;
  render::View view_;
  core::Picture ambient_;
  std::unique_ptr<const render::BounceField> bounces_;  ///< both of `bounced` only
  std::unique_ptr<const render::BounceMap> bounce_map_;
  std::vector<Drawn> drawn_;
  std::size_t layers_drawn_ = 0;
};

}  // namespace chiaro::simulator
