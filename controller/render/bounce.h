// SPDX-License-Identifier: Apache-2.0
// Light that comes by way of other surfaces: the wall's glow on a cheek, the shirt's under a chin.
// In a room it is a tenth to a third of the picture; a twin without it takes it for light from
// lamps and puts those in the wrong place. It is smooth, so it is kept coarsely: what some hundred
// patches of the scene receive from a lamp, bounced between them, is gathered at a thousand points
// of the view and spread from there to the pixels. Diffuse surfaces only.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "controller/render/view.h"

namespace chiaro::render {

/// What arrives at the field's points by way of other surfaces: lux, red, green and blue apart, of
/// a lamp whose own light is white.
struct Bounced {
  std::array<std::vector<float>, 3> lux;
};

/// The paths between surfaces as one camera sees them: traced once, then asked for any lamp.
/// Immutable after construction; thread-safe. The answer depends on the arguments only.
class BounceField {
 public:
  BounceField(std::shared_ptr<const Tracer> tracer, const studio::Camera& camera);
  ~BounceField();
  /// Of a lamp at full level; a few hundred shadow rays.
  Bounced from(const twin::Light& light) const;
  std::size_t patches() const;

 private:
  friend class BounceMap;
  struct State;
  std::unique_ptr<const State> state_;
};

/// From the field's points to the pixels of one view. Immutable; thread-safe. `field` is needed
/// only while constructing.
class BounceMap {
 public:
  BounceMap(const BounceField& field, const View& view);
  /// Adds the bounced light of a lamp of that colour, exposure applied. `out` has the view's size.
  void add_luminance(const Bounced& bounced, const core::Rgb& colour, double gain,
                     core::Plane& out) const;
  void add_colour(const Bounced& bounced, const core::Rgb& colour, double gain,
                  core::Picture& out) const;

 private:
  static constexpr std::size_t kNear = 4;  ///< field points that a pixel is spread from
  std::vector<std::uint32_t> pixel_;
  std::vector<std::array<std::uint16_t, kNear>> point_;
  std::vector<std::array<float, kNear>> weight_;
  std::vector<std::array<float, 3>> albedo_;
};

/// The field's answers on a grid of places where each lamp may stand, blended between neighbours.
/// Thread-safe; the answer does not depend on what was asked before.
class BounceCache {
 public:
  /// Both must outlive the cache.
  BounceCache(const BounceField& field, const studio::Studio& studio, const core::AimFrame& aim);
  ~BounceCache();
  Bounced at(std::size_t fixture, const core::FixtureState& state) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace chiaro::render
