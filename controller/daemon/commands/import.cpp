// SPDX-License-Identifier: Apache-2.0
// `chiaro import show.qxw|show.mvr`: lamps, patch and static scenes of another program's show
// become a studio file, profiles and looks; what was not taken is listed, and why.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>

#include "controller/daemon/command.h"
#include "controller/daemon/json_text.h"
#include "controller/daemon/problems.h"
#include "controller/design/design.h"
#include "controller/importers/import_fixture.h"
#include "controller/importers/show.h"
#include "controller/importers/xml.h"
#include "controller/patch/plan.h"
#include "controller/studio/load.h"

namespace chiaro::daemon {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string file;
  std::string out = "studio.yaml";
  std::string library = "/usr/share/qlcplus/fixtures";
  bool force = false;
};

core::Problem problem(const fs::path& file, std::string what, std::string remedy) {
  return {{file.string(), 0, 0}, std::move(what), std::move(remedy), false};
}

core::Result<importers::Show> read(const Options& options) {
  const auto bytes = importers::bytes_of(options.file);
  if (!bytes) return bytes.problems();
  const std::string ending = importers::lower(fs::path(options.file).extension().string());
  if (ending == ".qxw")
    return importers::read_qxw(*bytes, options.file, importers::definitions_in(options.library));
  if (ending == ".mvr") return importers::read_mvr(*bytes, options.file);
  return problem(options.file, "shows are not read from files like this one",
                 "give a .qxw (QLC+) or .mvr file; for one lamp: chiaro fixtures import FILE");
}

core::Result<core::Done> write(const fs::path& file, const std::string& text) {
  std::error_code code;
  if (!file.parent_path().empty()) fs::create_directories(file.parent_path(), code);
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  out << text;
  out.close();
  if (out) return core::Done{};
  return problem(file, "this file cannot be written",
                 "is the folder writable, and the disk not full?");
}

/// What the lamps are told by a scene's raw levels: the table that encodes, backwards.
design::Look look_of(const studio::Studio& studio, const patch::Plan& plan,
                     const importers::ShowScene& scene) {
  auto frames = plan.blank_frames();
  for (const auto& level : scene.levels)
    for (auto& frame : frames)
      if (frame.universe == level.universe)
        frame.levels[static_cast<std::size_t>(level.slot - 1)] =
            static_cast<std::uint8_t>(level.value);
  std::vector<core::FixtureState> heard(studio.fixtures.size());
  plan.decode(frames, heard);
  design::Look look;
  look.name = scene.name;
  look.goal = "imported scene";
  look.wanted = studio::placed_rig(studio);
  for (std::size_t i = 0; i < heard.size(); ++i) look.wanted.states[i].overlay(heard[i]);
  look.placed = look.wanted;
  return look;
}

/// A scene's name as a file's.
fs::path look_file(const fs::path& studio, const std::string& name,
                   std::map<std::string, int>& taken) {
  std::string base = importers::slug(name);
  if (const int again = ++taken[base]; again > 1) base += "-" + std::to_string(again);
  return studio.parent_path() / "looks" / (base + ".json");
}

core::Result<core::Done> write_profiles(const importers::Show& show, const Options& options) {
  const fs::path folder = fs::path(options.out).parent_path() / "fixtures";
  for (const studio::Profile& profile : show.profiles) {
    const fs::path file = folder / (profile.name + ".yaml");
    std::error_code code;
    if (!options.force && fs::exists(file, code)) continue;  // the user may have corrected it
    const auto written =
        write(file, importers::profile_yaml(profile, fs::path(options.file).filename().string()));
    if (!written) return written.problems();
  }
  return core::Done{};
}

ports::Exit take_in(const Options& options, ports::World& world, bool json) {
  std::error_code code;
  if (!options.force && fs::exists(options.out, code))
    return refuse({problem(options.out, "this file is there already",
                           "name another with --out, or overwrite it with --force")},
                  world, json);
  const auto show = read(options);
  if (!show) return refuse(show.problems(), world, json);
  for (const std::string& each : show->left_out) world.err << "not taken: " << each << "\n";
  if (show->lamps.empty())
    return refuse(
        {problem(options.file, "no lamp of this show could be taken", "see the list above")}, world,
        json);
  if (const auto written = write_profiles(*show, options); !written)
    return refuse(written.problems(), world, json);
  const std::string yaml =
      importers::studio_yaml(*show, fs::path(options.file).filename().string());
  if (const auto written = write(options.out, yaml); !written)
    return refuse(written.problems(), world, json);
  const auto loaded = studio::load_studio(options.out, {world.config_folder});
  if (!loaded) return refuse(loaded.problems(), world, json);
  const patch::Plan plan = patch::Plan::of(loaded->studio);
  std::map<std::string, int> taken;
  for (const importers::ShowScene& scene : show->scenes) {
    const auto file = look_file(options.out, scene.name, taken);
    const auto look = look_of(loaded->studio, plan, scene);
    if (const auto written = write(file, design::look_to_json(loaded->studio, look)); !written)
      return refuse(written.problems(), world, json);
  }
  if (json)
    world.out << json_text(nlohmann::json{{"ok", true},
                                          {"studio", options.out},
                                          {"fixtures", show->lamps.size()},
                                          {"profiles", show->profiles.size()},
                                          {"looks", show->scenes.size()},
                                          {"left_out", show->left_out}})
              << "\n";
  else
    world.out << "Wrote " << options.out << ": " << show->lamps.size() << " lamps, "
              << show->profiles.size() << " profiles, " << show->scenes.size()
              << " looks. Correct roles and places in it, then: chiaro check " << options.out
              << "\n";
  return ports::Exit::done;
}

}  // namespace

void declare_import(CLI::App& app, ports::World& world, Verdict& verdict) {
  auto* verb =
      app.add_subcommand("import", "a QLC+ workspace or an MVR scene becomes a studio file");
  auto options = std::make_shared<Options>();
  verb->add_option("SHOW", options->file, "a .qxw or .mvr file")->required();
  verb->add_option("--out", options->out, "the studio file to write")->capture_default_str();
  verb->add_option("--library", options->library, "where QLC+ keeps its fixture definitions")
      ->capture_default_str();
  verb->add_flag("--force", options->force, "overwrite files that are there");
  verb->callback(
      [options, &world, &verdict] { verdict.exit = take_in(*options, world, verdict.json); });
}

}  // namespace chiaro::daemon
