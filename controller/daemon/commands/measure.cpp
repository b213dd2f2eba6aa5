// SPDX-License-Identifier: Apache-2.0
// `chiaro measure PICTURE [--studio STUDIO [--look LOOK]]`: the components and the wavelet spectrum
// of any picture. The studio lends the geometry that edge and contrast need, the look the key's
// shadow.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>
#include <ostream>
#include <sstream>

#include "controller/core/picture_file.h"
#include "controller/daemon/command.h"
#include "controller/daemon/measurement.h"
#include "controller/daemon/problems.h"
#include "controller/design/design.h"
#include "controller/design/target.h"
#include "controller/studio/load.h"

namespace chiaro::daemon {
namespace {

struct Wish {
  std::string picture, studio, look, targets;
};

/// The size at which the camera's geometry is compared: its own, or its central square for a square
/// picture (a mood, a preview).
core::Result<core::Size> compared_size(const Wish& wish, core::Size picture, core::Size camera) {
  const double mine = double(picture.width) / picture.height,
               theirs = double(camera.width) / camera.height;
  if (std::abs(mine / theirs - 1) < 0.01) return camera;
  if (picture.width == picture.height) return core::Size{camera.height, camera.height};
  return core::Problem{{wish.picture},
                       "the picture is " + std::to_string(picture.width) + " x " +
                           std::to_string(picture.height) + ", but the main camera of " +
                           wish.studio + " takes " + std::to_string(camera.width) + " x " +
                           std::to_string(camera.height) + ": its geometry does not fit",
                       "crop the picture to the camera's shape or to its central square, or leave "
                       "--studio away"};
}

core::Result<studio::Rig> read_look(const Wish& wish, const studio::Studio& studio) {
  std::ifstream in(wish.look);
  std::stringstream text;
  text << in.rdbuf();
  if (!in) return core::Problem{{wish.look}, "the look cannot be read", "check its name"};
  auto look = design::look_from_json(studio, text.str(), wish.look);
  if (!look) return look.problems();
  return look->wanted;
}

/// What the key lamp lights, when a look says where it stands.
core::Result<core::Plane> key_light(const Wish& wish, const studio::Studio& studio,
                                    const design::Layers& layers) {
  core::Plane lit;
  if (wish.look.empty()) return lit;
  const auto rig = read_look(wish, studio);
  if (!rig) return rig.problems();
  for (std::size_t k = 0; k < studio.fixtures.size(); ++k)
    if (studio.fixtures[k].role == studio::Role::key && lit.empty())
      layers.visibility(k, rig->states[k], design::Accuracy::exact, lit);
  return lit;
}

core::Result<Measurement> measured_with_studio(const Wish& wish, core::Picture picture,
                                               ports::World& world) {
  const auto loaded = studio::load_studio(wish.studio, {world.config_folder});
  if (!loaded) return loaded.problems();
  const studio::Studio& studio = loaded->studio;
  const auto size = compared_size(wish, picture.size(), studio.main_camera().size);
  if (!size) return size.problems();
  const auto twin = design::geometric_layers(studio, {.mesh_cache = world.state_folder / "meshes"});
  if (!twin) return twin.problems();
  const design::Layers& layers = (*twin)->at(*size);
  const auto lit = key_light(wish, studio, layers);
  if (!lit) return lit.problems();
  if (picture.size() != *size) picture = core::resized(picture, *size);
  return measurement(picture, measure::pixel_map(*layers.geometry()),
                     lit->empty() ? nullptr : &*lit);
}

/// The central square as targets are measured on it [I-29]: a 3D exemplar's, where a studio lends
/// its geometry; else a 2D exemplar's, without edge and contrast.
core::Result<measure::Targets> targets_of(const Wish& wish, const core::Picture& picture,
                                          ports::World& world) {
  const core::Size size = picture.size();
  const int side = std::min(size.width, size.height);
  core::Picture square({side, side});
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      square.set(x, y, picture.at(x + (size.width - side) / 2, y + (size.height - side) / 2));
  const core::Plane light = core::luminance(core::resized(square, design::kMeasuredSize));
  measure::PixelMap map = measure::flat_pixel_map(design::kMeasuredSize);
  if (!wish.studio.empty()) {
    const auto loaded = studio::load_studio(wish.studio, {world.config_folder});
    if (!loaded) return loaded.problems();
    const auto twin =
        design::geometric_layers(loaded->studio, {.mesh_cache = world.state_folder / "meshes"});
    if (!twin) return twin.problems();
    map = measure::pixel_map(*(*twin)->at(design::kMeasuredSize).geometry());
  }
  return measure::targets_of(measure::components_of_luminance(light, map), !wish.studio.empty());
}

/// As design --targets reads it, for an editor.
core::Problems write_targets(const std::string& file, const measure::Targets& targets) {
  std::ofstream out(file, std::ios::trunc);
  out << "# Targets of an exemplar, to edit: leave out what should not count. Use them with\n"
         "# chiaro design STUDIO --exemplar PICTURE --goal perceptual --targets THIS_FILE\n"
         "targets:\n";
  const auto line = [&](const char* name, const std::optional<double>& value) {
    if (value) out << "  " << name << ": " << core::number(*value, 5) << "\n";
  };
  line("edge", targets.edge);
  line("mean", targets.mean);
  line("gradient", targets.gradient);
  line("variance", targets.variance);
  line("contrast", targets.contrast);
  if (targets.histogram) {
    out << "  histogram:\n    [";
    for (std::size_t k = 0; k < 256; ++k)
      out << (k == 0        ? ""
              : k % 16 == 0 ? ",\n     "
                            : ", ")
          << core::number((*targets.histogram)[k], 7);
    out << "]\n";
  }
  if (out.flush()) return {};
  return {{{file}, "the targets cannot be written", "is there such a folder?"}};
}

ports::Exit run(const Wish& wish, ports::World& world, bool json) {
  auto picture = core::read_linear(wish.picture);
  if (!picture) return refuse(picture.problems(), world, json);
  if (!wish.targets.empty()) {
    const auto targets = targets_of(wish, *picture, world);
    if (!targets) return refuse(targets.problems(), world, json);
    if (auto bad = write_targets(wish.targets, *targets); !bad.empty())
      return refuse(bad, world, json);
  }
  core::Result<Measurement> result =
      wish.studio.empty() ? measurement(*picture, measure::flat_pixel_map(picture->size()), nullptr)
                          : measured_with_studio(wish, std::move(*picture), world);
  if (!result) return refuse(result.problems(), world, json);
  if (json)
    world.out << to_json(wish.picture, wish.studio, *result) << "\n";
  else
    world.out << to_text(wish.picture, wish.studio, *result);
  return ports::Exit::done;
}

}  // namespace

void declare_measure(CLI::App& app, ports::World& world, Verdict& verdict) {
  auto* verb = app.add_subcommand("measure", "what a picture's lighting is like, in numbers");
  auto wish = std::make_shared<Wish>();
  verb->add_option("PICTURE", wish->picture, "PNG, JPEG, TIFF, BMP, WebP or EXR")->required();
  auto* studio = verb->add_option("--studio", wish->studio,
                                  "the studio whose main camera took the picture: its geometry "
                                  "adds edge and contrast");
  verb->add_option("--look", wish->look,
                   "the look.json that was on: the key's cast shadow then counts less")
      ->needs(studio);
  verb->add_option("--targets", wish->targets,
                   "also write the picture's targets (YAML) to edit and to use with design "
                   "--targets; with --studio those of a 3D exemplar");
  verb->callback([wish, &world, &verdict] { verdict.exit = run(*wish, world, verdict.json); });
}

}  // namespace chiaro::daemon
