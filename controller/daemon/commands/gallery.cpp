// SPDX-License-Identifier: Apache-2.0
// `chiaro gallery`: a contact sheet of what the studio's lamps can do.
#include "controller/design/gallery.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>
#include <thread>

#include "controller/core/picture_file.h"
#include "controller/daemon/command.h"
#include "controller/daemon/problems.h"
#include "controller/design/geometric_layers.h"
#include "controller/design/words.h"
#include "controller/studio/load.h"

namespace chiaro::daemon {
namespace {

/// As typed.
struct Asked {
  std::string studio, out = "gallery.png", looks_to;
  std::vector<std::string> lock;
  std::size_t looks = 9, samples = 600;
  std::uint64_t seed = 1;
  bool stay = false;
};

std::string in_words(const studio::Studio& studio, const design::GalleryLook& entry) {
  std::string words;
  for (std::size_t i = 0; i < studio.fixtures.size(); ++i) {
    const core::FixtureState& state = entry.look.wanted.states[i];
    const double level = state.get(core::Dof::intensity);
    if (level <= 0.0005) continue;
    words +=
        (words.empty() ? "" : "; ") + studio.fixtures[i].name + " " + design::level_in_words(level);
    if (state.has(core::Dof::azimuth) && state.has(core::Dof::distance))
      words += " from " +
               core::place_in_words({state.get(core::Dof::azimuth), state.get(core::Dof::elevation),
                                     state.get(core::Dof::distance)});
  }
  return words;
}

/// look-1.json … in the folder; their names, or why they cannot be written.
core::Result<std::vector<std::string>> write_looks(const Asked& asked, const studio::Studio& studio,
                                                   const design::Gallery& gallery) {
  std::vector<std::string> files;
  if (asked.looks_to.empty()) return files;
  std::error_code code;
  std::filesystem::create_directories(asked.looks_to, code);
  for (std::size_t i = 0; i < gallery.looks.size(); ++i) {
    files.push_back(
        (std::filesystem::path(asked.looks_to) / ("look-" + std::to_string(i + 1))).string() +
        ".json");
    std::ofstream file(files.back(), std::ios::trunc);
    file << design::look_to_json(studio, gallery.looks[i].look);
    if (!file.flush())
      return core::Problem{
          {files.back()}, "the look cannot be written", "may you write in that folder?"};
  }
  return files;
}

nlohmann::ordered_json json_of(const studio::Studio& studio, const design::Gallery& gallery,
                               const Asked& asked, const std::vector<std::string>& files) {
  nlohmann::ordered_json json;
  json["sheet"] = asked.out;
  json["tried"] = gallery.tried;
  json["usable"] = gallery.usable;
  json["seed"] = asked.seed;
  json["least_apart_l"] = gallery.least_apart;
  json["mean_apart_l"] = gallery.mean_apart;
  json["mean_apart_of_samples_l"] = gallery.mean_random;
  json["looks"] = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < gallery.looks.size(); ++i) {
    const design::GalleryLook& entry = gallery.looks[i];
    nlohmann::ordered_json each = {{"number", i + 1},
                                   {"apart_l", entry.apart},
                                   {"share", entry.share},
                                   {"in_words", in_words(studio, entry)}};
    if (!files.empty()) each["file"] = files[i];
    json["looks"].push_back(std::move(each));
  }
  return json;
}

void say(const studio::Studio& studio, const design::Gallery& gallery, const Asked& asked,
         std::ostream& out) {
  out << gallery.looks.size() << " looks out of " << gallery.usable << " usable ones ("
      << gallery.tried << " tried), at least " << core::number(gallery.least_apart, 1)
      << " L* apart; any two samples are " << core::number(gallery.mean_random, 1)
      << " apart on average, any two looks " << core::number(gallery.mean_apart, 1) << "\n";
  for (std::size_t i = 0; i < gallery.looks.size(); ++i)
    out << "  " << i + 1 << ": stands for " << core::number(100 * gallery.looks[i].share, 0)
        << " %; " << in_words(studio, gallery.looks[i]) << "\n";
  out << "Wrote " << asked.out << ", row by row from the upper left\n";
}

ports::Exit run_gallery(const Asked& asked, ports::World& world, bool json) {
  const auto loaded = studio::load_studio(asked.studio, studio::Folders{world.config_folder});
  if (!loaded) return refuse(loaded.problems(), world, json);
  world.err << core::to_string(loaded->warnings);
  design::GeometricOptions geometric;
  geometric.mesh_cache = world.state_folder / "meshes";
  geometric.threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  const auto twin = design::bounced_layers(loaded->studio, geometric);
  if (!twin) return refuse(twin.problems(), world, json);
  design::GalleryOptions options;
  options.looks = asked.looks;
  options.samples = asked.samples;
  options.seed = asked.seed;
  options.locked = asked.lock;
  options.move_stands = !asked.stay;
  options.threads = geometric.threads;
  options.stop = &world.stop;
  if (world.err_is_terminal)
    options.progress = [&](std::size_t tried) {
      if (tried % 10 == 0)
        world.err << "\r\x1b[K" << tried << " of " << asked.samples << " rigs" << std::flush;
    };
  const auto gallery = design::gallery(loaded->studio, **twin, options);
  if (world.err_is_terminal) world.err << "\r\x1b[K" << std::flush;
  if (!gallery) return refuse(gallery.problems(), world, json);
  const auto drawn = core::write_png(asked.out, core::encoded(design::contact_sheet(*gallery)));
  if (!drawn) return refuse(drawn.problems(), world, json);
  const auto files = write_looks(asked, loaded->studio, *gallery);
  if (!files) return refuse(files.problems(), world, json);
  if (json) world.out << json_of(loaded->studio, *gallery, asked, *files).dump(2) << "\n";
  say(loaded->studio, *gallery, asked, json ? world.err : world.out);
  return ports::Exit::done;
}

}  // namespace

void declare_gallery(CLI::App& app, ports::World& world, Verdict& verdict) {
  auto asked = std::make_shared<Asked>();
  CLI::App* verb = app.add_subcommand("gallery", "looks as different as possible, on one sheet");
  verb->add_option("STUDIO", asked->studio, "the studio file")->required();
  verb->add_option("--looks", asked->looks, "how many (default 9)")->check(CLI::Range(2, 36));
  verb->add_option("--samples", asked->samples, "rigs to choose from (default 600)")
      ->check(CLI::Range(10, 20000));
  verb->add_option("--seed", asked->seed, "same seed and samples, same gallery (default 1)");
  verb->add_option("--lock", asked->lock, "a fixture to leave as it is (may be repeated)")
      ->allow_extra_args(false);
  verb->add_flag("--stay", asked->stay, "levels only: no stand moves");
  verb->add_option("--out", asked->out, "the contact sheet (default gallery.png)");
  verb->add_option("--looks-to", asked->looks_to,
                   "a folder for the looks as files, for render and apply");
  verb->callback(
      [asked, &world, &verdict] { verdict.exit = run_gallery(*asked, world, verdict.json); });
}

}  // namespace chiaro::daemon
