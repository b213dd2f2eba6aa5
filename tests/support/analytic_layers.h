// SPDX-License-Identifier: Apache-2.0
// A twin in closed form for quick tests of the design engine: a matt and slightly shiny sphere
// before a wall, point lamps, Lambert + Blinn, no cast shadows, no tracer.
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "controller/design/layers.h"
#include "controller/studio/studio.h"

namespace chiaro::support {

/// A studio with a camera 2.6 m before the sphere, exposed for 800 lx, and no fixtures.
studio::Studio analytic_studio();
/// A dimmer of `candela` on a stand with a wide region: azimuth +-80 (or behind for back lights),
/// elevation -20..70, distance 1.2..2.4.
studio::Fixture stand_lamp(std::string name, studio::Role role, core::Spherical at, double candela);
studio::Fixture fixed_lamp(std::string name, studio::Role role, core::Vec3 at, double candela);

/// Lamps must stay 0.6 m from the aim and 0.4 m apart.
class AnalyticLayers : public design::Layers {
 public:
  AnalyticLayers(const studio::Studio& studio, core::Size size);
  core::Size size() const override { return size_; }
  const core::GeometryPlanes* geometry() const override { return &planes_; }
  const core::Picture& ambient() const override { return ambient_; }
  void luminance(std::size_t fixture, const core::FixtureState& state, design::Accuracy accuracy,
                 core::Plane& out) const override;
  void colour(std::size_t fixture, const core::FixtureState& state, design::Accuracy accuracy,
              core::Layer& out) const override;
  void visibility(std::size_t fixture, const core::FixtureState& state, design::Accuracy accuracy,
                  core::Plane& out) const override;
  std::string infeasible(const studio::Rig& rig, std::size_t fixture) const override;
  core::Vec3 position(std::size_t fixture, const core::FixtureState& state) const;
  /// Layers made so far.
  std::uint64_t made() const { return made_; }

 private:
  struct Sample {
    core::Vec3 at, normal, to_eye;
    double albedo = 0.5, specular = 0;
    bool subject = false;
  };
  void see();
  std::pair<double, double> shade(const Sample& sample, core::Vec3 lamp) const;

  const studio::Studio& studio_;
  core::Size size_;
  core::AimFrame frame_;
  double gain_ = 1;
  std::vector<Sample> samples_;
  core::GeometryPlanes planes_;
  core::Picture ambient_;
  mutable std::atomic<std::uint64_t> made_ = 0;
};

class AnalyticSource : public design::LayersSource {
 public:
  explicit AnalyticSource(const studio::Studio& studio) : studio_(studio) {}
  const design::Layers& at(core::Size size) const override;

 private:
  const studio::Studio& studio_;
  mutable std::mutex mutex_;
  mutable std::map<std::pair<int, int>, std::unique_ptr<AnalyticLayers>> layers_;
};

}  // namespace chiaro::support
