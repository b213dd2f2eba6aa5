// SPDX-License-Identifier: Apache-2.0
// `chiaro check STUDIO`: every problem with its place and remedy, else the patch sheet. Looks at
// the meshes too: a studio whose bust is cut short is not in order.
#include <CLI/CLI.hpp>
#include <memory>
#include <ostream>

#include "controller/daemon/command.h"
#include "controller/daemon/patch_sheet.h"
#include "controller/daemon/problems.h"
#include "controller/studio/load.h"
#include "controller/twin/scene.h"

namespace chiaro::daemon {
namespace {

/// Lamps that must not stand where they stand: a person may be about to move them, so a warning.
core::Problems misplaced(const studio::Studio& studio, const twin::Geometry& geometry) {
  core::Problems warnings;
  const studio::Rig rig = studio::placed_rig(studio);
  for (std::size_t i = 0; i < studio.fixtures.size(); ++i)
    if (const std::string why = twin::infeasible(studio, geometry, rig, i); !why.empty())
      warnings.push_back({studio.fixtures[i].place, "'" + studio.fixtures[i].name + "': " + why,
                          "move the lamp, or correct its place in the file", true});
  return warnings;
}

ports::Exit check(const std::string& file, ports::World& world, bool json) {
  const auto loaded = studio::load_studio(file, {world.config_folder});
  if (!loaded) return refuse(loaded.problems(), world, json);
  const auto geometry = twin::build_geometry(loaded->studio, {});
  if (!geometry) return refuse(geometry.problems(), world, json);
  core::Problems warnings = loaded->warnings;
  for (const core::Problem& warning : misplaced(loaded->studio, **geometry))
    warnings.push_back(warning);
  world.err << core::to_string(warnings);
  const PatchSheet sheet = patch_sheet(loaded->studio, (*geometry)->aim);
  world.out << (json ? to_json(sheet, warnings) + "\n" : to_text(sheet));
  return ports::Exit::done;
}

}  // namespace

void declare_check(CLI::App& app, ports::World& world, Verdict& verdict) {
  auto* verb = app.add_subcommand("check", "every problem of a studio file; else its patch sheet");
  auto file = std::make_shared<std::string>();
  verb->add_option("STUDIO", *file, "the studio file")->required();
  verb->callback([file, &world, &verdict] { verdict.exit = check(*file, world, verdict.json); });
}

}  // namespace chiaro::daemon
