// SPDX-License-Identifier: Apache-2.0
#include "controller/importers/gdtf.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "controller/importers/gdtf_emitters.h"
#include "controller/importers/gdtf_value.h"
#include "controller/importers/xml.h"
#include "controller/importers/zip.h"

namespace chiaro::importers {
namespace {

using studio::Segment;

constexpr int kDeepest = 64;

struct Attribute {
  const char* name;
  Meaning meaning;
};
constexpr std::array kAttributes{Attribute{"Dimmer", Meaning::intensity},
                                 Attribute{"ColorAdd_R", Meaning::red},
                                 Attribute{"ColorAdd_G", Meaning::green},
                                 Attribute{"ColorAdd_B", Meaning::blue},
                                 Attribute{"ColorAdd_W", Meaning::white},
                                 Attribute{"ColorAdd_CW", Meaning::white},
                                 Attribute{"ColorAdd_WW", Meaning::warm_white},
                                 Attribute{"ColorAdd_RY", Meaning::amber},
                                 Attribute{"ColorAdd_GY", Meaning::lime},
                                 Attribute{"ColorAdd_C", Meaning::cyan},
                                 Attribute{"ColorAdd_GC", Meaning::cyan},
                                 Attribute{"ColorAdd_UV", Meaning::uv},
                                 Attribute{"ColorRGB_Red", Meaning::red},
                                 Attribute{"ColorRGB_Green", Meaning::green},
                                 Attribute{"ColorRGB_Blue", Meaning::blue},
                                 Attribute{"ColorSub_C", Meaning::cut_red},
                                 Attribute{"ColorSub_M", Meaning::cut_green},
                                 Attribute{"ColorSub_Y", Meaning::cut_blue},
                                 Attribute{"CTC", Meaning::cct},
                                 Attribute{"CTO", Meaning::cct},
                                 Attribute{"CTB", Meaning::cct},
                                 Attribute{"Tint", Meaning::tint},
                                 Attribute{"Pan", Meaning::pan},
                                 Attribute{"Tilt", Meaning::tilt},
                                 Attribute{"Zoom", Meaning::zoom},
                                 Attribute{"Shutter1", Meaning::shutter},
                                 Attribute{"StrobeFrequency", Meaning::unknown}};

/// Attributes are numbered where a lamp has several: Shutter2, ColorAdd_R.
Meaning meaning_of(const std::string& attribute) {
  for (const Attribute& each : kAttributes)
    if (attribute == each.name) return each.meaning;
  if (attribute.rfind("Shutter", 0) == 0 && attribute.find("Strobe") == std::string::npos)
    return Meaning::shutter;
  return Meaning::unknown;
}

/// The part of the geometry tree that a mode stands on: how often each geometry's channels are
/// there, and at which slots they start. References are followed; names alone prove nothing.
struct Instance {
  std::map<int, int> first_slot;  ///< by DMX break; 1-based
};
class Geometries {
 public:
  explicit Geometries(pugi::xml_node root) {
    for (const pugi::xml_node node : root.children())
      roots_.emplace(node.attribute("Name").as_string(), node);
  }

  /// Below the geometry of that name (a mode's), each geometry's name to its instances.
  std::map<std::string, std::vector<Instance>> below(const std::string& mode_geometry) const {
    std::map<std::string, std::vector<Instance>> found;
    const auto top = roots_.find(mode_geometry);
    visited_ = 0;
    if (top != roots_.end()) walk(top->second, Instance{{{1, 1}}}, 0, found);
    return found;
  }

  /// Every Beam below, for photometry.
  std::vector<pugi::xml_node> beams(const std::string& mode_geometry) const {
    std::vector<pugi::xml_node> found;
    const auto top = roots_.find(mode_geometry);
    visited_ = 0;
    if (top != roots_.end()) collect_beams(top->second, 0, found);
    return found;
  }

 private:
  void walk(pugi::xml_node node, const Instance& at, int depth,
            std::map<std::string, std::vector<Instance>>& found) const {
    if (depth > kDeepest || visited_++ > 20'000) return;
    auto& instances = found[node.attribute("Name").as_string()];
    if (instances.size() < 512) instances.push_back(at);
    for (const pugi::xml_node child : node.children()) {
      const std::string kind = child.name();
      if (kind == "Break") continue;
      if (kind == "GeometryReference") {
        Instance here;
        for (const pugi::xml_node part : child.children("Break"))
          here.first_slot[whole_in(part.attribute("DMXBreak").as_string(), 1, 64, 1)] =
              whole_in(part.attribute("DMXOffset").as_string(), 1, 512, 1);
        const auto target = roots_.find(child.attribute("Geometry").as_string());
        if (target != roots_.end()) walk(target->second, here, depth + 1, found);
      } else {
        walk(child, at, depth + 1, found);
      }
    }
  }

  void collect_beams(pugi::xml_node node, int depth, std::vector<pugi::xml_node>& found) const {
    if (depth > kDeepest || found.size() > 512 || visited_++ > 20'000) return;
    if (std::string_view(node.name()) == "Beam") found.push_back(node);
    for (const pugi::xml_node child : node.children()) {
      if (std::string_view(child.name()) == "GeometryReference") {
        const auto target = roots_.find(child.attribute("Geometry").as_string());
        if (target != roots_.end()) collect_beams(target->second, depth + 1, found);
      } else {
        collect_beams(child, depth + 1, found);
      }
    }
  }

  std::map<std::string, pugi::xml_node> roots_;
  mutable int visited_ = 0;  ///< by one walk: a tree of references can be exponentially large
};

/// One channel function with where it starts and ends.
struct Function {
  pugi::xml_node node;
  std::string attribute;
  std::uint32_t from = 0, to = 0;
  double physical_from = 0, physical_to = 1;
};

std::vector<Function> functions_of(pugi::xml_node channel, int bytes) {
  std::vector<Function> all;
  for (const pugi::xml_node logical : channel.children("LogicalChannel"))
    for (const pugi::xml_node node : logical.children("ChannelFunction")) {
      // A function that counts only while another channel stands somewhere is not ours to reach.
      if (all.size() >= 256 || (!all.empty() && node.attribute("ModeMaster"))) continue;
      Function f;
      f.node = node;
      f.attribute = node.attribute("Attribute").as_string();
      if (f.attribute.empty()) f.attribute = logical.attribute("Attribute").as_string();
      f.from = gdtf_value(node.attribute("DMXFrom").as_string("0/1"), bytes).value_or(0);
      f.physical_from = number_in(node.attribute("PhysicalFrom"), -1e6, 1e6, 0);
      f.physical_to = number_in(node.attribute("PhysicalTo"), -1e6, 1e6, 1);
      all.push_back(f);
    }
  std::stable_sort(all.begin(), all.end(),
                   [](const Function& a, const Function& b) { return a.from < b.from; });
  const std::uint32_t full = (1u << (8u * static_cast<unsigned>(bytes))) - 1;
  for (std::size_t i = 0; i < all.size(); ++i)
    all[i].to =
        i + 1 < all.size() ? std::max(all[i].from, all[i + 1].from - (all[i + 1].from > 0)) : full;
  return all;
}

double inside(Meaning meaning, double physical) {
  const bool angle =
      meaning == Meaning::pan || meaning == Meaning::tilt || meaning == Meaning::zoom;
  return angle ? core::radians(physical) : physical;
}

/// Whether the physical range can be believed: without kelvin in it a CTC is a share of a filter.
bool believable(Meaning meaning, const Function& f) {
  if (meaning == Meaning::cct)
    return std::min(f.physical_from, f.physical_to) >= 1000 &&
           std::max(f.physical_from, f.physical_to) <= 25000;
  if (meaning == Meaning::zoom)
    return std::min(f.physical_from, f.physical_to) >= 1 &&
           std::max(f.physical_from, f.physical_to) <= 170;
  if (meaning == Meaning::pan || meaning == Meaning::tilt)
    return f.physical_from != f.physical_to &&
           std::max(std::abs(f.physical_from), std::abs(f.physical_to)) <= 1440 &&
           std::abs(f.physical_to - f.physical_from) > 2;
  return true;
}

void add_segments(const std::vector<Function>& functions, Meaning meaning, double full,
                  LibraryChannel& channel) {
  for (const Function& f : functions) {
    Segment s{f.from / full, f.to / full, 0, 1, Segment::Law::continuous};
    if (!channel.segments.empty() && s.dmx_from <= channel.segments.back().dmx_to) continue;
    if (meaning_of(f.attribute) != meaning || !believable(meaning, f)) {
      s.law = Segment::Law::no_effect;
    } else if (meaning == Meaning::pan || meaning == Meaning::tilt || meaning == Meaning::zoom ||
               meaning == Meaning::cct) {
      s.physical_from = inside(meaning, f.physical_from);
      s.physical_to = inside(meaning, f.physical_to);
    } else {
      const bool falls = f.physical_to < f.physical_from;
      s.physical_from = falls ? 1 : 0;
      s.physical_to = falls ? 0 : 1;
      const bool cut = meaning == Meaning::cut_red || meaning == Meaning::cut_green ||
                       meaning == Meaning::cut_blue;
      if (cut) std::swap(s.physical_from, s.physical_to);
    }
    channel.segments.push_back(s);
  }
  const auto useful = [](const Segment& s) { return s.law == Segment::Law::continuous; };
  const auto first = std::find_if(channel.segments.begin(), channel.segments.end(), useful);
  if (first == channel.segments.end()) {
    channel.segments.clear();
    return;
  }
  // One law; a second stretch of the same attribute would give one wish two raw values.
  for (auto s = first + 1; s != channel.segments.end(); ++s) s->law = Segment::Law::no_effect;
}

/// Where a shutter stands open: a function or set that says so, else where it starts.
void add_shutter(const std::vector<Function>& functions, double full, LibraryChannel& channel) {
  for (const Function& f : functions) {
    const std::string words = lower(f.node.attribute("Name").as_string());
    const bool plain = f.attribute.find("Strobe") == std::string::npos;
    std::uint32_t from = f.from;
    for (const pugi::xml_node set : f.node.children("ChannelSet")) {
      const std::string name = lower(set.attribute("Name").as_string());
      const auto at =
          gdtf_value(set.attribute("DMXFrom").as_string(), static_cast<int>(channel.slots.size()));
      if (at) from = *at;
      if (name.find("open") != std::string::npos && !channel.lit) channel.lit = from / full;
      if (name.find("clos") != std::string::npos && !channel.closed) channel.closed = from / full;
    }
    if (plain && words.find("open") != std::string::npos && !channel.lit) channel.lit = f.to / full;
    if (plain && words.find("clos") != std::string::npos && !channel.closed)
      channel.closed = f.from / full;
  }
  // Without a name a plain shutter runs from closed to open.
  for (const Function& f : functions)
    if (!channel.lit && !channel.closed && f.attribute.find("Strobe") == std::string::npos &&
        f.physical_to > f.physical_from && f.to > f.from) {
      channel.lit = f.to / full;
      channel.closed = f.from / full;
    }
  if (channel.lit) channel.held = *channel.lit;
  if (!channel.lit) channel.closed.reset();
}

std::vector<int> offsets_of(pugi::xml_node channel) {
  std::vector<int> offsets;
  const std::string words = channel.attribute("Offset").as_string();
  for (std::size_t from = 0; from < words.size() && offsets.size() < 4;) {
    const std::size_t end = std::min(words.find(',', from), words.size());
    const int offset = whole_in(std::string_view(words).substr(from, end - from), 1, 512, 0);
    if (offset == 0) return {};  // "None": a virtual channel without slots
    offsets.push_back(offset);
    from = end + 1;
  }
  // Beyond 24 bit nothing we send is finer.
  if (offsets.size() > 3) offsets.resize(3);
  return offsets;
}

class ModeReader {
 public:
  ModeReader(pugi::xml_node mode, const Geometries& geometries, GdtfEmitters& emitters)
      : node_(mode),
        emitters_(emitters),
        instances_(geometries.below(mode.attribute("Geometry").as_string())) {}

  LibraryMode read() {
    LibraryMode mode;
    mode.name = node_.attribute("Name").as_string();
    for (const pugi::xml_node channel : node_.child("DMXChannels").children("DMXChannel"))
      if (mode.channels.size() < 1024) add(channel, mode);
    return mode;
  }

 private:
  void add(pugi::xml_node node, LibraryMode& mode) {
    const std::vector<int> offsets = offsets_of(node);
    if (offsets.empty()) return;
    const std::string geometry = node.attribute("Geometry").as_string();
    const std::string words = node.attribute("DMXBreak").as_string("1");
    const int dmx_break = whole_in(words, 1, 64, 1);
    const auto found = instances_.find(geometry);
    static const std::vector<Instance> kOnce{Instance{{{1, 1}}}};
    const auto& instances = found != instances_.end() ? found->second : kOnce;
    for (const Instance& instance : instances) {
      // "Overwrite": the reference's own break; only the first patch address is ours to give.
      const auto start =
          words == "Overwrite" ? instance.first_slot.begin() : instance.first_slot.find(dmx_break);
      const int first = start != instance.first_slot.end() ? start->second : 1;
      LibraryChannel channel = read_channel(node, geometry, static_cast<int>(offsets.size()));
      channel.slots.clear();
      for (const int offset : offsets) {
        channel.slots.push_back(first - 1 + offset - 1);
        mode.footprint = std::max(mode.footprint, channel.slots.back() + 1);
      }
      const bool beyond = std::any_of(channel.slots.begin(), channel.slots.end(), [&](int slot) {
        return slot >= 512 || !taken_.insert({slot, true}).second;
      });
      if (!beyond) mode.channels.push_back(std::move(channel));
    }
  }

  LibraryChannel read_channel(pugi::xml_node node, const std::string& geometry, int bytes) {
    LibraryChannel channel;
    const double full = std::exp2(8 * bytes) - 1;
    channel.slots.assign(static_cast<std::size_t>(bytes), 0);
    const std::vector<Function> functions = functions_of(node, bytes);
    for (const Function& f : functions)
      if (const Meaning m = meaning_of(f.attribute); m != Meaning::unknown) {
        channel.meaning = m;
        emitters_.note(m, f.node.attribute("Emitter").as_string());
        break;
      }
    channel.name = functions.empty() ? geometry : functions.front().attribute;
    if (!functions.empty())
      channel.held = gdtf_value(functions.front().node.attribute("Default").as_string("0/1"), bytes)
                         .value_or(0) /
                     full;
    if (channel.meaning == Meaning::shutter)
      add_shutter(functions, full, channel);
    else if (channel.meaning != Meaning::unknown)
      add_segments(functions, channel.meaning, full, channel);
    return channel;
  }

  pugi::xml_node node_;
  GdtfEmitters& emitters_;
  std::map<std::string, std::vector<Instance>> instances_;
  std::map<int, bool> taken_;
};

/// A lamp's beams together: the widest counts, light adds up. A value that equals the format's
/// default was most likely never set.
void read_beams(const std::vector<pugi::xml_node>& beams, LibraryFixture& fixture) {
  if (beams.empty()) return;
  double lumens = 0, beam = 0, field = 0, cct = 0;
  const auto first = beams.front();
  for (const pugi::xml_node node : beams) {
    lumens += number_in(node.attribute("LuminousFlux"), 0.1, 1e7, 10000);
    beam = std::max(beam, number_in(node.attribute("BeamAngle"), 0.5, 179, 25));
    field = std::max(field, number_in(node.attribute("FieldAngle"), 0.5, 179, 25));
    cct = number_in(node.attribute("ColorTemperature"), 1000, 25000, 6000);
  }
  fixture.lumens = lumens;
  fixture.beam = core::Range{core::radians(beam), core::radians(beam)};
  fixture.field = core::radians(std::max(beam, field));
  fixture.cct = cct;
  fixture.widest =
      std::max(fixture.widest, 2 * number_in(first.attribute("BeamRadius"), 0.001, 5, 0.05) + 0.1);
  const auto is_default = [&](const char* name, double value) {
    return number_in(first.attribute(name), -1e9, 1e9, value) == value;
  };
  if (is_default("LuminousFlux", 10000)) fixture.assumed.emplace_back("output");
  if (is_default("BeamAngle", 25)) fixture.assumed.emplace_back("beam");
  if (is_default("ColorTemperature", 6000)) fixture.assumed.emplace_back("cct");
}

}  // namespace

core::Result<LibraryFixture> read_gdtf_description(const std::string& xml,
                                                   const std::string& file) {
  pugi::xml_document document;
  if (const auto read = read_xml(xml, file, document); !read) return read.problems();
  const pugi::xml_node type = document.child("GDTF").child("FixtureType");
  if (!type)
    return core::Problem{{file, 0, 0},
                         "this description is not GDTF",
                         "description.xml holds <GDTF><FixtureType>",
                         false};
  LibraryFixture fixture;
  fixture.maker = type.attribute("Manufacturer").as_string();
  fixture.model = type.attribute("Name").as_string();
  if (fixture.model.empty()) fixture.model = type.attribute("LongName").as_string();
  const Geometries geometries(type.child("Geometries"));
  GdtfEmitters emitters(type.child("PhysicalDescriptions").child("Emitters"));
  for (const pugi::xml_node mode : type.child("DMXModes").children("DMXMode")) {
    if (fixture.modes.size() >= 64) break;
    if (fixture.modes.empty())
      read_beams(geometries.beams(mode.attribute("Geometry").as_string()), fixture);
    fixture.modes.push_back(ModeReader(mode, geometries, emitters).read());
  }
  fixture.primaries = emitters.primaries(fixture.shares_known);
  return fixture;
}

core::Result<LibraryFixture> read_gdtf(const std::string& bytes, const std::string& file) {
  if (const auto names = zip_names(bytes, file); !names) return names.problems();
  const auto xml = zip_member(bytes, "description.xml", kMostXmlBytes, file);
  if (!xml) return xml.problems();
  return read_gdtf_description(*xml, file + ":description.xml");
}

}  // namespace chiaro::importers
