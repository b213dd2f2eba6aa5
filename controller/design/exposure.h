// SPDX-License-Identifier: Apache-2.0
// The same studio through a camera exposed or balanced otherwise: for advice, never silently.
#pragma once

#include "controller/design/layers.h"

namespace chiaro::design {

/// Every layer of `inner` times a factor per channel. Borrows `inner`. Thread-safe.
class ReexposedLayers : public Layers {
 public:
  ReexposedLayers(const Layers& inner, core::Rgb factor);

  core::Size size() const override { return inner_.size(); }
  const core::GeometryPlanes* geometry() const override { return inner_.geometry(); }
  const core::Picture& ambient() const override { return ambient_; }
  void luminance(std::size_t fixture, const core::FixtureState& state, Accuracy accuracy,
                 core::Plane& out) const override;
  void colour(std::size_t fixture, const core::FixtureState& state, Accuracy accuracy,
              core::Layer& out) const override;
  void visibility(std::size_t fixture, const core::FixtureState& state, Accuracy accuracy,
                  core::Plane& out) const override;
  std::string infeasible(const studio::Rig& rig, std::size_t fixture) const override;

 private:
  const Layers& inner_;
  const core::Rgb factor_;
  core::Picture ambient_;
};

}  // namespace chiaro::design
