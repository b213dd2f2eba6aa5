// SPDX-License-Identifier: Apache-2.0
// `chiaro export STUDIO show.mvr`: lamps, places and patch for programs that plan and draw shows.
#include <CLI/CLI.hpp>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>

#include "controller/daemon/command.h"
#include "controller/daemon/json_text.h"
#include "controller/daemon/problems.h"
#include "controller/importers/show.h"
#include "controller/studio/load.h"
#include "controller/twin/scene.h"

namespace chiaro::daemon {
namespace {

ports::Exit give_out(const std::string& file, const std::string& target, ports::World& world,
                     bool json) {
  const auto loaded = studio::load_studio(file, {world.config_folder});
  if (!loaded) return refuse(loaded.problems(), world, json);
  const auto geometry = twin::build_geometry(loaded->studio, {});
  if (!geometry) return refuse(geometry.problems(), world, json);
  std::vector<std::string> left_out;
  const auto bytes = importers::mvr_of(loaded->studio, (*geometry)->aim, left_out);
  if (!bytes) return refuse(bytes.problems(), world, json);
  std::ofstream out(target, std::ios::binary | std::ios::trunc);
  out << *bytes;
  out.close();
  if (!out)
    return refuse({{{target, 0, 0},
                    "this file cannot be written",
                    "is the folder there and writable, and the disk not full?",
                    false}},
                  world, json);
  for (const std::string& each : left_out) world.err << "not in it: " << each << "\n";
  if (json)
    world.out << json_text(nlohmann::json{{"ok", true}, {"file", target}, {"left_out", left_out}})
              << "\n";
  else
    world.out << "Wrote " << target << "\n";
  return ports::Exit::done;
}

}  // namespace

void declare_export(CLI::App& app, ports::World& world, Verdict& verdict) {
  auto* verb = app.add_subcommand("export", "the studio's lamps, places and patch as an MVR scene");
  auto file = std::make_shared<std::string>(), target = std::make_shared<std::string>();
  verb->add_option("STUDIO", *file, "the studio file")->required();
  verb->add_option("MVR", *target, "the file to write, show.mvr")->required();
  verb->callback([file, target, &world, &verdict] {
    verdict.exit = give_out(*file, *target, world, verdict.json);
  });
}

}  // namespace chiaro::daemon
