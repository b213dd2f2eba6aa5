// SPDX-License-Identifier: Apache-2.0
// The questions of `chiaro new`, in the order in which a person sets up a room: who sits there,
// the room, the camera, the wire, then lamp by lamp.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "controller/daemon/interview/answers.h"
#include "controller/daemon/interview/dialogue.h"
#include "controller/daemon/interview/learning.h"
#include "controller/daemon/interview/questions.h"
#include "controller/panel/gestures.h"
#include "controller/studio/reading/text.h"
#include "controller/studio/words.h"

namespace chiaro::daemon::interview {
namespace {

using studio::reading::in_quotes;
using studio::reading::Measure;
using studio::reading::written;

constexpr int kMostLamps = 100;
constexpr const char* kLearn = "learn";

void ask_subject(Dialogue& dialogue, const std::filesystem::path& base,
                 const studio::Folders& folders, Answers& answers) {
  const auto person_or_mesh = [&](const std::string& line) -> core::Result<std::string> {
    if (line == "person") return std::string();
    std::error_code code;
    for (const auto& folder : {base, folders.config})
      if (std::filesystem::is_regular_file(folder / line, code)) return line;
    // Typed from where the person is, read from where the file will be.
    if (std::filesystem::is_regular_file(line, code))
      return std::filesystem::absolute(line, code).string();
    return unclear("there is no file " + in_quotes(line), "answer 'person', or the path of a mesh");
  };
  answers.mesh = dialogue.ask<std::string>("Who or what is lit: person, or the path of a mesh",
                                           "person", person_or_mesh);
  if (answers.mesh.empty()) {
    answers.eye_height = dialogue.ask<double>("  Height of the sitter's eyes above the floor",
                                              "1.25 m", a_quantity(Measure::length, {0.3, 2.5}));
    return;
  }
  answers.height =
      dialogue.ask<double>("  How tall it is", "1 m", a_quantity(Measure::length, {0.01, 20}));
  answers.base = dialogue.ask<double>("  How high its base stands above the floor", "0 m",
                                      a_quantity(Measure::length, {0, 10}));
}

void ask_room(Dialogue& dialogue, Answers& answers) {
  answers.ceiling =
      dialogue.ask<double>("Height of the ceiling", "3 m",
                           a_quantity(Measure::length, {std::max(1.0, answers.aim_height()), 30}));
  const auto distance = a_quantity(Measure::length, {0.2, 50});
  answers.wall = dialogue.ask<std::optional<double>>(
      "Wall behind the sitter: its distance, or none", "2 m",
      [&](const std::string& line) -> core::Result<std::optional<double>> {
        if (line == "none") return std::optional<double>();
        const auto metres = distance(line);
        if (!metres) return metres.problems();
        return std::optional(*metres);
      });
}

void ask_camera(Dialogue& dialogue, Answers& answers) {
  answers.camera_distance = dialogue.ask<double>("Camera: its distance from the sitter", "2.6 m",
                                                 a_quantity(Measure::length, {0.3, 50}));
  answers.camera_height = dialogue.ask<double>("  its height above the floor",
                                               written(Measure::length, answers.aim_height()),
                                               a_quantity(Measure::length, {0.1, 10}));
  const double fov =
      dialogue.ask<double>("  its vertical angle of view (85 mm portrait lens: 16 deg)", "22 deg",
                           a_quantity(Measure::angle, {core::radians(2), core::radians(120)}));
  answers.camera_fov_deg = core::degrees(fov);
  answers.camera_source = dialogue.ask<std::string>(
      "  its picture: http://…, /dev/video0 or none", "none",
      [](const std::string& line) -> core::Result<std::string> {
        if (line == "none") return std::string();
        const auto text = a_line()(line);
        if (!text) return text;
        if ((line.rfind("http://", 0) == 0 && line.size() > 7) || line.rfind("/dev/", 0) == 0)
          return line;
        return unclear(in_quotes(line) + " is neither an http:// address nor a /dev/ device");
      });
  answers.grey_card_lux =
      dialogue.ask<double>("Light for a correct exposure (incident, lux)", "800 lx",
                           a_quantity(Measure::illuminance, {1, 1e5}));
  answers.white_balance_k = dialogue.ask<double>("White balance", "5600 K",
                                                 a_quantity(Measure::temperature, {2000, 12000}));
}

void ask_wire(Dialogue& dialogue, Answers& answers) {
  answers.interface = dialogue.ask<std::string>(
      "Network interface for sACN (eth0, lo, …), or none", "lo",
      [](const std::string& line) -> core::Result<std::string> {
        if (line == "none") return std::string();
        if (line.size() <= 15 && line.find(' ') == std::string::npos) return a_line()(line);
        return unclear(in_quotes(line) + " is not the name of a network interface",
                       "`ip link` lists them");
      });
}

struct Usual {
  const char *role, *profile, *place;
  Held held;
};
/// What most rooms have, in the order in which people name their lamps.
constexpr Usual kUsual[] = {
    {"key", "generic/bicolour-panel", "45 left, 35 up, 1.8 m", Held::stand},
    {"fill", "generic/bicolour-panel", "40 right, 10 up, 2 m", Held::stand},
    {"back", "generic/daylight-dimmer", "145 left, 30 up, 1.6 m", Held::hung},
    {"background", "generic/rgbw", "120 right, 20 down, 1.8 m", Held::hung},
};

std::optional<Lamp> overlapped(const std::vector<Lamp>& lamps, int universe, int first, int slots) {
  for (const Lamp& lamp : lamps)
    if (lamp.universe == universe && first < lamp.address + lamp.slots &&
        lamp.address < first + slots)
      return lamp;
  return std::nullopt;
}

int first_free(const std::vector<Lamp>& lamps, int universe, int slots) {
  for (int at = 1; at + slots - 1 <= 512; ++at)
    if (!overlapped(lamps, universe, at, slots)) return at;
  return 1;
}

void ask_profile(Dialogue& dialogue, const studio::Folders& folders, const Usual& usual,
                 Lamp& lamp) {
  const auto known = [&](const std::string& line) -> core::Result<studio::Profile> {
    if (line == kLearn) return studio::Profile{};
    auto profile = studio::load_profile(line, folders);
    if (profile) return profile;
    const core::Problem& first = profile.problems().front();
    return unclear(first.what, first.remedy);
  };
  const auto profile = dialogue.ask<studio::Profile>(
      "  Profile (`learn`: find out by raising its slots)", usual.profile, known);
  lamp.profile = profile.name;
  std::vector<std::string> modes;
  for (const studio::Mode& mode : profile.modes) modes.push_back(mode.name);
  if (modes.empty()) return;  // to be learned, or the input has ended
  lamp.mode = dialogue.ask<std::string>("  Mode: " + studio::reading::any_of(modes), modes.front(),
                                        one_of(modes));
  for (const studio::Mode& mode : profile.modes)
    if (mode.name == lamp.mode) lamp.slots = mode.footprint;
}

/// What `learn` needs before and after the patch is known.
void learn_lamp(Dialogue& dialogue, Wire& wire, Answers& answers, Lamp& lamp) {
  LearntLamp learnt = learn(
      dialogue, wire, {lamp.name, answers.interface, lamp.universe, lamp.address, lamp.slots});
  while (!dialogue.ended()) {
    const auto profile = profile_yaml(learnt);
    if (profile) break;
    dialogue.complain(profile.problems());
    learnt = learn(dialogue, wire,
                   {lamp.name, answers.interface, lamp.universe, lamp.address, lamp.slots});
  }
  lamp.profile = learnt.profile;
  lamp.mode = kLearntMode;
  answers.learnt.push_back(std::move(learnt));
}

void ask_patch(Dialogue& dialogue, const Answers& answers, Lamp& lamp) {
  const int last = answers.lamps.empty() ? 1 : answers.lamps.back().universe;
  lamp.universe = dialogue.ask<int>("  Universe", std::to_string(last), a_whole_number(1, 63999));
  const auto free_one = [&](const std::string& line) -> core::Result<int> {
    const auto address = a_whole_number(1, 512)(line);
    if (!address) return address;
    if (*address + lamp.slots - 1 > 512)
      return unclear("it needs " + std::to_string(lamp.slots) + " slots and would run past 512");
    if (const auto other = overlapped(answers.lamps, lamp.universe, *address, lamp.slots))
      return unclear(
          "that overlaps " + in_quotes(other->name) + " (" + std::to_string(other->address) +
              " to " + std::to_string(other->address + other->slots - 1) + ")",
          "address " + std::to_string(first_free(answers.lamps, lamp.universe, lamp.slots)) +
              " is free");
    return *address;
  };
  const int free = first_free(answers.lamps, lamp.universe, lamp.slots);
  lamp.address = dialogue.ask<int>("  Address", std::to_string(free), free_one);
}

/// What is wrong with a place in this room; empty when a lamp may be there.
std::string misplaced(const core::Spherical& place, const Answers& answers) {
  if (place.distance < 0.6) return "a lamp comes no nearer to a sitter than 0.6 m";
  const double height = core::position(answers.aim(), place).z;
  const auto metres = [](double m) { return written(Measure::length, std::round(m * 100) / 100); };
  if (height > answers.ceiling)
    return "there it would be " + metres(height) + " high, above the ceiling (" +
           metres(answers.ceiling) + ")";
  return height < 0.05 ? "there it would be below the floor" : "";
}

/// The usual place, brought down or up by five degrees until it is in the room.
std::string usual_place(const Usual& usual, const Answers& answers) {
  core::Spherical place = *studio::place_from_words(usual.place);
  const double step = core::radians(place.elevation > 0 ? -5 : 5);
  for (int i = 0; i < 20 && !misplaced(place, answers).empty(); ++i) place.elevation += step;
  return studio::place_in_words(place);
}

core::Spherical ask_where(Dialogue& dialogue, const Answers& answers, const std::string& question,
                          const std::string& otherwise) {
  const auto in_the_room = [&](const std::string& line) -> core::Result<core::Spherical> {
    const auto place = studio::place_from_words(line);
    if (!place) return place;
    const std::string why = misplaced(*place, answers);
    return why.empty() ? place : unclear(why);
  };
  return dialogue.ask<core::Spherical>(question, otherwise, in_the_room);
}

/// The slots of a motor count as the lamp's own from now on: no other lamp may have them.
void ask_motor(Dialogue& dialogue, const Answers& answers, Lamp& lamp) {
  lamp.motor.bytes = dialogue.ask<std::string>("  Its motor listens to 8 or 16 bits", "16",
                                               one_of({"8", "16"})) == "8"
                         ? 1
                         : 2;
  const auto free_one = [&](const std::string& line) -> core::Result<int> {
    const auto slot = a_whole_number(lamp.slots + 1, 512)(line);
    if (!slot) return slot;
    const int first = lamp.address + *slot - 1;
    if (first + lamp.motor.bytes - 1 > 512) return unclear("the motor's slots would run past 512");
    if (const auto other = overlapped(answers.lamps, lamp.universe, first, lamp.motor.bytes))
      return unclear("that slot belongs to " + in_quotes(other->name));
    return *slot;
  };
  lamp.motor.slot =
      dialogue.ask<int>("  The motor's first slot, counted from the lamp's first as 1",
                        std::to_string(lamp.slots + 1), free_one);
  lamp.slots = lamp.motor.slot + lamp.motor.bytes - 1;
}

void ask_track(Dialogue& dialogue, const Answers& answers, const Usual& usual, Lamp& lamp) {
  lamp.place = ask_where(dialogue, answers, "  One end of its track, seen from the sitter",
                         usual_place(usual, answers));
  core::Spherical mirrored = lamp.place;
  mirrored.azimuth = -mirrored.azimuth;
  while (!dialogue.ended()) {
    lamp.motor.far_end = ask_where(dialogue, answers, "  The other end of its track",
                                   studio::place_in_words(mirrored));
    if (core::distance(core::position(answers.aim(), lamp.place),
                       core::position(answers.aim(), lamp.motor.far_end)) > 0.1)
      break;
    dialogue.complain({unclear("both ends are in the same place")});
    mirrored.azimuth += core::radians(90);
  }
  lamp.motor.along =
      dialogue.ask<int>("  How far along it hangs now, in per cent", "50", a_whole_number(0, 100)) /
      100.0;
}

void ask_place(Dialogue& dialogue, const Answers& answers, const Usual& usual, Lamp& lamp) {
  const std::vector<std::string> ways(std::begin(panel::kHeldBy), std::end(panel::kHeldBy));
  const auto held =
      dialogue.ask<std::string>("  How it is held: " + studio::reading::any_of(ways),
                                panel::kHeldBy[static_cast<std::size_t>(usual.held)], one_of(ways));
  lamp.held = static_cast<Held>(std::find(ways.begin(), ways.end(), held) - ways.begin());
  if (lamp.held == Held::track) {
    ask_track(dialogue, answers, usual, lamp);
    return ask_motor(dialogue, answers, lamp);
  }
  lamp.place = ask_where(dialogue, answers, "  Where it is, seen from the sitter",
                         usual_place(usual, answers));
  if (lamp.held != Held::arc) return;
  lamp.motor.over = dialogue.ask<std::string>("  The arc goes round or over the sitter", "round",
                                              one_of({"round", "over"})) == "over";
  lamp.motor.travel =
      dialogue.ask<double>("  How far it may travel from there, each way", "60 deg",
                           a_quantity(Measure::angle, {core::radians(1), core::kPi}));
  ask_motor(dialogue, answers, lamp);
}

Lamp ask_lamp(Dialogue& dialogue, const studio::Folders& folders, Answers& answers, Wire& wire,
              std::size_t index) {
  const Usual& usual = kUsual[std::min(index, std::size(kUsual) - 1)];
  std::vector<std::string> taken;
  for (const Lamp& lamp : answers.lamps) taken.push_back(lamp.name);
  const bool name_free = std::find(taken.begin(), taken.end(), usual.role) == taken.end();
  const std::string name = name_free ? usual.role : "lamp " + std::to_string(index + 1);
  Lamp lamp;
  lamp.name = dialogue.ask<std::string>("Lamp " + std::to_string(index + 1) + ": its name", name,
                                        a_name(taken));
  const std::vector<std::string> roles{"key",    "fill",       "back",     "hair",
                                       "kicker", "background", "practical"};
  const bool role_name = std::find(roles.begin(), roles.end(), lamp.name) != roles.end();
  lamp.role =
      dialogue.ask<std::string>("  Role", role_name ? lamp.name : usual.role, one_of(roles));
  const auto by_role = std::find_if(std::begin(kUsual), std::end(kUsual),
                                    [&](const Usual& each) { return each.role == lamp.role; });
  const Usual& defaults = by_role == std::end(kUsual) ? usual : *by_role;
  ask_profile(dialogue, folders, defaults, lamp);
  const bool unknown = lamp.profile.empty();
  if (unknown)
    lamp.slots = dialogue.ask<int>("  How many slots it listens to", "4", a_whole_number(1, 32));
  ask_patch(dialogue, answers, lamp);
  if (unknown) learn_lamp(dialogue, wire, answers, lamp);
  ask_place(dialogue, answers, defaults, lamp);
  return lamp;
}

}  // namespace

std::optional<Answers> interview(Dialogue& dialogue, const std::filesystem::path& base,
                                 const studio::Folders& folders, Wire& wire) {
  Answers answers;
  dialogue.say("A few questions about your studio. Enter alone takes the answer in [brackets].");
  answers.studio = dialogue.ask<std::string>("Name of the studio", "my studio", a_line());
  ask_subject(dialogue, base, folders, answers);
  ask_room(dialogue, answers);
  ask_camera(dialogue, answers);
  ask_wire(dialogue, answers);
  const int count = dialogue.ask<int>("How many lamps", "3", a_whole_number(1, kMostLamps));
  for (int i = 0; i < count && !dialogue.ended(); ++i)
    answers.lamps.push_back(
        ask_lamp(dialogue, folders, answers, wire, static_cast<std::size_t>(i)));
  return dialogue.ended() ? std::nullopt : std::optional(answers);
}

}  // namespace chiaro::daemon::interview
