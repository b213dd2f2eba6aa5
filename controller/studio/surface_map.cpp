// SPDX-License-Identifier: Apache-2.0
#include "controller/studio/surface_map.h"

#include <algorithm>

#include "controller/core/hash.h"
#include "controller/studio/reading/files.h"
#include "controller/studio/reading/scalars.h"
#include "controller/studio/reading/section.h"
#include "controller/studio/reading/text.h"
#include "controller/studio/surface_deeds.h"

namespace chiaro::studio {

using namespace reading;

namespace {

using Kind = SurfaceControl::Kind;
using Midi = SurfaceControl::Midi;

/// Each reads where a control is and gives the kind that it has unless its `kind` says otherwise.
Kind read_midi(Section& section, SurfaceControl& control, Report& report) {
  const Tree* note = section.find("note");
  const Tree* controller = section.find("controller");
  const Tree* bend = section.find("pitch_bend");
  const int found = (note != nullptr) + (controller != nullptr) + (bend != nullptr);
  if (found != 1 && section.valid())
    report.error(section.tree(), "a MIDI control is one kind of message",
                 "add note: 42, controller: 7 or pitch_bend: yes");
  control.midi = note != nullptr         ? Midi::note
                 : controller != nullptr ? Midi::controller
                 : bend != nullptr       ? Midi::pitch_bend
                                         : Midi::none;
  into(control.number, whole(note != nullptr ? note : controller, 0, 127, report));
  (void)yes_or_no(bend, report);
  std::int64_t channel = 1;
  into(channel, whole(section.find("channel"), 1, 16, report));
  control.channel = static_cast<int>(channel) - 1;
  return note != nullptr ? Kind::button : Kind::fader;
}

Kind read_hid(Section& section, const SurfaceMap& map, SurfaceControl& control, Report& report) {
  const Tree* byte = section.find("byte");
  const Tree* bit = section.find("bit");
  into(control.byte, whole(byte, 0, 63, report));
  into(control.bit, whole(bit, 0, 7, report));
  into(control.bytes, whole(section.find("bytes"), 1, 2, report));
  control.most = control.bytes == 2 ? 65535 : 255;
  into(control.most, whole(section.find("most"), 1, 65535, report));
  const Tree* lamp = section.find("lamp");
  if (lamp != nullptr) {
    Section where(*lamp, "a control's lamp", report);
    const Tree* at = where.need("byte", "1");
    into(control.lamp_byte, whole(at, 0, 63, report));
    into(control.lamp_bit, whole(where.find("bit"), 0, 7, report));
    where.refuse_unknown();
    if (at != nullptr && control.lamp_byte >= map.report_size)
      report.error(*at,
                   "the output report has " + std::to_string(map.report_size) +
                       " bytes, so there is no byte " + std::to_string(control.lamp_byte),
                   "set report: {size: …} to the whole length, its number included");
  }
  if (byte == nullptr && lamp == nullptr && section.valid())
    report.error(section.tree(), "where it stands in the device's reports is not said",
                 "add byte: 1, and for a button bit: 3; or lamp: {byte: 1, bit: 3}");
  return bit != nullptr || byte == nullptr ? Kind::button : Kind::fader;
}

Kind read_osc(Section& section, SurfaceControl& control, Report& report) {
  const Tree* address = section.need("osc", "/master/grand");
  into(control.osc, text(address, report));
  if (!control.osc.empty() &&
      (control.osc.front() != '/' || control.osc.find_first_of(" #*,?[]{}") != std::string::npos))
    report.error(*address, in_quotes(control.osc) + " is no OSC address",
                 "it begins with a slash and has no spaces or wildcards: /master/grand");
  const Tree* deed = section.find("do");
  const bool level = deed != nullptr && deed->kind == Tree::Kind::mapping &&
                     std::any_of(deed->keys.begin(), deed->keys.end(), [](const auto& key) {
                       return key.text == "master" || key.text == "level";
                     });
  return level ? Kind::fader : Kind::button;
}

Kind read_gpio(Section& section, SurfaceControl& control, Report& report) {
  into(control.line, whole(section.need("line", "17"), 0, 1023, report));
  into(control.chip, text(section.find("chip"), report));
  into(control.active_low, yes_or_no(section.find("active_low"), report));
  into(control.pull_up, yes_or_no(section.find("pull_up"), report));
  into(control.debounce_s,
       quantity(section.find("debounce"), Measure::duration, {0.001, 1}, report));
  control.output = section.find("do") == nullptr;
  return Kind::button;
}

SurfaceControl read_control(const Tree::Key& key, const Tree& tree, const SurfaceMap& map,
                            Report& report) {
  Section section(tree, "a control", report);
  SurfaceControl control;
  control.name = key.text;
  control.place = report.place(key);
  if (control.chip.empty()) control.chip = "gpiochip0";
  if (map.driver == "midi") control.kind = read_midi(section, control, report);
  if (map.driver == "hid") control.kind = read_hid(section, map, control, report);
  if (map.driver == "osc") control.kind = read_osc(section, control, report);
  if (map.driver == "gpio") control.kind = read_gpio(section, control, report);
  into(control.kind,
       choice<Kind>(section.find("kind"),
                    {{"button", Kind::button}, {"fader", Kind::fader}, {"encoder", Kind::encoder}},
                    report));
  control.deeds = read_deeds(section.find("do"), control.kind, report);
  control.shown = read_shown(section.find("shows"), control.deeds, report);
  section.refuse_unknown();
  if (section.valid() && !section.has("do") && !section.has("shows"))
    report.error(tree, in_quotes(control.name) + " neither does nor shows anything",
                 "add do: blackout, or shows: tally");
  return control;
}

void read_identity(Section& section, SurfaceMap& map, Report& report) {
  if (map.driver == "midi") into(map.midi_name, text(section.need("name", "nanoKONTROL2"), report));
  if (map.driver != "hid") return;
  if (const Tree* usb = section.need("usb", "\"1209:2882\"")) {
    const auto ids = text(usb, report);
    const auto hexadecimal = [](const std::string& word) {
      return word.size() == 4 &&
             word.find_first_not_of("0123456789abcdefABCDEF") == std::string::npos;
    };
    if (ids && ids->size() == 9 && (*ids)[4] == ':' && hexadecimal(ids->substr(0, 4)) &&
        hexadecimal(ids->substr(5))) {
      map.vendor = static_cast<std::uint16_t>(std::stoul(ids->substr(0, 4), nullptr, 16));
      map.product = static_cast<std::uint16_t>(std::stoul(ids->substr(5), nullptr, 16));
    } else if (ids) {
      report.error(*usb, in_quotes(*ids) + " are no USB ids",
                   "for example \"1209:2882\"; `lsusb` shows them");
    }
  }
  if (const Tree* lamps = section.find("report")) {
    Section about(*lamps, "the report that lights the lamps", report);
    into(map.report_size, whole(about.need("size", "9"), 1, 64, report));
    into(map.report_number, whole(about.find("number"), 0, 255, report));
    about.refuse_unknown();
  }
}

SurfaceMap read_map(const Tree& tree, const std::string& name, Report& report) {
  Section section(tree, "a surface map", report);
  SurfaceMap map;
  map.name = name;
  const Tree* own_name = section.need("surface", name);
  if (const auto stated = text(own_name, report); stated && *stated != name)
    report.error(*own_name,
                 "this map calls itself " + in_quotes(*stated) + ", its file is " + in_quotes(name),
                 "a map's name is its path below the surfaces folder");
  into(map.maker, text(section.need("maker", "Generic"), report));
  into(map.device, text(section.need("device", "what stands on its case"), report));
  (void)text(section.find("source"), report);
  const std::vector<std::string> drivers{"gpio", "hid", "midi", "osc"};
  if (const auto driver = word_among(section.need("driver", "midi"), drivers, report))
    map.driver = drivers[*driver];
  read_identity(section, map, report);
  const Tree* controls = section.need("controls", "{stop: {do: blackout on}}");
  // Without a driver nobody can tell what its controls may say.
  if (controls != nullptr && !map.driver.empty()) {
    Section list(*controls, "controls", report);
    for (std::size_t i = 0; list.valid() && i < controls->keys.size(); ++i)
      map.controls.push_back(read_control(controls->keys[i], controls->items[i], map, report));
  }
  if (!map.driver.empty()) section.refuse_unknown();
  return map;
}

/// Two controls that one movement would use: nearly always a slip of the pen.
void check_doubles(const SurfaceMap& map, Report& report) {
  const auto same = [](const SurfaceControl& a, const SurfaceControl& b) {
    if (a.midi != Midi::none)
      return a.midi == b.midi && a.channel == b.channel &&
             (a.midi == Midi::pitch_bend || a.number == b.number);
    if (!a.osc.empty()) return a.osc == b.osc;
    if (a.line >= 0) return a.line == b.line && a.chip == b.chip;
    return a.byte >= 0 && a.byte == b.byte &&
           (a.kind != Kind::button || b.kind != Kind::button || a.bit == b.bit);
  };
  for (std::size_t i = 0; i < map.controls.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (same(map.controls[i], map.controls[k]))
        report.add({map.controls[i].place,
                    in_quotes(map.controls[i].name) + " is the same control as " +
                        in_quotes(map.controls[k].name),
                    "give one control a list: do: [blackout on, motion stop]", false});
}

/// Names come from users and become paths: nothing may lead out of the folder.
bool is_map_name(const std::string& name) {
  return !name.empty() && name.size() < 200 && name.front() != '/' &&
         name.find("..") == std::string::npos &&
         name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-_/+.") == std::string::npos;
}

}  // namespace

const SurfaceControl* SurfaceMap::control(std::string_view control_name) const {
  for (const SurfaceControl& one : controls)
    if (one.name == control_name) return &one;
  return nullptr;
}

core::Result<SurfaceMap> parse_surface_map(const std::string& yaml, const std::string& name,
                                           const std::string& file) {
  const auto document = parse_tree(yaml, file);
  if (!document) return document.problems();
  Report report(file);
  report.add(document->problems);
  SurfaceMap map = read_map(document->root, name, report);
  check_doubles(map, report);
  if (report.any_error()) return report.sorted();
  map.fingerprint = core::Fingerprint().add(yaml).value();
  return map;
}

std::vector<std::string> surface_map_names(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  std::vector<std::string> names;
  std::error_code code;
  for (fs::recursive_directory_iterator entry(folder, code), end; !code && entry != end;
       entry.increment(code))
    if (entry->path().extension() == ".yaml")
      names.push_back(
          fs::relative(entry->path(), folder, code).replace_extension().generic_string());
  std::sort(names.begin(), names.end());
  return names;
}

core::Result<SurfaceMap> load_surface_map(const std::string& name, const std::filesystem::path& own,
                                          const std::filesystem::path& shipped) {
  std::error_code code;
  for (const auto& folder : {own, shipped}) {
    const auto file = folder / (name + ".yaml");
    if (!is_map_name(name) || !std::filesystem::is_regular_file(file, code)) continue;
    const auto yaml = read_text(file);
    if (!yaml) return yaml.problems();
    return parse_surface_map(*yaml, name, file.string());
  }
  return core::Problem{{},
                       "there is no surface map " + in_quotes(name),
                       suggestion(name, surface_map_names(shipped))};
}

}  // namespace chiaro::studio
