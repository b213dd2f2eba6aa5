// SPDX-License-Identifier: Apache-2.0
// look.json of the command-line contract. Written with nlohmann, read with yaml-cpp: JSON is YAML,
// and yaml-cpp knows at which line and column each value stands.
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <yaml-cpp/yaml.h>

#include "controller/core/hash.h"
#include "controller/design/design.h"
#include "controller/design/words.h"

namespace chiaro::design {
namespace {

constexpr const char* kFormat = "chiaro look 1";

using Json = nlohmann::ordered_json;

/// Rounded to a millionth: enough for 16-bit channels, and readable.
double tidy(double value) { return std::round(value * 1e6) / 1e6; }

Json state_to_json(const core::FixtureState& state) {
  Json json = Json::object();
  for (const core::DofInfo& each : core::dofs())
    if (state.has(each.dof))
      json[std::string(each.file_name)] = tidy(core::file_value(each.dof, state.get(each.dof)));
  return json;
}

std::string in_words(const core::FixtureState& state) {
  std::string words;
  if (state.has(core::Dof::azimuth) && state.has(core::Dof::distance))
    words = place_in_words({state.get(core::Dof::azimuth), state.get(core::Dof::elevation),
                            state.get(core::Dof::distance)}) +
            ", ";
  words += level_in_words(state.get(core::Dof::intensity));
  if (state.has(core::Dof::cct)) words += ", " + number(state.get(core::Dof::cct), 0) + " K";
  return words;
}

Json judgement_to_json(const Judgement& judgement) {
  Json json;
  json["verdict"] = name_of(judgement.verdict);
  json["residual"] = tidy(judgement.residual);
  if (!judgement.limiting_fixture.empty()) json["limiting_fixture"] = judgement.limiting_fixture;
  json["missing_stops"] = tidy(judgement.missing_stops);
  json["remedy"] = judgement.remedy;
  return json;
}

Json components_to_json(const std::vector<Component>& components) {
  Json json = Json::object();
  for (const Component& component : components) {
    json[component.name]["value"] = tidy(component.value);
    json[component.name]["target"] = component.target ? Json(tidy(*component.target)) : Json();
  }
  return json;
}

/// Reads with a place for every complaint.
class Reader {
 public:
  Reader(const studio::Studio& studio, std::string file)
      : studio_(studio), file_(std::move(file)) {}

  core::Result<Look> read(const std::string& text) {
    YAML::Node root;
    try {
      root = YAML::Load(text);
    } catch (const YAML::Exception& error) {
      return core::Problem{place(error.mark), "this is not JSON: " + error.msg,
                           "write the look again with \"chiaro design … --out\""};
    }
    if (!root.IsMap() || text_of(root, "format") != kFormat)
      return core::Problem{{file_, 1, 1},
                           std::string("this is not a look: expected an object with \"format\": "
                                       "\"") +
                               kFormat + "\"",
                           "write one with \"chiaro design … --out look.json\""};
    Look look;
    read_head(root, look);
    look.wanted = studio::placed_rig(studio_);
    look.placed = look.wanted;
    read_fixtures(root["fixtures"], look);
    read_components(root["components"], look);
    if (core::any_error(problems_)) return problems_;
    return look;
  }

 private:
  core::Place place(const YAML::Mark& mark) const {
    return mark.is_null() ? core::Place{file_} : core::Place{file_, mark.line + 1, mark.column + 1};
  }
  void complain(const YAML::Node& node, std::string what, std::string remedy) {
    problems_.push_back({place(node.Mark()), std::move(what), std::move(remedy)});
  }
  std::string text_of(const YAML::Node& node, const std::string& key) const {
    return node[key] && node[key].IsScalar() ? node[key].Scalar() : "";
  }
  std::optional<double> number_of(const YAML::Node& node, const std::string& name) {
    if (!node || node.IsNull()) return std::nullopt;
    double value = 0;
    const std::string& text = node.IsScalar() ? node.Scalar() : std::string();
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc() && end == text.data() + text.size() && std::isfinite(value))
      return value;
    complain(node, "\"" + name + "\" should be a number", "write it without a unit");
    return std::nullopt;
  }
  std::vector<std::string> lines_of(const YAML::Node& node) const {
    std::vector<std::string> lines;
    if (node && node.IsSequence())
      for (const auto& line : node)
        if (line.IsScalar()) lines.push_back(line.Scalar());
    return lines;
  }

  void read_judgement(const YAML::Node& node, Judgement& judgement) {
    if (!node || !node.IsMap()) return;
    const std::string verdict = text_of(node, "verdict");
    for (const Verdict each : {Verdict::reached, Verdict::near, Verdict::not_reachable})
      if (verdict == name_of(each)) judgement.verdict = each;
    judgement.residual = number_of(node["residual"], "residual").value_or(0);
    judgement.limiting_fixture = text_of(node, "limiting_fixture");
    judgement.missing_stops = number_of(node["missing_stops"], "missing_stops").value_or(0);
    judgement.remedy = text_of(node, "remedy");
  }

  void read_head(const YAML::Node& root, Look& look) {
    look.name = text_of(root, "name");
    look.goal = text_of(root, "goal");
    look.optimiser = text_of(root, "optimiser");
    look.seed = static_cast<std::uint64_t>(number_of(root["seed"], "seed").value_or(0));
    look.trials = static_cast<std::uint64_t>(number_of(root["trials"], "trials").value_or(0));
    look.seconds = number_of(root["seconds"], "seconds").value_or(0);
    look.cost = number_of(root["cost"], "cost").value_or(0);
    look.stopped_by_time = text_of(root, "stopped_by_time") == "true";
    look.exposure_advice_stops =
        number_of(root["exposure_advice_stops"], "exposure_advice_stops").value_or(0);
    look.advised_white_balance_k =
        number_of(root["advised_white_balance_k"], "advised_white_balance_k");
    read_judgement(root["judgement"], look.judgement);
    read_judgement(root["placed_judgement"], look.placed_judgement);
    look.instructions = lines_of(root["instructions"]);
    look.warnings = lines_of(root["warnings"]);
    look.mirrored = root["mirrored"] && root["mirrored"].as<bool>(false);
  }

  void read_state(const YAML::Node& node, const studio::Fixture& fixture,
                  core::FixtureState& state) {
    if (!node || !node.IsMap()) return;
    std::vector<std::string> known;
    for (const core::DofInfo& each : core::dofs()) known.emplace_back(each.file_name);
    for (const auto& entry : node) {
      const std::string name = entry.first.Scalar();
      const auto dof = core::dof_named(name);
      if (!dof || info(*dof).file_name != name) {
        const std::string near = core::nearest_name(name, known);
        complain(entry.first, "fixture \"" + fixture.name + "\" cannot have \"" + name + "\"",
                 near.empty() ? "remove it" : "did you mean \"" + near + "\"?");
        continue;
      }
      const auto value = number_of(entry.second, name);
      if (!value) continue;
      if (*dof == core::Dof::intensity && (*value < 0 || *value > 1))
        complain(entry.second, "\"intensity\" should be within 0 and 1", "1 is full");
      else
        state.set(*dof, core::inside_value(*dof, *value));
    }
  }

  void read_fixtures(const YAML::Node& node, Look& look) {
    if (!node || !node.IsMap()) {
      problems_.push_back({{file_, 1, 1}, "the look has no \"fixtures\"", "design it again"});
      return;
    }
    std::vector<std::string> known;
    for (const auto& fixture : studio_.fixtures) known.push_back(fixture.name);
    for (const auto& entry : node) {
      const std::string name = entry.first.Scalar();
      const auto index = studio_.fixture_index(name);
      if (!index) {
        const std::string near = core::nearest_name(name, known);
        complain(entry.first, "the studio has no fixture \"" + name + "\"",
                 near.empty() ? "use the studio that the look was designed for, or design it again"
                              : "did you mean \"" + near + "\"?");
        continue;
      }
      read_state(entry.second["wanted"], studio_.fixtures[*index], look.wanted.states[*index]);
      read_state(entry.second["placed"], studio_.fixtures[*index], look.placed.states[*index]);
    }
  }

  void read_components(const YAML::Node& node, Look& look) {
    if (!node || !node.IsMap()) return;
    for (const auto& entry : node) {
      const std::string name = entry.first.Scalar();
      look.components.push_back({name, number_of(entry.second["target"], name),
                                 number_of(entry.second["value"], name).value_or(0)});
    }
  }

  const studio::Studio& studio_;
  const std::string file_;
  core::Problems problems_;
};

}  // namespace

std::string look_to_json(const studio::Studio& studio, const Look& look) {
  Json json;
  json["format"] = kFormat;
  json["name"] = look.name;
  json["studio"] = studio.name;
  json["studio_fingerprint"] = core::hex(studio.fingerprint);
  json["goal"] = look.goal;
  json["optimiser"] = look.optimiser;
  json["seed"] = look.seed;
  json["trials"] = look.trials;
  json["seconds"] = tidy(look.seconds);
  json["stopped_by_time"] = look.stopped_by_time;
  json["cost"] = std::isfinite(look.cost) ? Json(tidy(look.cost)) : Json();
  json["judgement"] = judgement_to_json(look.judgement);
  json["placed_judgement"] = judgement_to_json(look.placed_judgement);
  const auto ratio = key_fill_ratio(studio, look.wanted);
  json["key_fill_ratio"] = ratio ? Json(tidy(*ratio)) : Json();
  json["exposure_advice_stops"] = tidy(look.exposure_advice_stops);
  json["advised_white_balance_k"] =
      look.advised_white_balance_k ? Json(*look.advised_white_balance_k) : Json();
  json["fixtures"] = Json::object();
  for (std::size_t i = 0; i < studio.fixtures.size(); ++i) {
    Json& fixture = json["fixtures"][studio.fixtures[i].name];
    fixture["role"] = studio::name_of(studio.fixtures[i].role);
    fixture["in_words"] = in_words(look.wanted.states[i]);
    fixture["wanted"] = state_to_json(look.wanted.states[i]);
    fixture["placed"] = state_to_json(look.placed.states[i]);
  }
  json["components"] = components_to_json(look.components);
  json["instructions"] = look.instructions;
  json["warnings"] = look.warnings;
  json["mirrored"] = look.mirrored;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

core::Result<Look> look_from_json(const studio::Studio& studio, const std::string& json,
                                  const std::string& file_name) {
  return Reader(studio, file_name).read(json);
}

}  // namespace chiaro::design
