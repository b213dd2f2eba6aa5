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
#include "controller/daemon/problems.h"
#include "controller/studio/load.h"

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

std::string summary(const interview::Answers& answers, const std::string& file, bool json) {
  if (json)
    return nlohmann::json{{"ok", true}, {"file", file}, {"fixtures", answers.lamps.size()}}.dump(2);
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
  const auto answers = interview::interview(dialogue, base, folders);
  if (!answers)
    return refuse({{{},
                    "the answers ended before the last question: nothing was written",
                    "answer every question, or give an empty line for each default",
                    false}},
                  world, json);
  const std::string yaml = interview::studio_yaml(*answers);
  if (const auto loaded = studio::parse_studio(yaml, base, folders); !loaded)
    return refuse(loaded.problems(), world, json);
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
