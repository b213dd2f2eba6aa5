// SPDX-License-Identifier: Apache-2.0
// `chiaro doctor [STUDIO]`: what stands between this machine and its lamps, and the command that
// mends each.
#include "controller/daemon/doctor/doctor.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <ostream>

#include "controller/daemon/command.h"
#include "controller/daemon/problems.h"
#include "controller/studio/load.h"

namespace chiaro::daemon {
namespace {

ports::Exit look_at(const std::string& file, ports::World& world, bool json) {
  std::optional<studio::Studio> studio;
  if (!file.empty()) {
    auto loaded = studio::load_studio(file, {world.config_folder});
    if (!loaded) return refuse(loaded.problems(), world, json);
    studio = std::move(loaded->studio);
  }
  const auto findings =
      doctor::examine("/", doctor::whoever_runs_this(), world.devices, studio ? &*studio : nullptr);
  world.out << (json ? doctor::to_json(findings) + "\n" : doctor::to_text(findings));
  const bool bad = std::any_of(findings.begin(), findings.end(), [](const auto& finding) {
    return finding.state == doctor::Finding::State::bad;
  });
  return bad ? ports::Exit::out_of_reach : ports::Exit::done;
}

}  // namespace

void declare_doctor(CLI::App& app, ports::World& world, Verdict& verdict) {
  auto* verb = app.add_subcommand(
      "doctor", "devices, permissions, real-time limits, port clashes, and what mends each");
  auto file = std::make_shared<std::string>();
  verb->add_option("STUDIO", *file, "also look for everything that this studio file names");
  verb->callback([file, &world, &verdict] { verdict.exit = look_at(*file, world, verdict.json); });
}

}  // namespace chiaro::daemon
