// SPDX-License-Identifier: Apache-2.0
// `chiaro new`: asks, and writes a valid studio file. Nothing is written unless everything has been
// answered and the file loads.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>

#include "controller/daemon/command.h"
#include "controller/daemon/interview/answers.h"
#include "controller/daemon/interview/dialogue.h"
#include "controller/daemon/interview/learning.h"
#include "controller/daemon/json_text.h"
#include "controller/daemon/problems.h"
#include "controller/studio/load.h"
#include "drivers/registry.h"

namespace chiaro::daemon {
namespace {

struct Options {
  std::string out = "studio.yaml";
  bool force = false;
};

core::Problem cannot_write(const std::filesystem::path& file) {
  return {{file.string(), 0, 0},
          "this file cannot be written",
          "is the folder there and writable, and the disk not full?",
          false};
}

/// Beside the file and then into its place: a studio is never half written.
core::Result<core::Done> write(const std::filesystem::path& file, const std::string& text) {
  std::filesystem::path draft = file;
  draft += ".new";
  std::ofstream out(draft, std::ios::binary | std::ios::trunc);
  out << text;
  out.close();
  std::error_code code;
  if (out) std::filesystem::rename(draft, file, code);
  if (!out || code) {
    std::filesystem::remove(draft, code);
    return cannot_write(file);
  }
  return core::Done{};
}

/// sACN for three seconds, then goodbye: receivers fall back by themselves.
class SacnWire final : public interview::Wire {
 public:
  explicit SacnWire(ports::World& world)
      : world_(world), around_{world.network, world.devices, world.clock} {}
  core::Result<core::Done> show(const std::string& interface, std::uint16_t universe,
                                const std::map<int, std::uint8_t>& slots) override {
    if (interface.empty())
      return core::Problem{{},
                           "no network interface was named: nothing can be raised",
                           "say what you know of the lamp, or begin again with an interface"};
    drivers::OutputSettings settings;
    settings.universe = universe;
    settings.interface = interface;
    settings.source_name = "Chiaro: learning a lamp";
    auto port = drivers::make_output("sacn", settings, around_);
    if (!port) return port.problems();
    if (auto opened = (*port)->open(); !opened) return opened;
    ports::DmxFrame frame;
    frame.universe = universe;
    for (const auto& [slot, level] : slots)
      if (slot >= 1 && slot <= static_cast<int>(ports::kSlots))
        frame.levels[static_cast<std::size_t>(slot - 1)] = level;
    for (int sent = 0; sent < kFrames && !world_.stop; ++sent) {
      (*port)->send(frame, world_.clock.now());
      world_.clock.sleep_until(world_.clock.now() + kPause);
    }
    frame.levels.fill(0);
    (*port)->send(frame, world_.clock.now());
    (*port)->release(world_.clock.now());
    return core::Done{};
  }

 private:
  static constexpr int kFrames = 60;
  static constexpr ports::Duration kPause = std::chrono::milliseconds(50);
  ports::World& world_;
  drivers::Surroundings around_;
};

/// Profiles that were learned, beside the studio file that names them.
core::Result<core::Done> write_profiles(const interview::Answers& answers,
                                        const std::filesystem::path& base) {
  for (const interview::LearntLamp& lamp : answers.learnt) {
    const auto yaml = interview::profile_yaml(lamp);
    if (!yaml) return yaml.problems();
    const auto file = base / "fixtures" / (lamp.profile + ".yaml");
    std::error_code code;
    std::filesystem::create_directories(file.parent_path(), code);
    if (auto written = write(file, *yaml); !written) return written;
  }
  return core::Done{};
}

std::string summary(const interview::Answers& answers, const std::string& file, bool json) {
  if (json)
    return json_text(
        nlohmann::json{{"ok", true}, {"file", file}, {"fixtures", answers.lamps.size()}});
  return "Wrote " + file + ". `chiaro check " + file + "` prints its patch sheet.";
}

ports::Exit create(const Options& options, ports::World& world, bool json) {
  std::error_code code;
  if (!options.force && std::filesystem::exists(options.out, code))
    return refuse({{{options.out, 0, 0},
                    "this file is there already",
                    "name another with --out, or overwrite it with --force",
                    false}},
                  world, json);
  const auto base = std::filesystem::absolute(options.out, code).parent_path();
  if (!std::filesystem::is_directory(base, code))
    return refuse({{{options.out, 0, 0},
                    "its folder is not there",
                    "make it, or name another with --out",
                    false}},
                  world, json);
  const studio::Folders folders{world.config_folder};
  interview::Dialogue dialogue(world.in, world.err);
  SacnWire wire(world);
  const auto answers = interview::interview(dialogue, base, folders, wire);
  if (!answers)
    return refuse({{{},
                    "the answers ended before the last question: nothing was written",
                    "answer every question, or give an empty line for each default",
                    false}},
                  world, json);
  if (const auto written = write_profiles(*answers, base); !written)
    return refuse(written.problems(), world, json);
  const std::string yaml = interview::studio_yaml(*answers);
  if (const auto loaded = studio::parse_studio(yaml, base, folders); !loaded) {
    for (const interview::LearntLamp& lamp : answers->learnt)
      std::filesystem::remove(base / "fixtures" / (lamp.profile + ".yaml"), code);
    return refuse(loaded.problems(), world, json);
  }
  if (const auto written = write(options.out, yaml); !written)
    return refuse(written.problems(), world, json);
  world.out << summary(*answers, options.out, json) << "\n";
  return ports::Exit::done;
}

}  // namespace

void declare_new(CLI::App& app, ports::World& world, Verdict& verdict) {
  auto* verb = app.add_subcommand("new", "asks, and writes a valid studio file");
  auto options = std::make_shared<Options>();
  verb->add_option("--out", options->out, "the file to write")->capture_default_str();
  verb->add_flag("--force", options->force, "overwrite a file that is there");
  verb->callback(
      [options, &world, &verdict] { verdict.exit = create(*options, world, verdict.json); });
}

}  // namespace chiaro::daemon
