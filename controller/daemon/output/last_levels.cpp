// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/output/last_levels.h"

#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <span>
#include <sstream>

#include "controller/core/hash.h"
#include "controller/daemon/output/state_json.h"

namespace chiaro::daemon {
namespace {

using Json = nlohmann::json;

/// JSON keeps its keys sorted, so the same values give the same text.
std::string checksum_of(const Json& json) {
  return core::hex(core::Fingerprint().add(text_of(json)).value());
}

bool is_whole(const Json& json) {
  if (json.is_discarded() || !json.is_object() || !json.contains("fixtures") ||
      !json["fixtures"].is_object())
    return false;
  // A file that somebody wrote by hand has none.
  if (!json.contains("checksum")) return true;
  Json rest = json;
  rest.erase("checksum");
  return json["checksum"] == Json(checksum_of(rest));
}

Json marks_of(const studio::Studio& studio, const std::vector<rig::Marks>& marks) {
  Json json = Json::object();
  for (std::size_t i = 0; i < studio.fixtures.size() && i < marks.size(); ++i)
    if (marks[i] != 0) json[studio.fixtures[i].name] = marks[i];
  return json;
}

std::vector<rig::Marks> marks_in(const studio::Studio& studio, const Json& json) {
  std::vector<rig::Marks> marks;
  for (const auto& fixture : studio.fixtures) {
    const Json mark = json.is_object() ? json.value(fixture.name, Json()) : Json();
    marks.push_back(mark.is_number_unsigned() ? static_cast<rig::Marks>(mark.get<unsigned>() & 255u)
                                              : rig::Marks{0});
  }
  return marks;
}

bool flag(const Json& json, const char* name) {
  const Json value = json.value(name, Json());
  return value.is_boolean() && value.get<bool>();
}

void take_ids(const Json& json, const char* name, std::span<std::uint64_t> into) {
  const Json ids = json.value(name, Json::array());
  for (std::size_t i = 0; ids.is_array() && i < into.size() && i < ids.size(); ++i)
    if (ids[i].is_number_unsigned()) into[i] = ids[i].get<std::uint64_t>();
}

rig::Held held_in(const Json& json, const studio::Studio& studio) {
  rig::Held held;
  held.blackout = flag(json, "blackout");
  held.motion_stop = flag(json, "motion_stop");
  if (const Json cue = json.value("cue", Json()); cue.is_number()) held.cue = cue.get<double>();
  const Json masters = json.value("masters", Json::array());
  for (std::size_t i = 0; masters.is_array() && i < held.masters.size() && i < masters.size(); ++i)
    if (masters[i].is_number()) held.masters[i] = masters[i].get<double>();
  take_ids(json, "fade_ids", held.fade_id);
  take_ids(json, "master_ids", held.master_id);
  std::array<std::uint64_t, 3> latches{};
  take_ids(json, "latch_ids", latches);
  held.blackout_id = latches[0];
  held.stop_id = latches[1];
  held.arm_id = latches[2];
  held.marks = marks_in(studio, json.value("marks", Json()));
  held.own_marks = marks_in(studio, json.value("own_marks", Json()));
  held.fixtures = states_of(studio, json["fixtures"]);
  const Json own = json.value("own", Json());
  if (own.is_object()) held.own = states_of(studio, own);
  return held;
}

}  // namespace

core::Result<core::Done> write_last_levels(const std::filesystem::path& file,
                                           const studio::Studio& studio, const rig::Held& held,
                                           FileCalls& calls) {
  Json json;
  json["about"] = "levels that chiaro-output sends when it starts; inside units (radians, kelvin)";
  json["studio"] = studio.name;
  json["blackout"] = held.blackout;
  json["motion_stop"] = held.motion_stop;
  json["masters"] = held.masters;
  json["fade_ids"] = held.fade_id;
  json["master_ids"] = held.master_id;
  json["latch_ids"] = {held.blackout_id, held.stop_id, held.arm_id};
  if (held.cue) json["cue"] = *held.cue;
  json["marks"] = marks_of(studio, held.marks);
  json["own_marks"] = marks_of(studio, held.own_marks);
  json["fixtures"] = json_of(studio, held.fixtures);
  for (std::size_t i = 0; i < studio.fixtures.size() && i < held.own.size(); ++i)
    if (held.own[i].present() != 0) json["own"][studio.fixtures[i].name] = json_of(held.own[i]);
  json["checksum"] = checksum_of(json);
  return write_whole(file, text_of(json, 1) + "\n", kLevelGenerations, calls);
}

core::Result<core::Done> write_last_levels(const std::filesystem::path& file,
                                           const studio::Studio& studio, const rig::Held& held) {
  FileCalls calls;
  return write_last_levels(file, studio, held, calls);
}

std::optional<rig::Held> read_last_levels(const std::filesystem::path& file,
                                          const studio::Studio& studio, core::Problems& warnings) {
  for (int g = 0; g < kLevelGenerations; ++g) {
    const std::filesystem::path each = generation_of(file, g);
    std::ifstream in(each);
    if (!in) continue;
    std::stringstream text;
    text << in.rdbuf();
    const Json json = Json::parse(text.str(), nullptr, false);
    if (is_whole(json)) {
      if (json.value("studio", Json()) != Json(studio.name)) return std::nullopt;
      return held_in(json, studio);
    }
    warnings.push_back({{each.string()},
                        "the levels kept from last time cannot be read",
                        "the one before is taken, or else the studio file's; it will be written "
                        "anew",
                        true});
  }
  return std::nullopt;
}

}  // namespace chiaro::daemon
