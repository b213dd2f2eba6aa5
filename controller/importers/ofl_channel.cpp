// SPDX-License-Identifier: Apache-2.0
#include "controller/importers/ofl_channel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "controller/importers/capability.h"
#include "controller/importers/xml.h"

namespace chiaro::importers {
namespace {

using Json = nlohmann::json;
using studio::Segment;

std::string text_in(const Json& json, const char* key) {
  return json.is_object() && json.contains(key) && json[key].is_string()
             ? json[key].get<std::string>()
             : std::string();
}

struct Colour {
  const char* name;
  Meaning meaning;
};
constexpr std::array kColours{Colour{"Red", Meaning::red},
                              Colour{"Green", Meaning::green},
                              Colour{"Blue", Meaning::blue},
                              Colour{"White", Meaning::white},
                              Colour{"Cold White", Meaning::white},
                              Colour{"Warm White", Meaning::warm_white},
                              Colour{"Amber", Meaning::amber},
                              Colour{"Lime", Meaning::lime},
                              Colour{"UV", Meaning::uv},
                              Colour{"Cyan", Meaning::cut_red},
                              Colour{"Magenta", Meaning::cut_green},
                              Colour{"Yellow", Meaning::cut_blue}};

Meaning meaning_of(const Json& capability) {
  const std::string type = text_in(capability, "type");
  if (type == "Intensity") return Meaning::intensity;
  if (type == "ColorTemperature") return Meaning::cct;
  if (type == "Pan") return Meaning::pan;
  if (type == "Tilt") return Meaning::tilt;
  if (type == "Zoom") return Meaning::zoom;
  if (type == "ShutterStrobe") return Meaning::shutter;
  if (type == "ColorIntensity")
    for (const Colour& colour : kColours)
      if (text_in(capability, "color") == colour.name) return colour.meaning;
  return Meaning::unknown;
}

/// "2800K", "12deg", "50%": the number when it has that unit.
std::optional<double> with_unit(const std::string& words, std::string_view unit) {
  if (words.size() <= unit.size() ||
      words.compare(words.size() - unit.size(), unit.size(), unit) != 0)
    return std::nullopt;
  const double value = number_in(std::string_view(words).substr(0, words.size() - unit.size()),
                                 -1e6, 1e6, std::nan(""));
  return std::isnan(value) ? std::nullopt : std::optional(value);
}

std::optional<double> brightness(const std::string& words) {
  if (const auto share = with_unit(words, "%")) return std::clamp(*share / 100, 0.0, 1.0);
  if (words == "off" || words == "dark") return 0;
  if (words == "bright") return 1;
  return std::nullopt;
}

/// Both ends of an entity: xStart and xEnd, or x for both.
std::pair<std::string, std::string> ends(const Json& capability, const std::string& entity) {
  const std::string one = text_in(capability, entity.c_str());
  if (!one.empty()) return {one, one};
  return {text_in(capability, (entity + "Start").c_str()),
          text_in(capability, (entity + "End").c_str())};
}

/// Physical values at both ends; nothing where the library gives words ("narrow", "warm").
std::optional<std::pair<double, double>> physical(const Json& capability, Meaning meaning) {
  const auto both = [&](const std::string& entity, std::string_view unit,
                        double scale) -> std::optional<std::pair<double, double>> {
    const auto [from, to] = ends(capability, entity);
    const auto a = with_unit(from, unit), b = with_unit(to, unit);
    if (!a || !b) return std::nullopt;
    return std::pair(*a * scale, *b * scale);
  };
  switch (meaning) {
    case Meaning::pan:
    case Meaning::tilt:
    case Meaning::zoom:
      return both("angle", "deg", core::radians(1));
    case Meaning::cct:
      return both("colorTemperature", "K", 1);
    default: {
      const auto [from, to] = ends(capability, "brightness");
      const auto a = brightness(from), b = brightness(to);
      if (!a || !b) return std::pair(0.0, 1.0);
      return std::pair(*a, *b);
    }
  }
}

struct Piece {
  double from = 0, to = 1;  ///< fractions
  const Json* capability = nullptr;
};

std::vector<Piece> pieces_of(const Json& channel, double full) {
  std::vector<Piece> all;
  if (channel.contains("capability")) return {{0, 1, &channel["capability"]}};
  if (!channel.contains("capabilities") || !channel["capabilities"].is_array()) return {};
  for (const Json& each : channel["capabilities"]) {
    if (!each.is_object() || !each.contains("dmxRange") || all.size() >= 256) continue;
    const Json& range = each["dmxRange"];
    if (!range.is_array() || range.size() != 2 || !range[0].is_number() || !range[1].is_number())
      continue;
    const double from = range[0].get<double>() / full, to = range[1].get<double>() / full;
    if (from < 0 || to > 1 || to < from || (!all.empty() && from <= all.back().to)) continue;
    all.push_back({from, to, &each});
  }
  return all;
}

Segment segment_of(const Piece& piece, Meaning meaning) {
  Segment s{piece.from, piece.to, 0, 0, Segment::Law::no_effect};
  const std::string type = text_in(*piece.capability, "type");
  if (type == "NoFunction" && meaning == Meaning::intensity) s.law = Segment::Law::neutral;
  if (meaning_of(*piece.capability) != meaning) return s;
  const auto ends_of = physical(*piece.capability, meaning);
  if (!ends_of) return s;
  s.physical_from = ends_of->first;
  s.physical_to = ends_of->second;
  s.law = s.physical_from == s.physical_to ? Segment::Law::neutral : Segment::Law::continuous;
  const bool cut =
      meaning == Meaning::cut_red || meaning == Meaning::cut_green || meaning == Meaning::cut_blue;
  if (cut) s.physical_from = 1 - s.physical_from, s.physical_to = 1 - s.physical_to;
  return s;
}

/// Pan and tilt count from the middle of their travel.
void centre(std::vector<Segment>& segments) {
  double least = 1e9, most = -1e9;
  for (const Segment& s : segments)
    if (s.law == Segment::Law::continuous) {
      least = std::min({least, s.physical_from, s.physical_to});
      most = std::max({most, s.physical_from, s.physical_to});
    }
  for (Segment& s : segments) {
    s.physical_from -= 0.5 * (least + most);
    s.physical_to -= 0.5 * (least + most);
  }
}

void add_law(const std::vector<Piece>& pieces, LibraryChannel& channel) {
  for (const Piece& piece : pieces) channel.segments.push_back(segment_of(piece, channel.meaning));
  const auto continuous = [](const Segment& s) { return s.law == Segment::Law::continuous; };
  const auto first = std::find_if(channel.segments.begin(), channel.segments.end(), continuous);
  if (first == channel.segments.end()) {
    channel.segments.clear();
    return;
  }
  // A second stretch that runs the other way would give one wish two raw values.
  const bool rises = first->physical_to > first->physical_from;
  double reached = first->physical_to;
  for (auto s = first + 1; s != channel.segments.end(); ++s) {
    if (!continuous(*s)) continue;
    const bool onward = rises ? s->physical_from >= reached && s->physical_to > s->physical_from
                              : s->physical_from <= reached && s->physical_to < s->physical_from;
    if (onward)
      reached = s->physical_to;
    else
      s->law = Segment::Law::no_effect;
  }
  if (channel.meaning == Meaning::pan || channel.meaning == Meaning::tilt) centre(channel.segments);
}

void add_shutter(const std::vector<Piece>& pieces, LibraryChannel& channel) {
  for (const Piece& piece : pieces) {
    const std::string effect = text_in(*piece.capability, "shutterEffect");
    const std::string type = text_in(*piece.capability, "type");
    const double middle = 0.5 * (piece.from + piece.to);
    if (effect == "Open" && !channel.lit) channel.lit = middle;
    if (effect == "Closed" && !channel.closed) channel.closed = middle;
    if (type == "NoFunction" && !channel.lit) channel.lit = middle;
  }
  channel.held = channel.lit.value_or(0);
  if (!channel.lit) channel.closed.reset();
}

double default_of(const Json& channel, double full) {
  for (const char* key : {"constant", "defaultValue"}) {
    if (!channel.contains(key)) continue;
    const Json& value = channel[key];
    if (value.is_number()) return std::clamp(value.get<double>() / full, 0.0, 1.0);
    if (const auto share = with_unit(text_in(channel, key), "%"))
      return std::clamp(*share / 100, 0.0, 1.0);
  }
  return 0;
}

}  // namespace

LibraryChannel ofl_channel(const std::string& name, const Json& channel, std::vector<int> slots,
                           int finest) {
  LibraryChannel out;
  out.name = name;
  out.slots = std::move(slots);
  if (!channel.is_object()) return out;
  const std::string resolution = text_in(channel, "dmxValueResolution");
  const int bytes = resolution == "8bit"    ? 1
                    : resolution == "16bit" ? 2
                    : resolution == "24bit" ? 3
                                            : std::clamp(finest, 1, 4);
  const double full = std::exp2(8 * bytes) - 1;
  const std::vector<Piece> pieces = pieces_of(channel, full);
  bool shutter = false;
  for (const Piece& piece : pieces) {
    if (!piece.capability->is_object()) return out;
    const Meaning meaning = meaning_of(*piece.capability);
    shutter = shutter || meaning == Meaning::shutter;
    if (out.meaning == Meaning::unknown && meaning != Meaning::shutter) out.meaning = meaning;
  }
  out.held = default_of(channel, full);
  if (out.meaning == Meaning::unknown && shutter) {
    out.meaning = Meaning::shutter;
    add_shutter(pieces, out);
  } else if (out.meaning != Meaning::unknown) {
    add_law(pieces, out);
  }
  // Named "Master Dimmer" beside dimmers of cells.
  if (out.meaning == Meaning::intensity && lower(name).find("master") != std::string::npos)
    out.meaning = Meaning::master;
  return out;
}

}  // namespace chiaro::importers
