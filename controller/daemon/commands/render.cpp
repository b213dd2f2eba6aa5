// SPDX-License-Identifier: Apache-2.0
// `chiaro render`: what the main camera would see, once, with exact shadows.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "controller/core/picture_file.h"
#include "controller/daemon/command.h"
#include "controller/daemon/json_text.h"
#include "controller/design/design.h"
#include "controller/render/view.h"
#include "controller/studio/load.h"

namespace chiaro::daemon {
namespace {

struct Asked {
  std::string studio, look, out, size, objects, depth;
};

core::Problem refusal(const std::string& file, std::string what, std::string remedy) {
  return {{file, 0, 0}, std::move(what), std::move(remedy)};
}

/// "640x480"; empty takes the camera's own.
core::Result<core::Size> wanted_size(const std::string& text, core::Size camera) {
  if (text.empty()) return camera;
  int width = 0, height = 0;
  char x = 0, rest = 0;
  std::istringstream in(text);
  if (!(in >> width >> x >> height) || x != 'x' || (in >> rest) || width < 1 || height < 1 ||
      core::Size{width, height}.pixels() > core::kMostPixels)
    return refusal("--size", "\"" + text + "\" is not a picture's size", "write it as 640x480");
  return core::Size{width, height};
}

core::Result<studio::Rig> wanted_rig(const studio::Studio& studio, const std::string& look) {
  if (look == "placed") return studio::placed_rig(studio);
  std::ifstream in(look, std::ios::binary);
  if (!in)
    return refusal(look, "there is no such look",
                   "give a look.json from chiaro design, or the word placed for the studio as it "
                   "stands");
  std::ostringstream text;
  text << in.rdbuf();
  auto read = design::look_from_json(studio, text.str(), look);
  if (!read) return read.problems();
  return read->wanted;
}

core::Problems wrong_endings(const Asked& asked) {
  core::Problems problems;
  const auto ends = [](const std::string& file, const char* with) {
    return std::filesystem::path(file).extension() == with;
  };
  if (!ends(asked.out, ".png") && !ends(asked.out, ".exr"))
    problems.push_back(refusal(asked.out, "the picture is written as .png or .exr",
                               "choose one of the two endings"));
  if (!asked.objects.empty() && !ends(asked.objects, ".png"))
    problems.push_back(refusal(asked.objects, "object numbers are written as .png", "end it so"));
  if (!asked.depth.empty() && !ends(asked.depth, ".exr"))
    problems.push_back(refusal(asked.depth, "depth is written as .exr", "end it so"));
  return problems;
}

core::Result<core::Done> write(const std::filesystem::path& file, const core::Picture& picture) {
  if (file.extension() == ".exr") return core::write_exr(file, picture);
  return core::write_png(file, core::encoded(picture));
}

core::Result<core::Done> write_all(const Asked& asked, const render::View& view,
                                   const core::Picture& picture) {
  if (auto done = write(asked.out, picture); !done) return done;
  const core::GeometryPlanes planes = core::planes(view.buffer);
  if (!asked.objects.empty())
    if (auto done = core::write_png(asked.objects, planes.object); !done) return done;
  if (!asked.depth.empty()) return core::write_exr(asked.depth, planes.depth);
  return core::Done{};
}

void say(const Asked& asked, const render::View& view, ports::World& world, bool json) {
  if (!json) {
    world.err << "Wrote " << asked.out;
    if (!asked.objects.empty()) {
      world.err << ", " << asked.objects << " (";
      for (std::size_t i = 0; i < view.buffer.objects.size(); ++i)
        world.err << (i ? ", " : "") << i + 1 << " " << view.buffer.objects[i].name;
      world.err << ", 0 nothing)";
    }
    if (!asked.depth.empty()) world.err << ", " << asked.depth << " (metres)";
    world.err << "\n";
    return;
  }
  nlohmann::json objects = nlohmann::json::array();
  for (std::size_t i = 0; i < view.buffer.objects.size(); ++i)
    objects.push_back({{"id", i + 1},
                       {"name", view.buffer.objects[i].name},
                       {"subject", view.buffer.objects[i].subject}});
  world.out << json_text(nlohmann::json{{"picture", asked.out},
                                        {"width", view.buffer.size.width},
                                        {"height", view.buffer.size.height},
                                        {"objects", objects}})
            << "\n";
}

core::Problems render_look(const Asked& asked, ports::World& world, bool json) {
  if (core::Problems wrong = wrong_endings(asked); !wrong.empty()) return wrong;
  auto loaded = studio::load_studio(asked.studio, {world.config_folder});
  if (!loaded) return loaded.problems();
  const studio::Studio& studio = loaded->studio;
  world.err << core::to_string(loaded->warnings);
  const auto size = wanted_size(asked.size, studio.main_camera().size);
  if (!size) return size.problems();
  const auto rig = wanted_rig(studio, asked.look);
  if (!rig) return rig.problems();
  const auto geometry = twin::build_geometry(studio, world.state_folder / "meshes");
  if (!geometry) return geometry.problems();
  world.err << core::to_string((*geometry)->warnings);
  const render::View view =
      render::see(std::make_shared<const render::Tracer>(*geometry), studio.main_camera(), *size);
  const twin::Scene scene = twin::lit_by(studio, *geometry, *rig);
  if (std::all_of(scene.levels.begin(), scene.levels.end(), [](double l) { return l <= 0; }))
    world.err << "Every lamp of this look is at 0: the picture shows the ambient light alone.\n";
  const core::Picture picture = render::picture(view, scene);
  if (auto done = write_all(asked, view, picture); !done) return done.problems();
  say(asked, view, world, json);
  return {};
}

}  // namespace

void declare_render(CLI::App& app, ports::World& world, Verdict& verdict) {
  auto asked = std::make_shared<Asked>();
  CLI::App* verb = app.add_subcommand("render", "draw what the main camera would see");
  verb->add_option("studio", asked->studio, "the studio file")->required();
  verb->add_option("look", asked->look, "look.json, or the word placed: the studio as it stands")
      ->required();
  verb->add_option("--out", asked->out, "the picture to write: .png, or .exr in linear light")
      ->required();
  verb->add_option("--size", asked->size, "such as 640x480; the camera's own when left out");
  verb->add_option("--objects", asked->objects,
                   "also write each pixel's object number (16-bit .png)");
  verb->add_option("--depth", asked->depth,
                   "also write the distance along the camera's axis (.exr)");
  verb->callback([asked, &world, &verdict] {
    const core::Problems problems = render_look(*asked, world, verdict.json);
    world.err << core::to_string(problems);
    if (core::any_error(problems)) verdict.exit = ports::Exit::input_has_problems;
  });
}

}  // namespace chiaro::daemon
