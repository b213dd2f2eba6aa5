// SPDX-License-Identifier: Apache-2.0
// `chiaro fixtures`: finds lamps by any word, shows what a profile says, and makes profiles of
// other libraries' files. What is imported stands in `fixtures` beside the studio file, ready for
// it.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>

#include "controller/daemon/command.h"
#include "controller/daemon/json_text.h"
#include "controller/daemon/problems.h"
#include "controller/importers/import_fixture.h"
#include "controller/importers/xml.h"
#include "controller/studio/load.h"

namespace chiaro::daemon {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using studio::Channel;
using studio::ChannelUse;
using studio::Profile;

struct Options {
  std::string word, name, file;
  std::string folder = "fixtures";
  std::string library = "/usr/share/qlcplus/fixtures";
  bool force = false;
};

studio::Folders folders_of(const Options& options, const ports::World& world) {
  return {world.config_folder, options.folder};
}

bool matches(const std::string& words, const std::string& wanted) {
  return importers::lower(words).find(importers::lower(wanted)) != std::string::npos;
}

std::string modes_in_words(const Profile& profile) {
  std::string words;
  for (const studio::Mode& mode : profile.modes) words += (words.empty() ? "" : ", ") + mode.name;
  return words;
}

/// Definitions of an installed library whose file name has the word: read when they are imported.
std::vector<fs::path> importable(const Options& options) {
  std::vector<fs::path> found;
  std::error_code code;
  for (fs::recursive_directory_iterator entry(options.library, code), end; !code && entry != end;
       entry.increment(code)) {
    std::string words = entry->path().stem().string();
    std::replace(words.begin(), words.end(), '-', ' ');
    const std::string wanted = options.word;
    if (entry->path().extension() == ".qxf" &&
        (matches(words, wanted) || matches(entry->path().stem().string(), wanted)))
      found.push_back(entry->path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

ports::Exit search(const Options& options, ports::World& world, bool json) {
  const studio::Folders folders = folders_of(options, world);
  Json found{{"ok", true}, {"profiles", Json::array()}, {"importable", Json::array()}};
  std::string text;
  for (const std::string& name : studio::profile_names(folders)) {
    const auto profile = studio::load_profile(name, folders);
    if (!profile || !matches(name + " " + profile->maker + " " + profile->model, options.word))
      continue;
    found["profiles"].push_back({{"name", name},
                                 {"maker", profile->maker},
                                 {"model", profile->model},
                                 {"modes", profile->modes.size()}});
    text += fmt::format("{:<32} {} {}; modes {}\n", name, profile->maker, profile->model,
                        modes_in_words(*profile));
  }
  const auto files = importable(options);
  for (const fs::path& file : files) found["importable"].push_back(file.string());
  if (!files.empty()) text += "To be imported with `chiaro fixtures import FILE`:\n";
  for (const fs::path& file : files) text += "  " + file.string() + "\n";
  if (text.empty())
    text = "No lamp here is called \"" + options.word +
           "\". Import its .gdtf, .qxf or .json file, or start from a profile in generic/.\n";
  world.out << (json ? json_text(found) + "\n" : text);
  return ports::Exit::done;
}

std::string use_in_words(const Channel& channel) {
  if (channel.dof) {
    const std::string name(core::info(*channel.dof).name);
    return (channel.use == ChannelUse::trims     ? "adds to "
            : channel.use == ChannelUse::repeats ? "repeats "
                                                 : "") +
           name;
  }
  const auto raw =
      static_cast<long>(std::lround(channel.constant * (std::exp2(8 * channel.bytes) - 1)));
  if (channel.use == ChannelUse::open) return fmt::format("held open at {}", raw);
  if (channel.use == ChannelUse::pwm)
    return fmt::format("held at {} for {:.0f} Hz", raw, channel.pwm_hz);
  return fmt::format("held at {}", raw);
}

std::string slots_in_words(const Channel& channel) {
  std::string words = std::to_string(channel.slot(0) + 1);
  for (int byte = 1; byte < channel.bytes; ++byte)
    words += "+" + std::to_string(channel.slot(byte) + 1);
  return words;
}

std::string to_text(const Profile& profile) {
  std::string text = fmt::format("{}: {} {}\n", profile.name, profile.maker, profile.model);
  text += fmt::format("  {:.0f} cd on axis at full", profile.output.value);
  if (profile.optic.kind == studio::Optic::Kind::spot)
    text += fmt::format(", beam {:.0f}°, field {:.0f}°", core::degrees(profile.optic.beam),
                        core::degrees(profile.optic.field));
  text += "\n";
  if (profile.emitter.has_white_mix())
    text += fmt::format("  white {:.0f} K to {:.0f} K\n", profile.emitter.cct_range.least,
                        profile.emitter.cct_range.most);
  if (profile.emitter.kind == studio::Emitter::Kind::dimmer)
    text += fmt::format("  white {:.0f} K\n", profile.emitter.cct.value);
  for (const studio::Primary& primary : profile.emitter.primaries)
    text += fmt::format("  {} at CIE {:.3f}, {:.3f}, {:.0f} % of the light\n",
                        core::info(primary.dof).name, primary.chromaticity.x,
                        primary.chromaticity.y, 100 * primary.share);
  if (profile.pan.width() > 0)
    text += fmt::format("  pan {:.0f}°, tilt {:.0f}° from end to end\n",
                        core::degrees(profile.pan.width()), core::degrees(profile.tilt.width()));
  for (const std::string& what : profile.assumed)
    text += "  assumed, as the maker's file does not say: " + what + "\n";
  for (const studio::Mode& mode : profile.modes) {
    text += fmt::format("  mode {}: {} slots\n", mode.name, mode.footprint);
    for (const Channel& channel : mode.channels)
      text += fmt::format("    {:>7}  {:<24} {}\n", slots_in_words(channel), channel.name,
                          use_in_words(channel));
  }
  return text;
}

Json to_json(const Profile& profile) {
  Json json{{"ok", true},
            {"name", profile.name},
            {"maker", profile.maker},
            {"model", profile.model},
            {"output_cd", profile.output.value},
            {"beam_deg", core::degrees(profile.optic.beam)},
            {"assumed", profile.assumed},
            {"modes", Json::array()}};
  for (const studio::Mode& mode : profile.modes) {
    Json channels = Json::array();
    for (const Channel& channel : mode.channels)
      channels.push_back({{"slots", slots_in_words(channel)},
                          {"name", channel.name},
                          {"does", use_in_words(channel)}});
    json["modes"].push_back(
        {{"name", mode.name}, {"slots", mode.footprint}, {"channels", channels}});
  }
  return json;
}

ports::Exit show(const Options& options, ports::World& world, bool json) {
  const auto profile = studio::load_profile(options.name, folders_of(options, world));
  if (!profile) return refuse(profile.problems(), world, json);
  world.out << (json ? json_text(to_json(*profile)) + "\n" : to_text(*profile));
  return ports::Exit::done;
}

core::Result<core::Done> write(const fs::path& file, const std::string& text, bool force) {
  std::error_code code;
  if (!force && fs::exists(file, code))
    return core::Problem{{file.string(), 0, 0},
                         "this profile is there already",
                         "overwrite it with --force, or keep it",
                         false};
  fs::create_directories(file.parent_path(), code);
  fs::path draft = file;
  draft += ".new";
  std::ofstream out(draft, std::ios::binary | std::ios::trunc);
  out << text;
  out.close();
  if (out) fs::rename(draft, file, code);
  if (!out || code) {
    fs::remove(draft, code);
    return core::Problem{{file.string(), 0, 0},
                         "this file cannot be written",
                         "is the folder writable, and the disk not full?",
                         false};
  }
  return core::Done{};
}

ports::Exit take_in(const Options& options, ports::World& world, bool json) {
  const auto imported = importers::import_fixture(fs::path(options.file));
  if (!imported) return refuse(imported.problems(), world, json);
  const Profile& profile = imported->profile;
  const fs::path file = fs::path(options.folder) / (profile.name + ".yaml");
  const std::string yaml =
      importers::profile_yaml(profile, fs::path(options.file).filename().string());
  if (const auto written = write(file, yaml, options.force); !written)
    return refuse(written.problems(), world, json);
  if (json) {
    Json result = to_json(profile);
    result["file"] = file.string();
    result["left_out"] = imported->left_out;
    world.out << json_text(result) << "\n";
    return ports::Exit::done;
  }
  for (const std::string& each : imported->left_out) world.err << "left out: " << each << "\n";
  for (const std::string& what : profile.assumed)
    world.err << "assumed, as the file does not say: " << what << "\n";
  world.out << "Wrote " << file.string() << ". In a studio file beside " << options.folder
            << "/: profile: " << profile.name << ", mode: " << modes_in_words(profile) << "\n";
  return ports::Exit::done;
}

}  // namespace

void declare_fixtures(CLI::App& app, ports::World& world, Verdict& verdict) {
  auto* verb = app.add_subcommand("fixtures", "finds, shows and imports fixture profiles");
  verb->require_subcommand(1);
  auto options = std::make_shared<Options>();
  verb->add_option("--folder", options->folder, "your own profiles, beside your studio file")
      ->capture_default_str();
  auto* find = verb->add_subcommand("search", "lamps whose maker or model has the word");
  find->add_option("WORD", options->word, "part of a maker's or a model's name")->required();
  find->add_option("--library", options->library, "QLC+ definitions to look through too")
      ->capture_default_str();
  find->callback(
      [options, &world, &verdict] { verdict.exit = search(*options, world, verdict.json); });
  auto* one = verb->add_subcommand("show", "what a profile says: light, colours, modes, channels");
  one->add_option("MAKER/MODEL", options->name, "a profile's name, as search prints it")
      ->required();
  one->callback(
      [options, &world, &verdict] { verdict.exit = show(*options, world, verdict.json); });
  auto* take = verb->add_subcommand("import", "makes a profile of a .gdtf, .qxf or .json file");
  take->add_option("FILE", options->file, "GDTF, QLC+ or Open Fixture Library")->required();
  take->add_flag("--force", options->force, "overwrite a profile that is there");
  take->callback(
      [options, &world, &verdict] { verdict.exit = take_in(*options, world, verdict.json); });
}

}  // namespace chiaro::daemon
