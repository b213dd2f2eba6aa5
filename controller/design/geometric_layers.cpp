// SPDX-License-Identifier: Apache-2.0
#include "controller/design/geometric_layers.h"

#include <algorithm>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "controller/core/picture_file.h"
#include "controller/render/bounce.h"
#include "controller/render/lighting.h"
#include "controller/render/samples.h"
#include "controller/render/visibility_cache.h"

namespace chiaro::design {
namespace {

/// What every size shares. Immutable after construction.
struct Twin {
  studio::Studio studio;
  studio::Camera camera;  ///< whose view it is
  GeometricOptions options;
  std::shared_ptr<const twin::Geometry> geometry;
  std::shared_ptr<const render::Tracer> tracer;
  double gain = 1;
  bool bounced = false;
  /// Null when only the lamps' own light counts.
  std::shared_ptr<const render::BounceField> bounces;
  std::shared_ptr<const render::BounceCache> bounce_cache;
  core::Picture measured_ambient;  ///< empty unless the studio has one
};

/// Small views are for a search's first look: a grid twice as wide there costs a sixth of the rays.
render::GridSpacing spacing_for(core::Size size) {
  return size.height <= 64 ? render::GridSpacing{core::radians(15), 2.0} : render::GridSpacing{};
}

/// Traced once, asked often: a look's last stages want the same lamp's layer in luminance and in
/// several colours.
class Remembered : public render::Visible {
 public:
  Remembered(const render::View& view, const twin::Light& light)
      : values_(view.samples->tiles() * render::kTile) {
    const render::Traced traced(view, light, render::kExact);
    tbb::parallel_for(std::size_t{0}, view.samples->tiles(), [&](std::size_t tile) {
      traced.tile(tile, values_.data() + tile * render::kTile);
    });
  }
  void tile(std::size_t tile, float* out) const override {
    std::copy_n(values_.data() + tile * render::kTile, render::kTile, out);
  }

 private:
  std::vector<float> values_;
};

class GeometricLayers : public Layers {
 public:
  GeometricLayers(const Twin& twin, core::Size size)
      : twin_(twin),
        view_(render::see(twin.tracer, twin.camera, size)),
        planes_(core::planes(view_.buffer)),
        cache_(view_, twin.studio, twin.options.visibility_cache_bytes, spacing_for(size)),
        ambient_(make_ambient()) {
    if (twin.bounces) bounce_map_.emplace(*twin.bounces, view_);
  }

  core::Size size() const override { return view_.buffer.size; }
  const core::GeometryPlanes* geometry() const override { return &planes_; }
  const core::Picture& ambient() const override { return ambient_; }

  void luminance(std::size_t fixture, const core::FixtureState& state, Accuracy accuracy,
                 core::Plane& out) const override {
    with_visible(fixture, state, accuracy, [&](const twin::Light& light, const auto& visible) {
      render::luminance(view_, light, twin_.gain, &visible, out, shading(accuracy));
      add_bounced(fixture, state, light, accuracy, out);
    });
  }

  void luminance_and_visibility(std::size_t fixture, const core::FixtureState& state,
                                Accuracy accuracy, core::Plane& out,
                                core::Plane& seen) const override {
    with_visible(fixture, state, accuracy, [&](const twin::Light& light, const auto& visible) {
      render::luminance(view_, light, twin_.gain, &visible, out, shading(accuracy), &seen);
      add_bounced(fixture, state, light, accuracy, out);
    });
  }

  void colour(std::size_t fixture, const core::FixtureState& state, Accuracy accuracy,
              core::Layer& out) const override {
    with_visible(fixture, state, accuracy, [&](const twin::Light& light, const auto& visible) {
      render::colour(view_, light, twin_.gain, &visible, out, shading(accuracy));
      if (bounce_map_)
        bounce_map_->add_colour(bounced(fixture, state, light, accuracy), light.colour, twin_.gain,
                                out.diffuse);
    });
  }

  void visibility(std::size_t fixture, const core::FixtureState& state, Accuracy accuracy,
                  core::Plane& out) const override {
    with_visible(fixture, state, accuracy, [&](const twin::Light&, const auto& visible) {
      render::visibility(view_, visible, out);
    });
  }

  std::string infeasible(const studio::Rig& rig, std::size_t fixture) const override {
    return twin::infeasible(twin_.studio, *twin_.geometry, rig, fixture);
  }
  std::unique_ptr<Layers> with_skin(core::Rgb diffuse) const override;

  const Twin& twin() const { return twin_; }
  const render::View& view() const { return view_; }

  render::Shading shading(Accuracy accuracy) const {
    return accuracy == Accuracy::cached && !twin_.options.reference ? render::Shading::quick
                                                                    : render::Shading::exact;
  }

  twin::Light light(std::size_t fixture, const core::FixtureState& state) const {
    return twin::light(twin_.studio.fixtures[fixture], state, twin_.geometry->aim,
                       twin_.studio.exposure.white_balance);
  }

  render::Bounced bounced(std::size_t fixture, const core::FixtureState& state,
                          const twin::Light& light, Accuracy accuracy) const {
    return accuracy == Accuracy::exact ? twin_.bounces->from(light)
                                       : twin_.bounce_cache->at(fixture, state);
  }

  void add_bounced(std::size_t fixture, const core::FixtureState& state, const twin::Light& light,
                   Accuracy accuracy, core::Plane& out) const {
    if (bounce_map_)
      bounce_map_->add_luminance(bounced(fixture, state, light, accuracy), light.colour, twin_.gain,
                                 out);
  }

  template <class F>
  void with_visible(std::size_t fixture, const core::FixtureState& state, Accuracy accuracy,
                    const F& f) const {
    const twin::Light lit = light(fixture, state);
    if (accuracy == Accuracy::exact && !twin_.options.reference) {
      f(lit, static_cast<const render::Visible&>(*remembered(fixture, state, lit)));
      return;
    }
    if (twin_.options.reference) {
      // Isolated: while this thread waits for its rows it must not take up another trial, which
      // may hold what the caller is in the middle of.
      tbb::this_task_arena::isolate([&] {
        f(lit, static_cast<const render::Visible&>(render::Traced(view_, lit, render::kExact)));
      });
      return;
    }
    const auto visible = cache_.at(fixture, state);
    f(lit, *visible);
  }

 private:
  /// The few lamps last traced exactly; a lamp's colour and level do not change what sees it.
  std::shared_ptr<const Remembered> remembered(std::size_t fixture, const core::FixtureState& state,
                                               const twin::Light& lit) const {
    core::FixtureState place = state;
    for (const core::DofInfo& each : core::dofs())
      if (!core::is_placement(each.dof)) place.clear(each.dof);
    const std::pair key{fixture, place};
    const auto known = [&]() -> std::shared_ptr<const Remembered> {
      for (auto entry = recent_.begin(); entry != recent_.end(); ++entry) {
        if (entry->first != key) continue;
        std::rotate(recent_.begin(), entry, entry + 1);  // used last, forgotten last
        return recent_.front().second;
      }
      return nullptr;
    };
    {
      const std::lock_guard lock(recent_mutex_);
      if (auto found = known()) return found;
    }
    // Isolated: while this thread waits for its rows it must not take up another trial, which may
    // hold what the caller is in the middle of.
    std::shared_ptr<const Remembered> traced;
    tbb::this_task_arena::isolate([&] { traced = std::make_shared<const Remembered>(view_, lit); });
    const std::lock_guard lock(recent_mutex_);
    if (auto found = known()) return found;
    recent_.emplace_front(key, traced);
    if (recent_.size() > kRemembered) recent_.pop_back();
    return traced;
  }

  core::Picture make_ambient() const { return ambient_of(view_); }

 public:
  /// Uncontrolled practicals burn as the file says, whatever is designed.
  core::Picture ambient_of(const render::View& view) const {
    const studio::Studio& studio = twin_.studio;
    twin::Scene scene = twin::lit_by(studio, twin_.geometry, studio::placed_rig(studio));
    for (std::size_t i = 0; i < studio.fixtures.size(); ++i)
      if (studio.fixtures[i].controlled) scene.levels[i] = 0;
    if (twin_.measured_ambient.red.empty()) return render::picture(view, scene);
    // A measured frame holds the practicals already.
    return core::resized(twin_.measured_ambient, view.buffer.size);
  }

 private:
  const Twin& twin_;
  render::View view_;
  core::GeometryPlanes planes_;
  render::VisibilityCache cache_;
  core::Picture ambient_;
  std::optional<render::BounceMap> bounce_map_;
  static constexpr std::size_t kRemembered = 16;
  mutable std::mutex recent_mutex_;
  mutable std::deque<
      std::pair<std::pair<std::size_t, core::FixtureState>, std::shared_ptr<const Remembered>>>
      recent_;  ///< newest first
};

/// Shadows are the same whatever the skin: they are asked of the view it was taken from.
class WithSkin : public Layers {
 public:
  WithSkin(const GeometricLayers& bare, core::Rgb diffuse) : bare_(bare), view_(bare.view()) {
    core::GBuffer& buffer = view_.buffer;
    for (std::size_t i = 0; i < buffer.samples(); ++i) {
      if (!buffer.objects[buffer.object[i] - 1u].subject) continue;
      buffer.diffuse_r[i] = static_cast<float>(diffuse.r);
      buffer.diffuse_g[i] = static_cast<float>(diffuse.g);
      buffer.diffuse_b[i] = static_cast<float>(diffuse.b);
    }
    view_.samples = std::make_shared<const render::Samples>(buffer);
    ambient_ = bare.ambient_of(view_);
    if (bare.twin().bounces) bounce_map_.emplace(*bare.twin().bounces, view_);
  }

  core::Size size() const override { return bare_.size(); }
  const core::GeometryPlanes* geometry() const override { return bare_.geometry(); }
  const core::Picture& ambient() const override { return ambient_; }
  void luminance(std::size_t fixture, const core::FixtureState& state, Accuracy accuracy,
                 core::Plane& out) const override {
    bare_.with_visible(fixture, state, accuracy, [&](const twin::Light& light, const auto& seen) {
      render::luminance(view_, light, bare_.twin().gain, &seen, out, bare_.shading(accuracy));
      if (bounce_map_)
        bounce_map_->add_luminance(bare_.bounced(fixture, state, light, accuracy), light.colour,
                                   bare_.twin().gain, out);
    });
  }
  void colour(std::size_t fixture, const core::FixtureState& state, Accuracy accuracy,
              core::Layer& out) const override {
    bare_.with_visible(fixture, state, accuracy, [&](const twin::Light& light, const auto& seen) {
      render::colour(view_, light, bare_.twin().gain, &seen, out, bare_.shading(accuracy));
      if (bounce_map_)
        bounce_map_->add_colour(bare_.bounced(fixture, state, light, accuracy), light.colour,
                                bare_.twin().gain, out.diffuse);
    });
  }
  void visibility(std::size_t fixture, const core::FixtureState& state, Accuracy accuracy,
                  core::Plane& out) const override {
    bare_.visibility(fixture, state, accuracy, out);
  }
  std::string infeasible(const studio::Rig& rig, std::size_t fixture) const override {
    return bare_.infeasible(rig, fixture);
  }

 private:
  const GeometricLayers& bare_;
  render::View view_;
  core::Picture ambient_;
  std::optional<render::BounceMap> bounce_map_;
};

std::unique_ptr<Layers> GeometricLayers::with_skin(core::Rgb diffuse) const {
  return std::make_unique<WithSkin>(*this, diffuse);
}

class GeometricSource : public LayersSource {
 public:
  explicit GeometricSource(Twin twin)
      : twin_(std::move(twin)), arena_(std::max(1, twin_.options.threads)) {
    if (!twin_.bounced) return;
    arena_.execute(
        [&] { twin_.bounces = std::make_shared<render::BounceField>(twin_.tracer, twin_.camera); });
    // Refers to the studio of this very object.
    twin_.bounce_cache =
        std::make_shared<render::BounceCache>(*twin_.bounces, twin_.studio, twin_.geometry->aim);
  }

  const Layers& at(core::Size size) const override {
    const std::lock_guard lock(mutex_);
    auto& entry = sizes_[{size.width, size.height}];
    // The arena is isolated: a thread that waits here for rows must not pick up a planner's task
    // that asks for this lock again.
    if (!entry) arena_.execute([&] { entry = std::make_unique<GeometricLayers>(twin_, size); });
    return *entry;
  }

  const Twin& twin() const { return twin_; }

 private:
  Twin twin_;
  mutable tbb::task_arena arena_;
  mutable std::mutex mutex_;
  mutable std::map<std::pair<int, int>, std::unique_ptr<GeometricLayers>> sizes_;
};

core::Result<core::Picture> read_linear(const std::filesystem::path& file) {
  if (file.extension() == ".exr") return core::read_exr(file);
  auto picture = core::read_picture(file);
  if (!picture) return picture.problems();
  return core::linear(*picture);
}

}  // namespace

namespace {

core::Result<std::unique_ptr<LayersSource>> made(const studio::Studio& studio,
                                                 const GeometricOptions& options, bool bounced,
                                                 std::size_t camera = 0) {
  if (studio.cameras.empty())
    return core::Problem{{studio.file.string(), 0, 0}, "the studio has no camera", "add one: main"};
  Twin twin;
  twin.studio = studio;
  twin.camera = studio.cameras[camera];
  twin.options = options;
  twin.bounced = bounced;
  auto geometry = twin::build_geometry(studio, options.mesh_cache);
  if (!geometry) return geometry.problems();
  twin.geometry = *geometry;
  if (studio.ambient && !studio.ambient->measured.empty()) {
    auto frame = read_linear(studio.ambient->measured);
    if (!frame) return frame.problems();
    twin.measured_ambient = *std::move(frame);
  }
  tbb::task_arena arena(std::max(1, options.threads));
  arena.execute([&] { twin.tracer = std::make_shared<const render::Tracer>(twin.geometry); });
  twin.gain = studio::exposure_gain(studio.exposure, twin.camera);
  return std::unique_ptr<LayersSource>(std::make_unique<GeometricSource>(std::move(twin)));
}

}  // namespace

core::Result<std::unique_ptr<LayersSource>> geometric_layers(const studio::Studio& studio,
                                                             const GeometricOptions& options) {
  return made(studio, options, false);
}
core::Result<std::unique_ptr<LayersSource>> bounced_layers(const studio::Studio& studio,
                                                           const GeometricOptions& options) {
  return made(studio, options, true);
}

core::Result<std::unique_ptr<LayersSource>> layers_of_camera(const studio::Studio& studio,
                                                             const std::string& camera,
                                                             const GeometricOptions& options) {
  for (std::size_t i = 0; i < studio.cameras.size(); ++i)
    if (studio.cameras[i].name == camera) return made(studio, options, true, i);
  return core::Problem{{studio.file.string(), 0, 0},
                       "the studio has no camera \"" + camera + "\"",
                       "name one of the studio file's cameras"};
}

std::shared_ptr<const render::Tracer> tracer_of(const LayersSource& source) {
  const auto* ours = dynamic_cast<const GeometricSource*>(&source);
  return ours != nullptr ? ours->twin().tracer : nullptr;
}

}  // namespace chiaro::design
