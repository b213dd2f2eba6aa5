// SPDX-License-Identifier: Apache-2.0
#include "tests/support/analytic_layers.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace chiaro::support {
namespace {

constexpr double kRadius = 0.35, kWall = 1.6, kShininess = 24;
const core::Vec3 kAim{0, 0, 1.35};

}  // namespace

studio::Studio analytic_studio() {
  studio::Studio studio;
  studio.name = "analytic";
  studio.fingerprint = 0xc41a20;
  studio::Subject subject;
  subject.name = "subject";
  subject.aim = kAim;
  studio.subjects.push_back(subject);
  studio::Camera camera;
  camera.name = "main";
  camera.at = {0, -2.6, 1.35};
  camera.look_at = kAim;
  camera.vertical_fov = core::radians(22);
  studio.cameras.push_back(camera);
  return studio;
}

studio::Fixture stand_lamp(std::string name, studio::Role role, core::Spherical at,
                           double candela) {
  studio::Fixture fixture;
  fixture.name = std::move(name);
  fixture.role = role;
  fixture.output = core::Candela{candela};
  fixture.profile.output = fixture.output;
  const bool behind = role == studio::Role::back;
  fixture.mount = studio::StandMount{at,
                                     {behind ? core::Range{core::radians(120), core::radians(175)}
                                             : core::Range{core::radians(-80), core::radians(80)},
                                      {core::radians(-20), core::radians(70)},
                                      {1.2, 2.4}}};
  fixture.initial.set(core::Dof::intensity, 0);
  return fixture;
}

studio::Fixture fixed_lamp(std::string name, studio::Role role, core::Vec3 at, double candela) {
  studio::Fixture fixture;
  fixture.name = std::move(name);
  fixture.role = role;
  fixture.output = core::Candela{candela};
  fixture.profile.output = fixture.output;
  fixture.mount = studio::FixedMount{at, kAim};
  fixture.initial.set(core::Dof::intensity, 0);
  return fixture;
}

AnalyticLayers::AnalyticLayers(const studio::Studio& studio, core::Size size)
    : studio_(studio),
      size_(size),
      frame_(core::aim_frame(kAim, studio.main_camera().at)),
      gain_(studio::exposure_gain(studio.exposure, studio.main_camera())),
      samples_(size.pixels()),
      ambient_(size) {
  see();
}

void AnalyticLayers::see() {
  planes_.depth = core::Plane(size_);
  planes_.normal_x = planes_.normal_y = planes_.normal_z = core::Plane(size_);
  planes_.object = core::Grid<std::uint16_t>(size_);
  planes_.subject = core::Grid<std::uint8_t>(size_);
  const core::Vec3 eye = studio_.main_camera().at;
  const double half = std::tan(studio_.main_camera().vertical_fov / 2);
  for (int y = 0; y < size_.height; ++y)
    for (int x = 0; x < size_.width; ++x) {
      const std::size_t i = static_cast<std::size_t>(y * size_.width + x);
      const core::Vec3 ray = core::unit(
          {half * (2 * (x + 0.5) / size_.width - 1), 1, half * (1 - 2 * (y + 0.5) / size_.height)});
      const core::Vec3 from = eye - kAim;
      const double b = core::dot(from, ray), c = core::dot(from, from) - kRadius * kRadius;
      Sample& sample = samples_[i];
      if (b * b > c) {
        const double t = -b - std::sqrt(b * b - c);
        sample = {eye + t * ray, core::unit(from + t * ray), -ray, 0.6, 0.12, true};
      } else {
        sample = {eye + ((kWall - eye.y) / ray.y) * ray, {0, -1, 0}, -ray, 0.35, 0, false};
      }
      planes_.depth.values[i] = static_cast<float>(sample.at.y - eye.y);
      planes_.normal_x.values[i] = static_cast<float>(sample.normal.x);
      planes_.normal_y.values[i] = static_cast<float>(sample.normal.y);
      planes_.normal_z.values[i] = static_cast<float>(sample.normal.z);
      planes_.object.values[i] = sample.subject ? 1 : 2;
      planes_.subject.values[i] = sample.subject;
    }
}

core::Vec3 AnalyticLayers::position(std::size_t fixture, const core::FixtureState& state) const {
  if (const auto* fixed = std::get_if<studio::FixedMount>(&studio_.fixtures[fixture].mount))
    return fixed->at;
  return core::position(frame_, {state.get(core::Dof::azimuth), state.get(core::Dof::elevation),
                                 state.get(core::Dof::distance, 1)});
}

std::pair<double, double> AnalyticLayers::shade(const Sample& sample, core::Vec3 lamp) const {
  const core::Vec3 way = lamp - sample.at;
  const double squared = core::dot(way, way);
  const core::Vec3 l = core::unit(way);
  const double facing = core::dot(sample.normal, l);
  if (facing <= 0) return {0, 0};
  const double half = core::dot(sample.normal, core::unit(l + sample.to_eye));
  return {sample.albedo * facing / squared,
          sample.specular * std::pow(std::max(0.0, half), kShininess) / squared};
}

void AnalyticLayers::colour(std::size_t fixture, const core::FixtureState& state, design::Accuracy,
                            core::Layer& out) const {
  ++made_;
  out.diffuse = core::Picture(size_);
  out.specular = core::Picture(size_);
  const core::Vec3 lamp = position(fixture, state);
  const double scale = gain_ * studio_.fixtures[fixture].output.value;
  const core::Rgb light =
      studio::light_colour(studio_.fixtures[fixture], state, studio_.exposure.white_balance);
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    const auto [diffuse, specular] = shade(samples_[i], lamp);
    const int x = static_cast<int>(i) % size_.width, y = static_cast<int>(i) / size_.width;
    out.diffuse.set(x, y, (scale * diffuse) * light);
    out.specular.set(x, y, (scale * specular) * light);
  }
}

void AnalyticLayers::luminance(std::size_t fixture, const core::FixtureState& state,
                               design::Accuracy, core::Plane& out) const {
  ++made_;
  const core::Vec3 lamp = position(fixture, state);
  const double scale = gain_ * studio_.fixtures[fixture].output.value *
                       core::luminance(studio::light_colour(studio_.fixtures[fixture], state,
                                                            studio_.exposure.white_balance));
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    const auto [diffuse, specular] = shade(samples_[i], lamp);
    out.values[i] = static_cast<float>(scale * (diffuse + specular));
  }
}

void AnalyticLayers::visibility(std::size_t, const core::FixtureState&, design::Accuracy,
                                core::Plane& out) const {
  std::fill(out.values.begin(), out.values.end(), 1.0f);
}

std::string AnalyticLayers::infeasible(const studio::Rig& rig, std::size_t fixture) const {
  const core::Vec3 here = position(fixture, rig.states[fixture]);
  if (core::distance(here, kAim) < 0.6) return "nearer than 0.6 m to the sitter";
  for (std::size_t i = 0; i < rig.states.size(); ++i)
    if (i != fixture && core::distance(here, position(i, rig.states[i])) < 0.4)
      return "overlaps " + studio_.fixtures[i].name;
  return "";
}

const design::Layers& AnalyticSource::at(core::Size size) const {
  const std::lock_guard lock(mutex_);
  auto& layers = layers_[{size.width, size.height}];
  if (!layers) layers = std::make_unique<AnalyticLayers>(studio_, size);
  return *layers;
}

}  // namespace chiaro::support
