// SPDX-License-Identifier: Apache-2.0
// A layer for a light: all that `design` asks of a twin. The geometric twin implements it with the
// view and its visibility cache, the captured twin with photographs.
#pragma once

#include <memory>
#include <string>

#include "controller/core/gbuffer.h"
#include "controller/core/picture.h"
#include "controller/studio/studio.h"

namespace chiaro::design {

/// cached: visibility blended between grid neighbours, the search's everyday food.
/// exact: traced, for the polish and the final picture.
enum class Accuracy { cached, exact };

/// Thread-safe: planner threads ask at once. A value depends only on the arguments, never on what
/// is already cached. All layers are display-linear, at intensity 1, in the colour that `state`
/// asks for, the camera's exposure and white balance applied.
class Layers {
 public:
  virtual ~Layers() = default;

  virtual core::Size size() const = 0;
  /// Null when the twin has no geometry.
  virtual const core::GeometryPlanes* geometry() const = 0;
  /// What is there with every controlled lamp at 0: ambient and uncontrolled practicals.
  virtual const core::Picture& ambient() const = 0;

  /// Diffuse + specular as one luminance plane. `out` must have size().
  virtual void luminance(std::size_t fixture, const core::FixtureState& state, Accuracy accuracy,
                         core::Plane& out) const = 0;
  /// In colour, diffuse and specular apart.
  virtual void colour(std::size_t fixture, const core::FixtureState& state, Accuracy accuracy,
                      core::Layer& out) const = 0;
  /// Fraction of the lamp that each pixel sees, 0..1, cast shadows only.
  virtual void visibility(std::size_t fixture, const core::FixtureState& state, Accuracy accuracy,
                          core::Plane& out) const = 0;
  /// The same view of a subject of one diffuse colour all over, gloss as it is; null where the
  /// twin does not know what is skin and what is light. Light that surfaces send each other leaves
  /// them in the mesh's own colours and is seen on that one. Borrows this.
  virtual std::unique_ptr<Layers> with_skin(core::Rgb diffuse) const;
  /// Both in one pass: the same answers, for less than the price of two.
  virtual void luminance_and_visibility(std::size_t fixture, const core::FixtureState& state,
                                        Accuracy accuracy, core::Plane& out,
                                        core::Plane& seen) const {
    luminance(fixture, state, accuracy, out);
    visibility(fixture, state, accuracy, seen);
  }
  /// Empty when the fixture may stand there with the others as in `rig`; else why not.
  virtual std::string infeasible(const studio::Rig& rig, std::size_t fixture) const = 0;
};

inline std::unique_ptr<Layers> Layers::with_skin(core::Rgb) const { return nullptr; }

/// Layers at several sizes of one twin: search small, polish full.
class LayersSource {
 public:
  virtual ~LayersSource() = default;
  /// Built on first use and kept. Thread-safe.
  virtual const Layers& at(core::Size size) const = 0;
};

struct GeometricOptions {
  std::filesystem::path mesh_cache;  ///< empty = none
  std::size_t visibility_cache_bytes = 192u << 20;
  bool reference = false;  ///< every layer traced anew, nothing cached
  int threads = 2;         ///< for building view and visibility
};
core::Result<std::unique_ptr<LayersSource>> geometric_layers(const studio::Studio& studio,
                                                             const GeometricOptions& options);

}  // namespace chiaro::design
