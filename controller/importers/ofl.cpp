// SPDX-License-Identifier: Apache-2.0
#include "controller/importers/ofl.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "controller/importers/ofl_channel.h"
#include "controller/importers/xml.h"

namespace chiaro::importers {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kMostBytes = 8u << 20;
constexpr std::size_t kMostChannels = 4096;
constexpr std::size_t kDeepest = 40;

std::string text_in(const Json& json, const char* key) {
  return json.is_object() && json.contains(key) && json[key].is_string()
             ? json[key].get<std::string>()
             : std::string();
}
double number_at(const Json& json, const char* key, double least, double most) {
  if (!json.is_object() || !json.contains(key) || !json[key].is_number()) return 0;
  const double value = json[key].get<double>();
  return std::isfinite(value) && value >= least && value <= most ? value : 0;
}
const Json& child(const Json& json, const char* key) {
  static const Json kNone;
  return json.is_object() && json.contains(key) ? json[key] : kNone;
}

std::string replaced(std::string words, const std::string& pixel) {
  constexpr std::string_view kKey = "$pixelKey";
  // On from what was put in: a pixel may be called "$pixelKey" itself.
  for (std::size_t at = 0; (at = words.find(kKey, at)) != std::string::npos && words.size() < 400;
       at += pixel.size())
    words.replace(at, kKey.size(), pixel);
  return words;
}

/// Names of the matrix's pixels, x fastest, groups after them.
std::vector<std::string> pixels_of(const Json& matrix) {
  std::vector<std::string> names;
  const auto add = [&](const Json& name) {
    if (name.is_string() && names.size() < kMostChannels) names.push_back(name.get<std::string>());
  };
  for (const Json& layer : child(matrix, "pixelKeys"))
    if (layer.is_array())
      for (const Json& row : layer)
        if (row.is_array())
          for (const Json& name : row) add(name);
  const Json& count = child(matrix, "pixelCount");
  if (names.empty() && count.is_array() && count.size() == 3) {
    double all = 1;
    for (const Json& n : count) all *= n.is_number() ? n.get<double>() : 0;
    for (int i = 1; all <= 1024 && i <= static_cast<int>(all); ++i)
      names.push_back(std::to_string(i));
  }
  return names;
}

class Reader {
 public:
  explicit Reader(const Json& root) : root_(root), pixels_(pixels_of(child(root, "matrix"))) {
    for (const auto& [key, channel] : child(root, "availableChannels").items())
      define(key, channel, "");
    const Json& groups = child(child(root, "matrix"), "pixelGroups");
    std::vector<std::string> cells = pixels_;
    if (groups.is_object())
      for (const auto& [name, members] : groups.items()) cells.push_back(name);
    for (const auto& [key, channel] : child(root, "templateChannels").items())
      for (const std::string& pixel : cells)
        if (definitions_.size() < kMostChannels) define(replaced(key, pixel), channel, pixel);
  }

  LibraryMode mode(const Json& json) {
    LibraryMode mode;
    mode.name = text_in(json, "name");
    std::vector<std::string> keys;
    for (const Json& item : child(json, "channels")) list(item, keys);
    std::map<std::string, int> slots;
    for (std::size_t i = 0; i < keys.size(); ++i)
      if (!keys[i].empty()) slots.emplace(keys[i], static_cast<int>(i));
    mode.footprint = static_cast<int>(keys.size());
    std::vector<bool> used(keys.size());
    for (std::size_t i = 0; i < keys.size(); ++i) add(keys[i], i, slots, used, mode);
    // A fine channel whose coarse one is not in this mode does nothing.
    for (std::size_t i = 0; i < keys.size(); ++i)
      if (!used[i] && !keys[i].empty()) {
        LibraryChannel idle;
        idle.name = keys[i];
        idle.slots = {static_cast<int>(i)};
        mode.channels.push_back(idle);
      }
    return mode;
  }

 private:
  void define(const std::string& key, const Json& channel, const std::string& pixel) {
    definitions_.emplace(key, &channel);
    int byte = 0;
    for (const Json& alias : child(channel, "fineChannelAliases"))
      if (alias.is_string() && ++byte <= 3)
        fine_.emplace(
            pixel.empty() ? alias.get<std::string>() : replaced(alias.get<std::string>(), pixel),
            std::pair(key, byte));
    // A switching channel is what it stands for at the start.
    for (const auto& [alias, target] : starting_switches(channel).items())
      if (target.is_string()) switched_.emplace(alias, target.get<std::string>());
  }

  static const Json& starting_switches(const Json& channel) {
    for (const Json& capability : child(channel, "capabilities"))
      if (const Json& switches = child(capability, "switchChannels"); switches.is_object())
        return switches;
    static const Json kNone = Json::object();
    return kNone;
  }

  void list(const Json& item, std::vector<std::string>& keys) const {
    if (keys.size() >= 512) return;
    if (item.is_string()) {
      keys.push_back(item.get<std::string>());
    } else if (item.is_object() && text_in(item, "insert") == "matrixChannels") {
      insert(item, keys);
    } else {
      keys.emplace_back();  // null: a slot that nothing uses
    }
  }

  void insert(const Json& item, std::vector<std::string>& keys) const {
    std::vector<std::string> over;
    const Json& repeat = child(item, "repeatFor");
    if (repeat.is_array()) {
      for (const Json& name : repeat)
        if (name.is_string()) over.push_back(name.get<std::string>());
    } else if (text_in(item, "repeatFor") == "eachPixelGroup") {
      const Json& groups = child(child(root_, "matrix"), "pixelGroups");
      if (groups.is_object())
        for (const auto& [name, members] : groups.items()) over.push_back(name);
    } else {
      over = pixels_;
    }
    const Json& templates = child(item, "templateChannels");
    if (!templates.is_array()) return;
    const auto put = [&](const Json& name, const std::string& pixel) {
      if (keys.size() < 512)
        keys.push_back(name.is_string() ? replaced(name.get<std::string>(), pixel) : std::string());
    };
    if (text_in(item, "channelOrder") == "perChannel") {
      for (const Json& name : templates)
        for (const std::string& pixel : over) put(name, pixel);
    } else {
      for (const std::string& pixel : over)
        for (const Json& name : templates) put(name, pixel);
    }
  }

  void add(const std::string& key, std::size_t slot, const std::map<std::string, int>& slots,
           std::vector<bool>& used, LibraryMode& mode) {
    if (key.empty() || used[slot] || fine_.contains(key)) return;
    const auto alias = switched_.find(key);
    const auto found = definitions_.find(alias != switched_.end() ? alias->second : key);
    if (found == definitions_.end()) return;
    std::vector<int> at{static_cast<int>(slot)};
    for (int byte = 1; byte <= 2; ++byte)
      for (const auto& [name, coarse] : fine_)
        if (coarse.first == found->first && coarse.second == byte)
          if (const auto place = slots.find(name); place != slots.end())
            at.push_back(place->second);
    int finest = 1;
    for (const auto& [name, coarse] : fine_)
      if (coarse.first == found->first) finest = std::max(finest, coarse.second + 1);
    for (const int each : at) used[static_cast<std::size_t>(each)] = true;
    mode.channels.push_back(ofl_channel(key, *found->second, std::move(at), finest));
  }

  const Json& root_;
  std::vector<std::string> pixels_;
  std::map<std::string, const Json*> definitions_;
  std::map<std::string, std::pair<std::string, int>> fine_;  ///< alias: coarse channel, byte 1..3
  std::map<std::string, std::string> switched_;
};

void read_physical(const Json& physical, LibraryFixture& fixture) {
  const Json& bulb = child(physical, "bulb");
  if (const double lumens = number_at(bulb, "lumens", 1, 1e7); lumens > 0 && !fixture.lumens)
    fixture.lumens = lumens;
  if (const double cct = number_at(bulb, "colorTemperature", 1000, 25000); cct > 0 && !fixture.cct)
    fixture.cct = cct;
  if (const double watts = number_at(physical, "power", 1, 1e5); watts > 0 && !fixture.watts)
    fixture.watts = watts;
  const Json& lens = child(child(physical, "lens"), "degreesMinMax");
  if (lens.is_array() && lens.size() == 2 && lens[0].is_number() && lens[1].is_number() &&
      !fixture.beam) {
    const double a = lens[0].get<double>(), b = lens[1].get<double>();
    if (a >= 0.5 && b >= a && b <= 179)
      fixture.beam = core::Range{core::radians(a), core::radians(b)};
  }
  const Json& size = child(physical, "dimensions");
  if (size.is_array() && !size.empty() && size[0].is_number())
    fixture.widest = std::clamp(size[0].get<double>() / 1000, 0.0, 5.0);
}

/// Brackets alone show how deep a text is before a parser descends into it.
bool too_deep(const std::string& text) {
  std::size_t depth = 0;
  for (const char c : text) {
    if (c == '[' || c == '{') ++depth;
    if ((c == ']' || c == '}') && depth > 0) --depth;
    if (depth > kDeepest) return true;
  }
  return false;
}

core::Problem bad(const std::string& file, std::string what, std::string remedy) {
  return {{file, 0, 0}, std::move(what), std::move(remedy), false};
}

}  // namespace

core::Result<LibraryFixture> read_ofl(const std::string& text, const std::string& maker,
                                      const std::string& file) {
  if (text.size() > kMostBytes || too_deep(text))
    return bad(file, "this JSON is larger or deeper than any fixture", "is it the right file?");
  const Json root = Json::parse(text, nullptr, false);
  if (root.is_discarded())
    return bad(file, "this is not whole JSON", "was the file cut short? fetch it again");
  const bool channels =
      child(root, "availableChannels").is_object() || child(root, "templateChannels").is_object();
  if (!root.is_object() || !channels || !child(root, "modes").is_array())
    return bad(file, "this JSON is no fixture of the Open Fixture Library",
               "it holds availableChannels and modes");
  LibraryFixture fixture;
  fixture.model = text_in(root, "name");
  fixture.maker = text_in(root, "manufacturerName");
  if (fixture.maker.empty()) fixture.maker = text_in(root, "manufacturerKey");
  if (fixture.maker.empty()) fixture.maker = maker;
  const Json& categories = child(root, "categories");
  if (categories.is_array() && !categories.empty() && categories[0].is_string())
    fixture.kind = categories[0].get<std::string>();
  read_physical(child(root, "physical"), fixture);
  Reader reader(root);
  for (const Json& mode : child(root, "modes")) {
    if (fixture.modes.size() >= 64) break;
    if (!mode.is_object()) continue;
    fixture.modes.push_back(reader.mode(mode));
    read_physical(child(mode, "physical"), fixture);
  }
  return fixture;
}

}  // namespace chiaro::importers
