// SPDX-License-Identifier: Apache-2.0
#include "controller/importers/qxf.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "controller/importers/capability.h"
#include "controller/importers/xml.h"

namespace chiaro::importers {
namespace {

constexpr double kFull = 255;  // ranges are of the coarse byte

/// A channel as the file defines it once for all its modes.
struct Definition {
  LibraryChannel channel;
  bool fine = false;
};

struct Preset {
  const char* name;
  Meaning meaning;
};
constexpr std::array kPresets{
    Preset{"IntensityMasterDimmer", Meaning::master},
    Preset{"IntensityDimmer", Meaning::intensity},
    Preset{"IntensityRed", Meaning::red},
    Preset{"IntensityGreen", Meaning::green},
    Preset{"IntensityBlue", Meaning::blue},
    Preset{"IntensityWhite", Meaning::white},
    Preset{"IntensityAmber", Meaning::amber},
    Preset{"IntensityLime", Meaning::lime},
    Preset{"IntensityUV", Meaning::uv},
    Preset{"IntensityCyan", Meaning::cut_red},
    Preset{"IntensityMagenta", Meaning::cut_green},
    Preset{"IntensityYellow", Meaning::cut_blue},
    // Of a lamp that is told hue and saturation, the value dims and no saturation is white.
    Preset{"IntensityValue", Meaning::intensity},
    Preset{"IntensityLightness", Meaning::intensity},
    Preset{"PositionPan", Meaning::pan},
    Preset{"PositionTilt", Meaning::tilt},
    Preset{"PositionXAxis", Meaning::pan},
    Preset{"PositionYAxis", Meaning::tilt},
    Preset{"BeamZoomSmallBig", Meaning::zoom},
    Preset{"BeamZoomBigSmall", Meaning::zoom},
    Preset{"BeamZoom", Meaning::zoom},
    Preset{"ShutterStrobeSlowFast", Meaning::shutter},
    Preset{"ShutterStrobeFastSlow", Meaning::shutter},
};

std::vector<Capability> capabilities_of(pugi::xml_node node) {
  std::vector<Capability> all;
  for (const pugi::xml_node item : node.children("Capability")) {
    Capability c;
    c.from = whole_in(item.attribute("Min").as_string(), 0, 255, -1);
    c.to = whole_in(item.attribute("Max").as_string(), 0, 255, -1);
    if (c.from < 0 || c.to < c.from || all.size() >= 256) continue;
    c.words = lower(item.child_value());
    const std::string preset = item.attribute("Preset").as_string();
    c.open = preset == "ShutterOpen";
    c.closed = preset == "ShutterClose";
    // A colour wheel's open place, and a colour that is none.
    const std::string shown = lower(item.attribute("Res1").as_string());
    if (preset == "ColorMacro" && shown == "#ffffff") c.open = true;
    if (preset == "ColorMacro" && shown == "#000000") c.closed = true;
    all.push_back(std::move(c));
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.from < b.from; });
  return all;
}

Meaning colour_meaning(const std::string& colour, const std::string& name) {
  if (colour == "Red") return Meaning::red;
  if (colour == "Green") return Meaning::green;
  if (colour == "Blue") return Meaning::blue;
  if (colour == "White")
    return meaning_of_name(name) == Meaning::warm_white ? Meaning::warm_white : Meaning::white;
  if (colour == "Amber") return Meaning::amber;
  if (colour == "Lime") return Meaning::lime;
  if (colour == "Cyan") return Meaning::cut_red;
  if (colour == "Magenta") return Meaning::cut_green;
  if (colour == "Yellow") return Meaning::cut_blue;
  return Meaning::unknown;
}

Meaning group_meaning(const std::string& group, const std::string& colour, const std::string& name,
                      const std::vector<Capability>& capabilities) {
  if (group == "Pan") return Meaning::pan;
  if (group == "Tilt") return Meaning::tilt;
  if (group == "Shutter")
    return dimmer_law(capabilities, kFull).empty() ? Meaning::shutter : Meaning::intensity;
  if (group == "Intensity") {
    if (const Meaning m = colour_meaning(colour, name); m != Meaning::unknown) return m;
    const Meaning m = meaning_of_name(name);
    if (m != Meaning::unknown) return m;
    return mentions(name, {"strob", "shutter"}) && dimmer_law(capabilities, kFull).empty()
               ? Meaning::shutter
               : Meaning::intensity;
  }
  // Groups are a hint: a channel that is called just "Red" is one wherever it was filed.
  const Meaning m = meaning_of_name(name);
  const bool plain = capabilities.size() <= 1;
  if (m == Meaning::cct || m == Meaning::zoom) return m;
  if (group == "Colour" && plain) return m;
  if (group != "Effect" || capabilities.empty()) return Meaning::unknown;
  if (mentions(name, {"shutter", "strob"})) return Meaning::shutter;
  return m == Meaning::intensity && !dimmer_law(capabilities, kFull).empty() ? m : Meaning::unknown;
}

void add_kelvins(const std::vector<Capability>& capabilities, LibraryChannel& channel) {
  for (const Capability& c : capabilities)
    if (const auto kelvins = kelvins_in(c.words); kelvins && c.to > c.from) {
      channel.segments = {{c.from / kFull, c.to / kFull, kelvins->least, kelvins->most,
                           studio::Segment::Law::continuous}};
      return;
    }
}

/// Lasers and strobes count in plain words; a law that is no dimmer's is held at open instead.
void add_law(const std::vector<Capability>& capabilities, LibraryChannel& channel) {
  switch (channel.meaning) {
    case Meaning::master:
    case Meaning::intensity:
      channel.segments = dimmer_law(capabilities, kFull);
      break;
    case Meaning::cct:
      add_kelvins(capabilities, channel);
      channel.held = idle(capabilities, kFull);
      break;
    case Meaning::shutter: {
      const Shutter law = shutter_law(capabilities, kFull);
      channel.held = law.open;
      channel.closed = law.closed;
      channel.lit = law.lit;
      break;
    }
    case Meaning::unknown: {
      channel.held = idle(capabilities, kFull);
      if (!mentions(lower(channel.name),
                    {"lamp", "laser", "led", "colo", "light", "shutter", "dimmer", "pod", "lens",
                     "rgb", "white", "cluster", "head", "gobo"}))
        break;
      const Shutter law = shutter_law(capabilities, kFull);
      channel.closed = law.closed;
      channel.lit = law.lit;
      break;
    }
    default:
      break;
  }
}

Definition definition_of(pugi::xml_node node) {
  Definition out;
  out.channel.name = node.attribute("Name").as_string();
  const std::string name = lower(out.channel.name);
  std::string preset = node.attribute("Preset").as_string();
  const auto capabilities = capabilities_of(node);
  if (!preset.empty()) {
    if (preset.size() > 4 && preset.compare(preset.size() - 4, 4, "Fine") == 0) {
      out.fine = true;
      preset.resize(preset.size() - 4);
    }
    for (const Preset& each : kPresets)
      if (preset == each.name) out.channel.meaning = each.meaning;
    out.channel.backwards = preset == "BeamZoomBigSmall";
    if (out.channel.meaning == Meaning::white && meaning_of_name(name) == Meaning::warm_white)
      out.channel.meaning = Meaning::warm_white;
  } else {
    const pugi::xml_node group = node.child("Group");
    out.fine = group.attribute("Byte").as_int() == 1;
    out.channel.meaning =
        group_meaning(group.child_value(), node.child_value("Colour"), name, capabilities);
  }
  add_law(capabilities, out.channel);
  const int at_start = whole_in(node.attribute("Default").as_string(), 0, 255, -1);
  if (at_start >= 0 && out.channel.meaning == Meaning::unknown) out.channel.held = at_start / kFull;
  return out;
}

/// "Pan fine" without its last word and its numbers' spaces: for finding the coarse one.
std::string stem(const std::string& name) {
  std::string words = lower(name);
  for (const char* each :
       {"fine", "16bit", "16 bit", "16-bit", "lsb", "low", "coarse", "msb", "high"})
    for (std::size_t at; (at = words.find(each)) != std::string::npos;)
      words.erase(at, std::string_view(each).size());
  words.erase(
      std::remove_if(words.begin(), words.end(),
                     [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }),
      words.end());
  return words;
}

/// The coarse channel that a fine one at `slot` completes: of the same meaning, still without a
/// fine byte; of the same stem if there is one, else the last before it, else any.
LibraryChannel* coarse_for(const Definition& fine, std::vector<LibraryChannel>& channels) {
  LibraryChannel* best = nullptr;
  for (LibraryChannel& c : channels) {
    if (c.meaning != fine.channel.meaning || c.meaning == Meaning::unknown || c.slots.size() > 1)
      continue;
    if (stem(c.name) == stem(fine.channel.name)) return &c;
    best = &c;
  }
  return best;
}

/// Ranges counted in the coarse byte, as fractions of the 16 bit value.
void widen(LibraryChannel& channel) {
  for (studio::Segment& s : channel.segments) {
    s.dmx_from = s.dmx_from * 255 * 256 / 65535;
    s.dmx_to = (s.dmx_to * 255 * 256 + 255) / 65535;
  }
}

LibraryMode mode_of(pugi::xml_node node, const std::map<std::string, Definition>& definitions) {
  LibraryMode mode;
  mode.name = node.attribute("Name").as_string();
  std::vector<std::pair<int, const Definition*>> fines;
  for (const pugi::xml_node item : node.children("Channel")) {
    const int slot = whole_in(item.attribute("Number").as_string(), 0, 511, -1);
    const auto found = definitions.find(item.child_value());
    if (slot < 0 || found == definitions.end()) continue;
    mode.footprint = std::max(mode.footprint, slot + 1);
    if (found->second.fine) {
      fines.emplace_back(slot, &found->second);
      continue;
    }
    mode.channels.push_back(found->second.channel);
    mode.channels.back().slots = {slot};
  }
  for (const auto& [slot, fine] : fines) {
    if (LibraryChannel* coarse = coarse_for(*fine, mode.channels)) {
      coarse->slots.push_back(slot);
      widen(*coarse);
    } else {
      LibraryChannel alone = fine->channel;
      alone.meaning = Meaning::unknown;
      alone.held = 0;
      alone.slots = {slot};
      mode.channels.push_back(std::move(alone));
    }
  }
  return mode;
}

/// The physical facts; the first mode that states them counts for the lamp.
void read_physical(pugi::xml_node physical, LibraryFixture& fixture) {
  const auto bulb = physical.child("Bulb");
  const double lumens = number_in(bulb.attribute("Lumens"), 1, 1e7, 0);
  const double cct = number_in(bulb.attribute("ColourTemperature"), 1000, 25000, 0);
  const auto lens = physical.child("Lens");
  const double least = number_in(lens.attribute("DegreesMin"), 0.5, 179, 0);
  const double most = number_in(lens.attribute("DegreesMax"), 0.5, 179, 0);
  const auto focus = physical.child("Focus");
  const auto size = physical.child("Dimensions");
  const double watts =
      number_in(physical.child("Technical").attribute("PowerConsumption"), 1, 1e5, 0);
  if (lumens > 0 && !fixture.lumens) fixture.lumens = lumens;
  if (cct > 0 && !fixture.cct) fixture.cct = cct;
  if (watts > 0 && !fixture.watts) fixture.watts = watts;
  if ((least > 0 || most > 0) && !fixture.beam) {
    const double a = least > 0 ? least : most, b = most > 0 ? most : least;
    fixture.beam = core::Range{core::radians(std::min(a, b)), core::radians(std::max(a, b))};
  }
  fixture.pan_turn =
      std::max(fixture.pan_turn, core::radians(number_in(focus.attribute("PanMax"), 0, 1440, 0)));
  fixture.tilt_turn =
      std::max(fixture.tilt_turn, core::radians(number_in(focus.attribute("TiltMax"), 0, 1440, 0)));
  fixture.widest = std::max(fixture.widest, number_in(size.attribute("Width"), 0, 5000, 0) / 1000);
}

}  // namespace

core::Result<LibraryFixture> read_qxf(const std::string& text, const std::string& file) {
  pugi::xml_document document;
  if (const auto read = read_xml(text, file, document); !read) return read.problems();
  const pugi::xml_node root = document.child("FixtureDefinition");
  if (!root)
    return core::Problem{{file, 0, 0},
                         "this is no QLC+ fixture definition",
                         "a .qxf file holds <FixtureDefinition>",
                         false};
  LibraryFixture fixture;
  fixture.maker = root.child_value("Manufacturer");
  fixture.model = root.child_value("Model");
  fixture.kind = root.child_value("Type");
  std::map<std::string, Definition> definitions;
  for (const pugi::xml_node node : root.children("Channel"))
    definitions.emplace(node.attribute("Name").as_string(), definition_of(node));
  read_physical(root.child("Physical"), fixture);
  for (const pugi::xml_node node : root.children("Mode")) {
    if (fixture.modes.size() >= 64) break;
    fixture.modes.push_back(mode_of(node, definitions));
    read_physical(node.child("Physical"), fixture);
  }
  // Fog is not light, however it is dimmed.
  const bool fog = fixture.kind == "Smoke" || fixture.kind == "Hazer" || fixture.kind == "Fan";
  if (fog)
    for (LibraryMode& mode : fixture.modes)
      for (LibraryChannel& channel : mode.channels)
        if (channel.meaning == Meaning::intensity || channel.meaning == Meaning::master)
          channel.meaning = Meaning::unknown;
  return fixture;
}

}  // namespace chiaro::importers
