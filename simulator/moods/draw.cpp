// SPDX-License-Identifier: Apache-2.0
#include "simulator/moods/draw.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <ostream>

#include "controller/core/gbuffer.h"
#include "controller/core/picture_file.h"
#include "simulator/bust/bust_mesh.h"
#include "simulator/moods/mood_file.h"

namespace chiaro::simulator {
namespace {

namespace fs = std::filesystem;

/// Targets are measured as the design engine measures: see design::kMeasuredSize.
constexpr core::Size kMeasured{256, 256};

struct Wish {
  std::vector<std::string> only;
  fs::path out;
  bool bust = false;
  core::Size size = kDrawnSize;
  TraceOptions trace;
};

std::vector<std::string> recipes_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (fs::exists(entry.path() / "recipe.yaml")) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

core::Result<core::Done> write_text(const fs::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  if (!out)
    return core::Problem{{file.string()},
                         "this file cannot be written",
                         "check the folder's permissions and the disk"};
  return core::Done{};
}

core::Result<core::Done> write_mood(const fs::path& folder, const Recipe& recipe,
                                    const DrawnMood& mood) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (auto written = core::write_png(folder / "picture.png", mood.picture); !written)
    return written;
  return write_text(folder / "mood.yaml", mood_yaml(recipe, mood.measured));
}

/// One line per mood: its name, how far it is, what is left of the noise.
class Line {
 public:
  Line(ports::World& world, std::string name) : world_(world), name_(std::move(name)) {}
  void progress(double done) {
    if (!world_.err_is_terminal) return;
    world_.err << '\r' << name_ << ": " << static_cast<int>(100 * done) << " %  " << std::flush;
  }
  void finish(double noise) {
    if (world_.err_is_terminal) world_.err << '\r';
    world_.err << name_ << ": drawn, noise " << noise << " of full scale\n" << std::flush;
  }

 private:
  ports::World& world_;
  std::string name_;
};

core::Result<core::Done> draw_one(const std::string& name, const Wish& wish, ports::World& world) {
  const studio::Folders folders{world.config_folder};
  const auto recipe = load_recipe(folders.moods() / name / "recipe.yaml", folders);
  if (!recipe) return recipe.problems();
  const auto set = set_up(*recipe, folders, world.state_folder / "meshes");
  if (!set) return set.problems();
  Line line(world, name);
  TraceOptions options = wish.trace;
  options.stop = &world.stop;
  options.progress = [&line](double done) { line.progress(done); };
  const DrawnMood mood = drawn(*set, wish.size, options);
  if (world.stop) return core::Problem{{}, name + " was not finished", "start again"};
  line.finish(mood.noise);
  return write_mood(wish.out / name, *recipe, mood);
}

core::Result<core::Done> draw_bust(ports::World& world) {
  const TriangleMesh mesh = bust_mesh();
  world.err << "bust: " << mesh.triangles.size() << " triangles\n";
  return write_ply(studio::Folders{world.config_folder}.subjects() / "bust.ply", mesh);
}

core::Problem no_such_mood(const std::string& name, const std::vector<std::string>& all,
                           const fs::path& folder) {
  const std::string near = core::nearest_name(name, all);
  return {{},
          "there is no recipe for a mood called '" + name + "'",
          near.empty() ? "the recipes are in " + folder.string() : "did you mean '" + near + "'?"};
}

core::Problems draw_moods(Wish wish, ports::World& world) {
  const fs::path moods = studio::Folders{world.config_folder}.moods();
  const std::vector<std::string> all = recipes_in(moods);
  if (wish.out.empty()) wish.out = moods;
  if (wish.only.empty()) wish.only = all;
  core::Problems problems;
  for (const std::string& name : wish.only) {
    if (std::find(all.begin(), all.end(), name) == all.end()) {
      problems.push_back(no_such_mood(name, all, moods));
      continue;
    }
    const auto done = draw_one(name, wish, world);
    problems.insert(problems.end(), done.problems().begin(), done.problems().end());
    if (world.stop) break;
  }
  return problems;
}

void declare(CLI::App& app, Wish& wish, std::vector<int>& size) {
  app.add_option("--only", wish.only, "draw these moods alone")->type_name("NAME");
  app.add_option("--samples", wish.trace.samples, "light paths per pixel")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  app.add_option("--seed", wish.trace.seed, "same seed, same picture")->capture_default_str();
  app.add_option("--threads", wish.trace.threads, "0 = all that the machine has")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  app.add_option("--size", size, "width and height (480 360 when not given)")
      ->expected(2)
      ->check(CLI::Range(16, 8192));
  app.add_option("--out", wish.out, "folder for the moods; their own when not given");
  app.add_flag("--bust", wish.bust, "make config/subjects/bust.ply anew, and no picture");
}

/// Skin no further from the head's centre than this counts as the face, where it looks forward.
constexpr double kFaceRadius = 0.13, kForward = 0.4;

/// Mean illuminance of the front of the face against the camera's grey_card, in stops: what the
/// picture shows there, divided by what it is made of.
std::optional<double> exposure_of_face(const StudioSet& set, const core::GBuffer& view,
                                       const core::Picture& picture) {
  const core::AimFrame& aim = set.scene.geometry->aim;
  const double facing = set.studio.subjects.front().facing;
  const core::Vec3 front = core::unit(core::position(aim, {facing, 0, 1}) - aim.origin);
  double lux = 0;
  int count = 0;
  for (std::size_t i = 0; i < view.samples(); ++i) {
    const core::Vec3 at{view.position_x[i], view.position_y[i], view.position_z[i]};
    const core::Vec3 normal{view.normal_x[i], view.normal_y[i], view.normal_z[i]};
    if (!view.objects[view.object[i] - 1u].subject ||
        core::distance(at, aim.origin) > kFaceRadius || core::dot(normal, front) < kForward)
      continue;
    const double albedo =
        core::luminance({view.diffuse_r[i], view.diffuse_g[i], view.diffuse_b[i]});
    const auto x = static_cast<int>(view.pixel[i] % static_cast<std::uint32_t>(view.size.width));
    const auto y = static_cast<int>(view.pixel[i] / static_cast<std::uint32_t>(view.size.width));
    lux += core::luminance(picture.at(x, y)) / (albedo * set.scene.exposure_gain);
    ++count;
  }
  if (count == 0 || lux <= 0) return std::nullopt;
  return std::log2(lux / count / set.studio.exposure.grey_card.value);
}

}  // namespace

DrawnMood drawn(const StudioSet& set, core::Size size, const TraceOptions& options) {
  const auto tracer = std::make_shared<const render::Tracer>(set.scene.geometry);
  const studio::Camera& camera = set.studio.main_camera();
  const Traced picture = trace(*tracer, set.scene, camera, size, options);
  TraceOptions clean = options;
  clean.antialias = false;
  clean.progress = nullptr;
  const Traced measured = trace(*tracer, set.scene, camera, kMeasured, clean);
  const render::View view = render::see(tracer, camera, kMeasured);
  const measure::PixelMap map = measure::pixel_map(core::planes(view.buffer));
  const core::Plane lit = render::visibility(view, set.scene.lights[set.key]);
  const measure::Components components =
      measure::components(measure::working_scalar(core::luminance(measured.picture)), map, &lit);
  return {core::encoded(picture.picture),
          {measure::targets_of(components, true),
           exposure_of_face(set, view.buffer, measured.picture), set.studio.exposure.white_balance},
          picture.noise};
}

ports::Exit run_draw(const std::vector<std::string>& arguments, ports::World& world) {
  CLI::App app{"Draws the shipped moods from their recipes (config/moods/*/recipe.yaml)",
               "chiaro-draw"};
  Wish wish;
  wish.trace.samples = 96;
  wish.trace.most_bounced = 2;  // few bright specks: a reference is looked at
  std::vector<int> size;
  declare(app, wish, size);
  try {
    std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());
    app.parse(reversed);
  } catch (const CLI::Success&) {
    world.out << app.help();
    return ports::Exit::done;
  } catch (const CLI::ParseError& error) {
    world.err << error.what() << "\nchiaro-draw --help says more.\n";
    return ports::Exit::usage;
  }
  if (size.size() == 2) wish.size = {size[0], size[1]};
  core::Problems problems;
  if (wish.bust)
    problems = draw_bust(world).problems();
  else
    problems = draw_moods(wish, world);
  if (problems.empty()) return ports::Exit::done;
  world.err << core::to_string(problems) << '\n';
  return ports::Exit::input_has_problems;
}

}  // namespace chiaro::simulator
