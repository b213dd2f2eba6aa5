// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/brain/planner.h"

#include "controller/core/picture_file.h"
#include "controller/design/geometric_layers.h"
#include "controller/twin/scene.h"

namespace chiaro::daemon {
namespace {

std::string png_of(const core::Picture& picture) {
  if (picture.red.empty()) return "";
  const auto bytes = core::encode_png(core::encoded(picture));
  return {bytes.begin(), bytes.end()};
}

core::Result<Designed> packed(const studio::Studio& studio, design::Look look) {
  std::string json = design::look_to_json(studio, look);
  std::string picture = png_of(look.picture), placed = png_of(look.placed_picture);
  if (placed.empty()) placed = picture;
  return Designed{std::move(look), std::move(json), std::move(picture), std::move(placed), "", {}};
}

/// The camera's aspect at no more than 480 rows: sharp on a tablet, drawn in a moment.
core::Size drawn_size(core::Size camera) {
  constexpr int kRows = 480;
  if (camera.height <= kRows) return camera;
  return {std::max(1, camera.width * kRows / camera.height), kRows};
}

/// A fault in one job must not take the daemon down with it.
template <class Work>
auto guarded(Work work) -> decltype(work()) {
  try {
    return work();
  } catch (const std::exception& fault) {
    return core::Problem{{},
                         std::string("the planner failed: ") + fault.what(),
                         "this is a fault of Chiaro: please report it with the studio file"};
  }
}

}  // namespace

void JobBoard::tell(const design::Progress& progress, double seconds) {
  const std::lock_guard lock(mutex_);
  seen_ = {progress, seconds};
}

JobBoard::Seen JobBoard::seen() const {
  const std::lock_guard lock(mutex_);
  return seen_;
}

void Planner::prepare(const studio::Studio& studio, const std::filesystem::path& mesh_cache,
                      std::function<void(core::Problems)> ready) {
  worker_.add([this, studio, mesh_cache, ready = std::move(ready)] {
    daemon::be_modest(modest_);
    design::GeometricOptions options;
    options.mesh_cache = mesh_cache;
    options.threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    auto made = guarded([&]() -> core::Result<std::unique_ptr<design::LayersSource>> {
      auto layers = design::bounced_layers(studio, options);
      if (!layers) return layers;
      const design::Options sizes;
      (*layers)->at(sizes.search_size);
      (*layers)->at(sizes.polish_size);
      (*layers)->at(sizes.full_size);
      return layers;
    });
    no_layers_ = made.problems();
    layers_ = made ? std::move(*made) : nullptr;
    {
      const std::lock_guard lock(tracer_mutex_);
      tracer_ = layers_ ? design::tracer_of(*layers_) : nullptr;
    }
    post_([ready, problems = no_layers_] { ready(problems); });
  });
}

void Planner::draw(DrawTask task, std::function<void(Drawn)> done) {
  const auto kept = std::make_shared<DrawTask>(std::move(task));
  painter_.add([this, kept, number = ++drawings_, done = std::move(done)] {
    daemon::be_modest(modest_);
    const auto drawn =
        guarded([&]() -> core::Result<std::optional<Drawn>> { return draw_now(*kept, number); });
    if (drawn && *drawn) post_([done, result = **drawn] { done(result); });
  });
}

Planner::Easel::Easel(std::shared_ptr<const render::Tracer> with, const studio::Camera& camera)
    : tracer(std::move(with)),
      view(render::see(tracer, camera, drawn_size(camera.size))),
      field(tracer, camera),
      map(field, view) {}

/// With the light that walls and floor give back, as the planner reckoned with it.
core::Picture Planner::Easel::picture(const studio::Studio& studio, const studio::Rig& rig) const {
  const std::shared_ptr<const twin::Geometry> geometry(tracer, &tracer->geometry());
  const twin::Scene scene = twin::lit_by(studio, geometry, rig);
  core::Picture picture = render::picture(view, scene);
  for (std::size_t i = 0; i < scene.lights.size(); ++i)
    if (scene.levels[i] > 0)
      map.add_colour(field.from(scene.lights[i]), scene.lights[i].colour,
                     scene.exposure_gain * scene.levels[i], picture);
  return picture;
}

std::optional<Drawn> Planner::draw_now(const DrawTask& task, std::uint64_t number) {
  std::shared_ptr<const render::Tracer> tracer;
  {
    const std::lock_guard lock(tracer_mutex_);
    tracer = tracer_;
  }
  if (!tracer || number != drawings_) return std::nullopt;
  const studio::Camera& camera = task.studio.main_camera();
  if (!easel_ || easel_->tracer != tracer) easel_ = std::make_unique<const Easel>(tracer, camera);
  const auto png = [&](const studio::Rig& rig) {
    return png_of(easel_->picture(task.studio, rig));
  };
  Drawn drawn;
  drawn.placed_png = png(task.placed);
  if (number != drawings_) return std::nullopt;  // somebody wants another by now
  drawn.wanted_png = task.wanted == task.placed ? drawn.placed_png : png(task.wanted);
  return drawn;
}

/// A search for places takes a second or two; levels alone a tenth of that, and what they cost is
/// not lost: the look's own answer for the lamps as they stand asks for the same layers.
void Planner::tell_first_light(const DesignTask& task, const design::Goal& goal) const {
  design::Options options = task.options;
  options.move_stands = false;
  options.progress = nullptr;
  const auto quick = design::design(task.studio, *layers_, goal, options);
  if (!quick || task.board->stop) return;
  post_([tell = task.first_light, placed = quick->placed] { tell(placed); });
}

core::Result<design::Look> Planner::found(DesignTask& task, std::string& reference) const {
  if (task.from) return std::move(*task.from);
  auto read = task.goal();
  if (!read) return read.problems();
  reference = std::move(read->reference);
  if (task.first_light) tell_first_light(task, read->goal);
  return design::design(task.studio, *layers_, read->goal, task.options);
}

core::Result<Designed> Planner::solve(DesignTask& task) const {
  if (task.board->stop) return core::Problem{{}, "cancelled", ""};
  if (!layers_) return no_layers_;
  const ports::TimePoint start = clock_.now();
  const auto seconds = [this, start] {
    return std::chrono::duration<double>(clock_.now() - start).count();
  };
  task.options.stop = &task.board->stop;
  task.options.seconds = seconds;
  task.options.threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  task.options.progress = [&](const design::Progress& progress) {
    task.board->tell(progress, seconds());
  };
  task.board->started = true;
  std::string reference;
  auto look = found(task, reference);
  if (!look) return look.problems();
  const auto with_reference = [&](core::Result<Designed> designed) {
    if (designed) designed->reference = std::move(reference);
    return designed;
  };
  if (task.nudge == design::Nudge{}) return with_reference(packed(task.studio, std::move(*look)));
  design::NudgeOptions options;
  options.locked = task.options.locked;
  auto bent = design::nudged(task.studio, *layers_, *look, task.nudge, options);
  if (!bent) return bent.problems();
  bent->look.seconds = seconds();
  auto designed = packed(task.studio, std::move(bent->look));
  if (designed) designed->by_hand = std::move(bent->by_hand);
  return with_reference(std::move(designed));
}

void Planner::add(DesignTask task, std::function<void(core::Result<Designed>)> done) {
  const auto kept = std::make_shared<DesignTask>(std::move(task));
  worker_.add([this, kept, done = std::move(done)] {
    daemon::be_modest(modest_);
    const auto result = std::make_shared<core::Result<Designed>>(
        guarded([&]() -> core::Result<Designed> { return solve(*kept); }));
    post_([done, result] { done(std::move(*result)); });
  });
}

}  // namespace chiaro::daemon
