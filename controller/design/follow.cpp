// SPDX-License-Identifier: Apache-2.0
#include "controller/design/follow.h"

#include <algorithm>
#include <cmath>

#include "controller/render/lighting.h"
#include "controller/render/samples.h"
#include "controller/twin/aim.h"

namespace chiaro::design {
namespace {

// Fewer pixels of the subject than this tell nothing of its light.
constexpr std::size_t kFewest = 32;
// A lamp that gives less of the subject's light than this share is not there for the subject.
constexpr double kWeak = 0.02;
// A motor's trial step, a share of its way, and how much nearer the picture must then come.
constexpr double kStep = 0.02, kWorthIt = 0.98;

Variables standing(const studio::Studio& studio, const studio::Rig& look,
                   const std::vector<std::string>& locked) {
  Options options;
  options.start = look;
  options.locked = locked;
  options.move_stands = false;
  return variables_of(studio, options);
}

std::optional<core::Range> range_of(const studio::Fixture& fixture, core::Dof dof) {
  for (const auto& [each, range] : fixture.ranges())
    if (each == dof && range.width() > 0) return range;
  return std::nullopt;
}

template <class T>
void keep_only(std::vector<T>& list, const std::vector<std::size_t>& chosen) {
  for (std::size_t k = 0; k < chosen.size(); ++k) list[k] = list[chosen[k]];
  list.resize(chosen.size());
}

template <class F>
void each_list(core::GBuffer& b, const F& f) {
  f(b.pixel), f(b.object);
  for (auto* list :
       {&b.position_x, &b.position_y, &b.position_z, &b.normal_x, &b.normal_y, &b.normal_z,
        &b.face_x, &b.face_y, &b.face_z, &b.viewer_x, &b.viewer_y, &b.viewer_z, &b.diffuse_r,
        &b.diffuse_g, &b.diffuse_b, &b.specular, &b.shininess, &b.depth})
    f(*list);
}

/// The view without its background.
void keep_subject(render::View& view) {
  core::GBuffer& b = view.buffer;
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < b.samples(); ++i)
    if (b.objects[b.object[i] - 1u].subject) chosen.push_back(i);
  each_list(b, [&](auto& list) { keep_only(list, chosen); });
  view.samples = std::make_shared<const render::Samples>(b);
}

/// The same parts of the surface where they were before the subject moved, seen from the camera.
render::View turned_back(const render::View& view, const render::Motion& moved,
                         std::shared_ptr<const render::Tracer> tracer) {
  render::View out = view;
  core::GBuffer& b = out.buffer;
  const auto at = [](const auto& x, const auto& y, const auto& z, std::size_t i) {
    return core::Vec3{x[i], y[i], z[i]};
  };
  const auto put = [](auto& x, auto& y, auto& z, std::size_t i, core::Vec3 v) {
    x[i] = static_cast<float>(v.x), y[i] = static_cast<float>(v.y), z[i] = static_cast<float>(v.z);
  };
  for (std::size_t i = 0; i < b.samples(); ++i) {
    const core::Vec3 here =
        moved.turned_back(at(b.position_x, b.position_y, b.position_z, i) - moved.by);
    put(b.position_x, b.position_y, b.position_z, i, here);
    put(b.normal_x, b.normal_y, b.normal_z, i,
        moved.turned_back(at(b.normal_x, b.normal_y, b.normal_z, i)));
    put(b.face_x, b.face_y, b.face_z, i, moved.turned_back(at(b.face_x, b.face_y, b.face_z, i)));
    put(b.viewer_x, b.viewer_y, b.viewer_z, i, unit(view.eye - here));
  }
  out.tracer = std::move(tracer);
  out.samples = std::make_shared<const render::Samples>(b);
  return out;
}

double sum_of(const core::Plane& plane) {
  double sum = 0;
  for (const float value : plane.values) sum += static_cast<double>(value);
  return sum;
}

void add(core::Plane& to, double level, const core::Plane& plane) {
  for (std::size_t i = 0; i < to.values.size(); ++i)
    to.values[i] += static_cast<float>(level) * plane.values[i];
}

}  // namespace

Follower::Follower(const studio::Studio& studio, std::shared_ptr<const twin::Geometry> geometry,
                   const Goal& goal, const studio::Rig& look,
                   const std::vector<std::string>& locked, const FollowOptions& options)
    : Follower(studio, std::move(geometry), &goal, look, locked, options) {}

Follower::Follower(const studio::Studio& studio, std::shared_ptr<const twin::Geometry> geometry,
                   const studio::Rig& look, const std::vector<std::string>& locked,
                   const FollowOptions& options)
    : Follower(studio, std::move(geometry), nullptr, look, locked, options) {}

Follower::Follower(const studio::Studio& studio, std::shared_ptr<const twin::Geometry> geometry,
                   const Goal* goal, const studio::Rig& look,
                   const std::vector<std::string>& locked, const FollowOptions& options)
    : studio_(studio),
      options_(options),
      tracer_(geometry),
      at_rest_(tracer_.at({})),
      geometry_(std::move(geometry)),
      look_(look),
      lamps_(standing(studio, look, locked)),
      bounds_(lamps_.limits),
      rig_(look),
      gain_(studio::exposure_gain(studio.exposure, studio.main_camera())),
      planes_(lamps_.lit.size(), core::Plane(options.size)),
      offset_(options.size),
      spare_(options.size) {
  for (const std::size_t fixture : lamps_.lit)
    aims_.push_back(look.states[fixture].get(core::Dof::intensity));
  find_motors();
  choose_goal(goal);
}

Follower::~Follower() = default;

void Follower::find_motors() {
  using core::Dof;
  for (std::size_t k = 0; k < lamps_.lit.size(); ++k) {
    const std::size_t i = lamps_.lit[k];
    const studio::Fixture& fixture = studio_.fixtures[i];
    for (const Dof dof : {Dof::arc, Dof::track})
      if (const auto range = range_of(fixture, dof); range && rig_.states[i].has(dof))
        motors_.push_back({k, dof, *range, rig_.states[i].get(dof)});
    const auto pan = range_of(fixture, Dof::pan), tilt = range_of(fixture, Dof::tilt);
    if (!std::holds_alternative<studio::PanTiltMount>(fixture.mount) || !pan || !tilt) continue;
    const twin::Pose pose = twin::pose(fixture, rig_.states[i], geometry_->aim);
    const double along = dot(geometry_->aim.origin - pose.position, pose.direction);
    const core::Vec3 mark = pose.position + along * pose.direction;
    if (along > 0 && distance(mark, geometry_->aim.origin) < geometry_->radius)
      heads_.push_back({i, *pan, *tilt, mark});
  }
}

void Follower::choose_goal(const Goal* goal) {
  map_ = measure::flat_pixel_map(options_.size);
  keeps_ = goal == nullptr;
  if (keeps_) {
    target_.kind = Target::Kind::wavelet;
    target_.size = options_.size;
    target_.clipped = core::Grid<std::uint8_t>(options_.size);
    find_weak_lamps();
    return;
  }
  target_ = target_of(*goal, options_.size);
  if (!target_.by_geometry) solver_ = level_solver(target_, map_);  // else the map is the view's
}

void Follower::find_weak_lamps() {
  render::View view = render::see(at_rest_, studio_.main_camera(), options_.size);
  keep_subject(view);
  fetch(view);
  double all = sum_of(offset_);
  std::vector<double> given;
  for (std::size_t k = 0; k < lamps_.lit.size(); ++k) {
    given.push_back(aims_[k] * sum_of(planes_[k]));
    all += given.back();
  }
  for (std::size_t k = 0; k < given.size(); ++k)
    if (given[k] <= kWeak * all) bounds_[k] = {aims_[k], aims_[k]};
}

/// What the lamp adds at full level, its shadows traced once per pixel.
void Follower::light_alone(const render::View& view, std::size_t fixture,
                           const core::FixtureState& state, core::Plane& out) const {
  core::FixtureState full = state;
  full.set(core::Dof::intensity, 1);
  const twin::Light light =
      twin::light(studio_.fixtures[fixture], full, geometry_->aim, studio_.exposure.white_balance);
  const render::Traced traced(view, light, render::kHard);
  render::luminance(view, light, gain_, &traced, out, render::Shading::quick);
}

void Follower::fetch(const render::View& view) {
  const twin::Scene scene = twin::lit_by(studio_, geometry_, rig_);
  offset_ = core::luminance(render::ambient_layer(view, scene.ambient_irradiance, gain_));
  for (const std::size_t fixture : lamps_.held) {
    const double level = rig_.states[fixture].get(core::Dof::intensity);
    if (level <= 0) continue;
    light_alone(view, fixture, rig_.states[fixture], spare_);
    add(offset_, level, spare_);
  }
  for (std::size_t k = 0; k < lamps_.lit.size(); ++k)
    light_alone(view, lamps_.lit[k], rig_.states[lamps_.lit[k]], planes_[k]);
}

/// The light that each part of the surface had before it moved.
void Follower::want_the_look(const render::View& view, const render::Motion& moved) {
  const render::View before = turned_back(view, moved, at_rest_);
  const twin::Scene scene = twin::lit_by(studio_, geometry_, look_);
  target_.luminance =
      core::luminance(render::ambient_layer(before, scene.ambient_irradiance, gain_));
  for (std::size_t i = 0; i < studio_.fixtures.size(); ++i) {
    const double level = look_.states[i].get(core::Dof::intensity);
    if (level <= 0) continue;
    light_alone(before, i, look_.states[i], spare_);
    add(target_.luminance, level, spare_);
  }
  target_.values = measure::working_scalar(target_.luminance);
  solver_ = level_solver(target_, map_);
}

/// One motor a frame: a step either way, where the picture then comes nearer.
void Follower::step_motor(const render::View& view, Columns columns, double cost) {
  if (motors_.empty()) return;
  Motor& motor = motors_[turn_of_motor_++ % motors_.size()];
  const std::size_t fixture = lamps_.lit[motor.lamp];
  const double now = rig_.states[fixture].get(motor.dof);
  double least = kWorthIt * cost;
  motor.wanted = now;
  columns.planes[motor.lamp] = &spare_;
  for (const double way : {-kStep, kStep}) {
    core::FixtureState state = rig_.states[fixture];
    state.set(motor.dof, motor.range.clamp(now + way * motor.range.width()));
    if (state.get(motor.dof) == now) continue;
    light_alone(view, fixture, state, spare_);
    const double tried = solver_->solve(columns, Effort::quick).cost;
    if (!(tried < least)) continue;
    least = tried;
    motor.wanted = state.get(motor.dof);
  }
}

double Follower::nearer(double now, double wanted, double seconds, double most_per_s) const {
  const double share = 1 - std::exp(-seconds / options_.settle_s);
  const double most = most_per_s * seconds;
  return now + std::clamp(share * (wanted - now), -most, most);
}

void Follower::turn_heads(const render::Motion& moved, double seconds, Frame& frame) {
  using core::Dof;
  for (const Head& head : heads_) {
    core::FixtureState& state = rig_.states[head.fixture];
    const twin::PanTilt now{state.get(Dof::pan), state.get(Dof::tilt)};
    const auto& mount = std::get<studio::PanTiltMount>(studio_.fixtures[head.fixture].mount);
    const auto wanted = twin::aimed_at(mount, head.pan, head.tilt, moved.point(head.mark), now);
    if (!wanted) continue;
    state.set(Dof::pan, nearer(now.pan, wanted->pan, seconds, options_.turn_per_s));
    state.set(Dof::tilt, nearer(now.tilt, wanted->tilt, seconds, options_.turn_per_s));
    frame.turn = std::max({frame.turn, std::abs(state.get(Dof::pan) - now.pan),
                           std::abs(state.get(Dof::tilt) - now.tilt)});
  }
}

void Follower::travel(double seconds, Frame& frame) {
  for (const Motor& motor : motors_) {
    core::FixtureState& state = rig_.states[lamps_.lit[motor.lamp]];
    const double now = state.get(motor.dof), width = motor.range.width();
    state.set(motor.dof,
              motor.range.clamp(nearer(now, motor.wanted, seconds, options_.travel_per_s * width)));
    frame.travel = std::max(frame.travel, std::abs(state.get(motor.dof) - now) / width);
  }
}

void Follower::near_levels(double seconds, Frame& frame) {
  for (std::size_t k = 0; k < aims_.size(); ++k) {
    core::FixtureState& state = rig_.states[lamps_.lit[k]];
    const double now = state.get(core::Dof::intensity);
    state.set(core::Dof::intensity,
              lamps_.limits[k].clamp(nearer(now, aims_[k], seconds, options_.most_per_s)));
    frame.change = std::max(frame.change, std::abs(state.get(core::Dof::intensity) - now));
  }
}

Follower::Frame Follower::follow(const render::Motion& moved, double seconds) {
  seconds = std::max(0.0, seconds);
  Frame frame;
  turn_heads(moved, seconds, frame);
  render::View view = render::see(tracer_.at(moved), studio_.main_camera(), options_.size);
  if (keeps_) keep_subject(view);
  frame.in_view = !keeps_ || view.buffer.samples() >= kFewest;
  if (frame.in_view) {
    fetch(view);
    if (keeps_) want_the_look(view, moved);
    if (target_.by_geometry) {
      map_ = measure::pixel_map(core::planes(view.buffer));
      solver_ = level_solver(target_, map_);
    }
    Columns columns;
    for (const core::Plane& plane : planes_) columns.planes.push_back(&plane);
    columns.offset = &offset_;
    columns.bounds = bounds_;
    const Levels wanted = solver_->solve(columns, Effort::quick);
    frame.cost = wanted.cost;
    for (std::size_t k = 0; k < aims_.size(); ++k)
      if (std::abs(wanted.values[k] - aims_[k]) > options_.dead_band) aims_[k] = wanted.values[k];
    step_motor(view, std::move(columns), wanted.cost);
  }
  travel(seconds, frame);
  near_levels(seconds, frame);
  frame.rig = rig_;
  return frame;
}

}  // namespace chiaro::design
