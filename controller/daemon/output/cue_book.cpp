// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/output/cue_book.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "controller/daemon/output/state_json.h"
#include "controller/daemon/output/whole_file.h"

namespace chiaro::daemon {
namespace {

using Json = nlohmann::json;

constexpr int kCueGenerations = 5;
/// A person may have written the file.
constexpr double kLongestTime = 24 * 3600, kMostNumber = 1e6;

double number_in(const Json& json, const char* name, double otherwise) {
  const Json value = json.value(name, Json());
  return value.is_number() && std::isfinite(value.get<double>()) ? value.get<double>() : otherwise;
}

std::string text_in(const Json& json, const char* name) {
  const Json value = json.value(name, Json());
  return value.is_string() ? value.get<std::string>() : "";
}

rig::Cue cue_of(const Json& json, const studio::Studio& studio) {
  rig::Cue cue;
  cue.number = std::clamp(number_in(json, "number", 1), 0.0, kMostNumber);
  cue.name = text_in(json, "name");
  cue.state.fade_s = std::clamp(number_in(json, "fade_s", 0), 0.0, kLongestTime);
  if (const double follow = number_in(json, "follow_s", -1); follow >= 0)
    cue.follow_s = std::min(follow, kLongestTime);
  cue.state.fixtures = states_of(studio, json.value("fixtures", Json::object()));
  return cue;
}

Json cue_json(const rig::Cue& cue, const studio::Studio& studio) {
  Json json{{"number", cue.number}, {"name", cue.name}, {"fade_s", cue.state.fade_s}};
  if (cue.follow_s) json["follow_s"] = *cue.follow_s;
  json["fixtures"] = json_of(studio, cue.state.fixtures);
  return json;
}

}  // namespace

std::filesystem::path cue_file(const std::filesystem::path& state_folder,
                               const studio::Studio& studio) {
  std::string name = studio.name;
  for (char& c : name)
    if (c == '/' || c == '\0') c = '_';
  return state_folder / "cues" / (name + ".json");
}

std::unique_ptr<rig::CueList> read_cues(const std::filesystem::path& state_folder,
                                        const studio::Studio& studio, core::Problems& warnings) {
  auto list = std::make_unique<rig::CueList>();
  list->studio = studio.fingerprint;
  const auto file = cue_file(state_folder, studio);
  std::ifstream in(file);
  if (!in) return list;
  std::stringstream text;
  text << in.rdbuf();
  const Json json = Json::parse(text.str(), nullptr, false);
  const Json cues = json.is_object() ? json.value("cues", Json()) : Json();
  if (!cues.is_array()) {
    warnings.push_back({{file.string()},
                        "the cues cannot be read",
                        "versions before it lie beside it: copy " +
                            generation_of(file, 1).filename().string() + " over it",
                        true});
    return list;
  }
  for (const Json& cue : cues)
    if (cue.is_object()) list->put(cue_of(cue, studio));
  list->look_ahead();
  return list;
}

core::Result<core::Done> write_cues(const std::filesystem::path& state_folder,
                                    const studio::Studio& studio, const rig::CueList& list) {
  Json json{{"about", "cues of chiaro-output; inside units (radians, kelvin)"},
            {"studio", studio.name},
            {"cues", Json::array()}};
  for (const rig::Cue& cue : list.cues) json["cues"].push_back(cue_json(cue, studio));
  return write_whole(cue_file(state_folder, studio), text_of(json, 1) + "\n", kCueGenerations);
}

std::string number_in_words(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", number);
  return text;
}

}  // namespace chiaro::daemon
