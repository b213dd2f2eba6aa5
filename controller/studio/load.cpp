// SPDX-License-Identifier: Apache-2.0
// The path of a studio file, read aloud: text, tree, sections, checks, fingerprint.
#include "controller/studio/load.h"

#include "controller/core/hash.h"
#include "controller/studio/checks/checks.h"
#include "controller/studio/reading/files.h"
#include "controller/studio/reading/scalars.h"
#include "controller/studio/reading/section.h"
#include "controller/studio/sections/sections.h"

namespace chiaro::studio {
namespace {

using namespace reading;

Studio read_sections(const Tree& tree, Context& context, profiles::Shelf& shelf) {
  Studio studio;
  Section top(tree, "a studio", context.report);
  into(studio.name, text(top.need("studio", "a name for it"), context.report));
  sections::read_subjects(top, context, studio);
  sections::read_background(top, context, studio);
  sections::read_cameras(top, context, studio);
  sections::read_exposure(top, context, studio);
  sections::read_ambient(top, context, studio);
  sections::read_safety(top, context, studio);
  sections::read_buses(top, context, studio);
  sections::read_outputs(top, context, studio);
  sections::read_fixtures(top, context, shelf, studio);
  sections::read_circuits(top, context, studio);
  sections::read_keep_out(top, context, studio);
  sections::read_surfaces(top, context, studio);
  top.refuse_unknown();
  return studio;
}

/// Brain and hand must read the same lamps in the same places; only content counts, so that a
/// studio keeps its fingerprint when its folder moves.
std::uint64_t fingerprint(const std::string& yaml, const profiles::Shelf& shelf,
                          const Studio& studio) {
  core::Fingerprint print;
  print.add(yaml);
  for (const auto& [name, text] : shelf.texts())
    print.add(std::string_view("\0", 1)).add(name).add(std::string_view("\0", 1)).add(text);
  for (const Surface& surface : studio.surfaces) print.add(core::hex(surface.map.fingerprint));
  for (const Output& output : studio.outputs)
    if (const auto* modbus = std::get_if<ModbusOutput>(&output.driver))
      print.add(core::hex(modbus->map.fingerprint));
  return print.value();
}

core::Result<Loaded> parse(const std::string& yaml, const std::string& name,
                           const std::filesystem::path& base, const Folders& shipped) {
  Folders folders = shipped;
  if (folders.own.empty()) folders.own = base / "fixtures";
  const auto document = parse_tree(yaml, name);
  if (!document) return document.problems();
  Report report(name);
  report.add(document->problems);
  Context context{base, folders, report};
  profiles::Shelf shelf(folders);
  Loaded loaded{read_sections(document->root, context, shelf), {}};
  checks::check_addresses(loaded.studio, report);
  checks::check_outputs(loaded.studio, report);
  checks::check_places(loaded.studio, report);
  if (report.any_error()) return report.sorted();
  loaded.warnings = report.sorted();
  loaded.studio.fingerprint = fingerprint(yaml, shelf, loaded.studio);
  return loaded;
}

}  // namespace

core::Result<Loaded> load_studio(const std::filesystem::path& file, const Folders& folders) {
  const auto yaml = read_text(file);
  if (!yaml) return yaml.problems();
  std::error_code code;
  const std::filesystem::path absolute = std::filesystem::absolute(file, code).lexically_normal();
  auto loaded = parse(*yaml, file.string(), absolute.parent_path(), folders);
  if (loaded) loaded->studio.file = absolute;
  return loaded;
}

core::Result<Loaded> parse_studio(const std::string& yaml, const std::filesystem::path& base,
                                  const Folders& folders) {
  return parse(yaml, "studio.yaml", base, folders);
}

}  // namespace chiaro::studio
