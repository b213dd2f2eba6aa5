// SPDX-License-Identifier: Apache-2.0
// The offline path tracer: what a real camera would see of the studio, light bounced between
// surfaces included. It draws the shipped moods and plays the real world in tests of the design
// engine, which itself knows direct light only.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <vector>

#include "controller/core/picture.h"
#include "controller/render/view.h"
#include "controller/studio/studio.h"
#include "controller/twin/scene.h"

namespace chiaro::simulator {

struct TraceOptions {
  int samples = 64;        ///< paths per pixel, >= 1
  int bounces = 6;         ///< diffuse bounces after the first hit; 0 = direct light only
  std::uint64_t seed = 1;  ///< same seed, same bits, whatever `threads`
  bool antialias = true;   ///< spread the samples over the pixel; false = all through its centre
  /// Bounced light of one sample is clipped to this display-linear value, which takes out the odd
  /// bright speck at the price of a little energy; 0 = never clipped.
  double most_bounced = 8;
  int threads = 0;                            ///< 0 = as many as the machine has
  const std::atomic<bool>* stop = nullptr;    ///< set by another thread: returns early, unfinished
  std::function<void(double done)> progress;  ///< 0..1, one thread at a time
};

/// Display-linear (the scene's exposure gain applied, unclipped). Light transport is linear: the
/// picture for any levels is ambient + sum of level * lights[i], so lamps that only dim need no new
/// tracing.
struct TracedLayers {
  std::vector<core::Picture> lights;  ///< one per scene light, each at level 1
  core::Picture ambient;
  /// Standard error of the luminance at the scene's levels, per pixel and as the root mean square
  /// over the picture: what is left of the noise.
  core::Plane error;
  double noise = 0;
};

/// Diffuse interreflection by path tracing with next-event estimation of every light at every
/// vertex and Russian roulette; the highlight (Blinn) counts at the first vertex only. Lights are
/// points, spots, suns, rectangles and disks as in twin::Light; a rectangle or a disk shines from
/// one side and is itself invisible. Ambient light comes from everywhere outside the geometry; with
/// bounces = 0 it is added flat, as render::ambient_layer does. Pixels that see nothing are 0.
/// Thread-safe. Preconditions: samples >= 1, size not empty, tracer's geometry is the scene's.
TracedLayers trace_layers(const render::Tracer& tracer, const twin::Scene& scene,
                          const studio::Camera& camera, core::Size size,
                          const TraceOptions& options = {});

struct Traced {
  core::Picture picture;
  core::Plane error;
  double noise = 0;
};
/// The scene at its levels; lamps at level 0 cost nothing.
Traced trace(const render::Tracer& tracer, const twin::Scene& scene, const studio::Camera& camera,
             core::Size size, const TraceOptions& options = {});

/// The mix of layers at other levels. Precondition: levels.size() == layers.lights.size().
core::Picture mixed(const TracedLayers& layers, const std::vector<double>& levels);

}  // namespace chiaro::simulator
