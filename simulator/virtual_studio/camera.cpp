// SPDX-License-Identifier: Apache-2.0
#include "simulator/virtual_studio/camera.h"

#include "simulator/path_tracer/path_tracer.h"

namespace chiaro::simulator {
namespace {

constexpr core::Rgb kWhite{1, 1, 1};

/// Whether two lights differ in level and colour at most.
bool same_beam(const twin::Light& a, const twin::Light& b) {
  return a.kind == b.kind && a.attenuation == b.attenuation && a.position == b.position &&
         a.direction == b.direction && a.right == b.right && a.up == b.up &&
         a.candela == b.candela && a.cos_beam == b.cos_beam && a.cos_field == b.cos_field &&
         a.width == b.width && a.height == b.height && a.radius == b.radius;
}

void add(core::Plane& to, const core::Plane& from, double factor) {
  const auto k = static_cast<float>(factor);
  for (std::size_t i = 0; i < to.values.size(); ++i) to.values[i] += k * from.values[i];
}

void add(core::Picture& to, const core::Picture& from, const core::Rgb& factor) {
  add(to.red, from.red, factor.r);
  add(to.green, from.green, factor.g);
  add(to.blue, from.blue, factor.b);
}

TraceOptions tracing(const CameraOptions& options, std::uint64_t stream) {
  TraceOptions result;
  result.samples = options.samples;
  result.seed = options.seed + stream;
  result.threads = options.threads;
  result.stop = options.stop;
  return result;
}

}  // namespace

VirtualCamera::VirtualCamera(const studio::Studio& studio, const studio::Camera& camera,
                             std::shared_ptr<const render::Tracer> tracer,
                             const CameraOptions& options)
    : studio_(studio),
      camera_(camera),
      tracer_(std::move(tracer)),
      options_(options),
      gain_(studio::exposure_gain(studio.exposure, camera)),
      view_(render::see(tracer_, camera, camera.size)),
      ambient_(draw_ambient()),
      drawn_(studio.fixtures.size()) {
  if (options_.renderer != Renderer::bounced) return;
  bounces_ = std::make_unique<const render::BounceField>(tracer_, camera);
  bounce_map_ = std::make_unique<const render::BounceMap>(*bounces_, view_);
}

core::Picture VirtualCamera::draw_ambient() {
  // lit_by knows how the studio's ambient light becomes irradiance; the rig plays no part in it.
  const std::shared_ptr<const twin::Geometry> geometry(tracer_, &tracer_->geometry());
  auto scene = twin::lit_by(studio_, geometry, studio::placed_rig(studio_));
  if (options_.renderer != Renderer::path)
    return render::ambient_layer(view_, scene.ambient_irradiance, gain_);
  scene.lights.clear();
  scene.levels.clear();
  scene.exposure_gain = gain_;
  return trace_layers(*tracer_, scene, camera_, camera_.size, tracing(options_, 0)).ambient;
}

core::Picture VirtualCamera::draw(const twin::Light& white) {
  ++layers_drawn_;
  if (options_.renderer != Renderer::path) {
    auto layer = render::layer(view_, white, gain_);
    add(layer.diffuse, layer.specular, kWhite);
    if (bounces_) bounce_map_->add_colour(bounces_->from(white), kWhite, gain_, layer.diffuse);
    return std::move(layer.diffuse);
  }
  const std::shared_ptr<const twin::Geometry> geometry(tracer_, &tracer_->geometry());
  const twin::Scene scene{geometry, {white}, {1}, {0, 0, 0}, gain_};
  // Its own seed per lamp: equal noise in every layer would add up instead of averaging out.
  auto traced =
      trace_layers(*tracer_, scene, camera_, camera_.size, tracing(options_, 1 + white.fixture));
  return std::move(traced.lights.front());
}

core::Picture VirtualCamera::picture(const std::vector<LitLamp>& lamps) {
  core::Picture result = ambient_;
  for (std::size_t i = 0; i < lamps.size() && i < drawn_.size(); ++i) {
    if (lamps[i].level <= 0) continue;
    auto beam = lamps[i].light;
    beam.colour = kWhite;
    auto& drawn = drawn_[i];
    if (!drawn.valid || !same_beam(drawn.beam, beam)) drawn = {true, beam, draw(beam)};
    add(result, drawn.white, lamps[i].level * lamps[i].light.colour);
  }
  return result;
}

}  // namespace chiaro::simulator
