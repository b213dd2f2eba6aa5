// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/patch_sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "controller/core/hash.h"
#include "controller/daemon/problems.h"
#include "controller/studio/words.h"
#include "controller/twin/scene.h"

namespace chiaro::daemon {
namespace {

using studio::Fixture;
using studio::Studio;

constexpr std::size_t kColumns = 7;
using Row = std::array<std::string, kColumns>;

/// Characters, not bytes: '°' is two bytes and one column.
std::size_t shown_width(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xc0u) != 0x80u;
  }));
}

const std::string& mode_of(const Fixture& fixture) {
  return fixture.profile.modes[fixture.mode].name;
}

std::string how_limited(const Fixture& fixture) {
  const std::string by_hand = studio::by_hand_in_words(fixture);
  const std::string limits = studio::limits_in_words(fixture.limits);
  if (by_hand.empty()) return limits == "none" ? "" : limits;
  return by_hand + (limits == "none" ? "" : "; " + limits);
}

Row row_of(const Fixture& fixture, const core::Spherical& place) {
  return {fixture.name,
          std::string(studio::name_of(fixture.role)),
          fixture.profile.name + " " + mode_of(fixture),
          studio::patch_in_words(fixture),
          studio::output_in_words(fixture),
          std::string(studio::name_of(fixture.mount)) + ", " + studio::place_in_words(place),
          how_limited(fixture)};
}

std::string table(const std::vector<Row>& rows) {
  std::array<std::size_t, kColumns> widths{};
  for (const Row& row : rows)
    for (std::size_t c = 0; c < kColumns; ++c) widths[c] = std::max(widths[c], shown_width(row[c]));
  std::string text;
  for (const Row& row : rows) {
    std::string line;
    for (std::size_t c = 0; c < kColumns; ++c)
      line += row[c] + std::string(widths[c] - shown_width(row[c]) + 2, ' ');
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

std::string output_line(const studio::Output& output) {
  return "universe " + std::to_string(output.universe) + ": " +
         studio::output_in_words(output.driver);
}

/// A degree that went through radians comes back as 44.99999999999999: say 45.
double clean(double value) { return std::round(value * 1e6) / 1e6; }

nlohmann::json patch_json(const Fixture& fixture) {
  const int slots = fixture.profile.modes[fixture.mode].footprint;
  if (const auto* dmx = std::get_if<studio::DmxPatch>(&fixture.patch))
    return {{"universe", dmx->universe}, {"address", dmx->address}, {"slots", slots}};
  if (const auto* bus = std::get_if<studio::ModbusPatch>(&fixture.patch))
    return {{"modbus", bus->bus}, {"register", bus->register_number}, {"registers", slots}};
  return nullptr;
}

nlohmann::json fixture_json(const Fixture& fixture, const core::Spherical& place) {
  nlohmann::json controls = nlohmann::json::object();
  for (const auto& [dof, range] : fixture.ranges())
    controls[std::string(core::info(dof).file_name)] = {clean(core::file_value(dof, range.least)),
                                                        clean(core::file_value(dof, range.most))};
  nlohmann::json by_hand = nlohmann::json::object();
  for (const studio::HandBinding& binding : fixture.by_hand)
    by_hand[std::string(core::info(binding.dof).file_name)] = studio::name_of(binding.kind);
  return {{"name", fixture.name},
          {"role", studio::name_of(fixture.role)},
          {"profile", fixture.profile.name},
          {"mode", mode_of(fixture)},
          {"patch", patch_json(fixture)},
          {"output_cd", fixture.fitted_output().value},
          {"mount", studio::name_of(fixture.mount)},
          {"placed",
           {{"azimuth_deg", clean(core::degrees(place.azimuth))},
            {"elevation_deg", clean(core::degrees(place.elevation))},
            {"distance_m", clean(place.distance)}}},
          {"in_words", studio::place_in_words(place)},
          {"limits",
           {{"most", fixture.limits.most},
            {"slew_per_s", fixture.limits.slew_per_s},
            {"safe_level", fixture.limits.safe_level},
            {"house_light", fixture.limits.ignores_blackout}}},
          {"controls", controls},
          {"by_hand", by_hand},
          {"controlled", fixture.controlled}};
}

}  // namespace

PatchSheet patch_sheet(const Studio& studio, const core::AimFrame& aim) {
  PatchSheet sheet{studio, {}};
  const studio::Rig rig = studio::placed_rig(studio);
  for (std::size_t i = 0; i < studio.fixtures.size(); ++i)
    sheet.places.push_back(
        core::spherical(aim, twin::pose(studio.fixtures[i], rig.states[i], aim).position));
  return sheet;
}

std::string to_text(const PatchSheet& sheet) {
  const Studio& studio = sheet.studio;
  std::vector<Row> rows{{"fixture", "role", "profile and mode", "address", "output",
                         "stands (from the sitter)", "notes"}};
  for (std::size_t i = 0; i < studio.fixtures.size(); ++i)
    rows.push_back(row_of(studio.fixtures[i], sheet.places[i]));
  std::string text = studio.name + "\n\n" + table(rows) + "\n";
  for (const studio::Output& output : studio.outputs) text += output_line(output) + "\n";
  for (const studio::Bus& bus : studio.buses)
    text += "bus " + bus.name + ": Modbus on " + bus.device + "\n";
  return text;
}

std::string to_json(const PatchSheet& sheet, const core::Problems& warnings) {
  const Studio& studio = sheet.studio;
  nlohmann::json fixtures = nlohmann::json::array(), outputs = nlohmann::json::array();
  for (std::size_t i = 0; i < studio.fixtures.size(); ++i)
    fixtures.push_back(fixture_json(studio.fixtures[i], sheet.places[i]));
  for (const studio::Output& output : studio.outputs)
    outputs.push_back({{"universe", output.universe}, {"in_words", output_line(output)}});
  const nlohmann::json answer{{"ok", true},
                              {"studio", studio.name},
                              {"file", studio.file.string()},
                              {"fingerprint", core::hex(studio.fingerprint)},
                              {"fixtures", fixtures},
                              {"outputs", outputs},
                              {"problems", nlohmann::json::parse(problems_to_json(warnings))}};
  return answer.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace chiaro::daemon
