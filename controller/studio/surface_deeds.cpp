// SPDX-License-Identifier: Apache-2.0
#include "controller/studio/surface_deeds.h"

#include <algorithm>
#include <array>

#include "controller/studio/reading/scalars.h"
#include "controller/studio/reading/section.h"
#include "controller/studio/reading/text.h"

namespace chiaro::studio {

using namespace reading;

namespace {

using Kind = SurfaceControl::Kind;

constexpr std::array<std::string_view, 5> kMasters{"grand", "key", "fill", "back", "background"};
constexpr std::array<const char*, 4> kNudges{"brighter", "softer", "warmer", "contrast"};
constexpr std::array<const char*, 5> kMarks{"highlight", "flash", "solo", "park", "move in black"};

struct Bare {
  const char* word;
  Deed::Kind kind;
  Deed::Press press;
};
constexpr Bare kBare[] = {{"blackout", Deed::Kind::blackout, Deed::Press::toggle},
                          {"blackout on", Deed::Kind::blackout, Deed::Press::on},
                          {"blackout off", Deed::Kind::blackout, Deed::Press::off},
                          {"motion stop", Deed::Kind::motion_stop, Deed::Press::on},
                          {"motion release", Deed::Kind::motion_stop, Deed::Press::off},
                          {"motion arm", Deed::Kind::motion_arm, Deed::Press::on},
                          {"motion disarm", Deed::Kind::motion_arm, Deed::Press::off},
                          {"blind", Deed::Kind::blind, Deed::Press::toggle},
                          {"cue go", Deed::Kind::cue_go, Deed::Press::on},
                          {"cue back", Deed::Kind::cue_back, Deed::Press::on},
                          {"cue off", Deed::Kind::cue_off, Deed::Press::on}};

std::optional<int> master_in(const Tree* tree, Report& report) {
  std::vector<std::string> words(kMasters.begin(), kMasters.end());
  const auto index = word_among(tree, words, report);
  return index ? std::optional<int>(static_cast<int>(*index)) : std::nullopt;
}

bool takes_a_level(const Deed& deed) {
  return deed.kind == Deed::Kind::master || deed.kind == Deed::Kind::level;
}

/// A fader cannot be pressed, and a button stands nowhere between off and full.
void check_fits(const Tree& tree, const Deed& deed, Kind kind, Report& report) {
  if (takes_a_level(deed) && kind == Kind::button)
    report.error(tree, "a button cannot set the " + in_words(deed),
                 "use a fader or an encoder (kind: fader)");
  if (!takes_a_level(deed) && kind == Kind::fader)
    report.error(tree, "a fader cannot ask for '" + in_words(deed) + "'",
                 "use a button (kind: button), or give it a master or a lamp's level");
  if (kind == Kind::encoder && !takes_a_level(deed) && deed.kind != Deed::Kind::nudge)
    report.error(tree, "an encoder cannot ask for '" + in_words(deed) + "'",
                 "use a button (kind: button), or give it a master, a level or a nudge");
}

/// The one key of those below that a mapping has, and what it says.
struct Named {
  Deed::Kind kind;
  std::string key;
  const Tree* value;
};
std::vector<Named> named_in(Section& section) {
  std::vector<Named> found;
  const auto look_for = [&](const char* key, Deed::Kind kind) {
    if (const Tree* value = section.find(key)) found.push_back({kind, key, value});
  };
  look_for("master", Deed::Kind::master);
  look_for("level", Deed::Kind::level);
  look_for("release", Deed::Kind::release);
  look_for("cue", Deed::Kind::cue_to);
  look_for("look", Deed::Kind::look);
  look_for("mood", Deed::Kind::mood);
  for (const char* mark : kMarks) look_for(mark, Deed::Kind::mark);
  for (const char* nudge : kNudges) look_for(nudge, Deed::Kind::nudge);
  return found;
}

/// `all` for every lamp.
bool read_lamp(const Tree* tree, std::string& lamp, Report& report) {
  const auto word = text(tree, report);
  if (word) lamp = *word == "all" ? "*" : *word;
  return word.has_value();
}

bool read_value(const Named& named, Deed& deed, Report& report) {
  switch (named.kind) {
    case Deed::Kind::master: {
      const auto index = master_in(named.value, report);
      into(deed.master, index);
      return index.has_value();
    }
    case Deed::Kind::cue_to: {
      const auto cue = number(named.value, {0, 9999}, report);
      into(deed.amount, cue);
      return cue.has_value();
    }
    case Deed::Kind::nudge: {
      deed.name = named.key;
      const auto stops = quantity(named.value, Measure::stops, {-2, 2}, report);
      into(deed.amount, stops);
      return stops.has_value();
    }
    case Deed::Kind::mark:
      deed.name = named.key;
      deed.press = named.key == "flash" ? Deed::Press::follow : Deed::Press::toggle;
      return read_lamp(named.value, deed.lamp, report);
    case Deed::Kind::look:
    case Deed::Kind::mood: {
      const auto word = text(named.value, report);
      into(deed.name, word);
      return word.has_value();
    }
    default:
      return read_lamp(named.value, deed.lamp, report);
  }
}

/// of: cct - another control of the lamp than its level.
void read_dof(const Tree* tree, core::Dof& dof, Report& report) {
  std::vector<std::pair<std::string, core::Dof>> known;
  for (const core::DofInfo& each : core::dofs()) known.emplace_back(each.name, each.dof);
  into(dof, choice<core::Dof>(tree, known, report));
}

std::optional<Deed> read_named(const Tree& tree, Report& report) {
  Section section(tree, "what a control does", report);
  Deed deed;
  deed.place = report.place(tree);
  const auto found = named_in(section);
  bool good = found.size() == 1;
  if (good) {
    deed.kind = found[0].kind;
    good = read_value(found[0], deed, report);
    if (takes_a_level(deed)) into(deed.step, fraction(section.find("step"), report));
    if (deed.kind == Deed::Kind::level) read_dof(section.find("of"), deed.dof, report);
    if (deed.kind == Deed::Kind::mark)
      into(deed.press, choice<Deed::Press>(section.find("press"),
                                           {{"toggle", Deed::Press::toggle},
                                            {"on", Deed::Press::on},
                                            {"off", Deed::Press::off},
                                            {"held", Deed::Press::follow}},
                                           report));
  } else if (section.valid()) {
    report.error(tree,
                 found.empty() ? "nothing is said that it does" : "it does two things at once",
                 "for example {master: grand}; several things are a list: [blackout on, motion "
                 "stop]");
  }
  section.refuse_unknown();
  return good ? std::optional(deed) : std::nullopt;
}

std::optional<Deed> read_bare(const Tree& tree, Report& report) {
  std::vector<std::string> words;
  for (const Bare& bare : kBare) words.emplace_back(bare.word);
  const auto index = word_among(&tree, words, report);
  if (!index) return std::nullopt;
  Deed deed;
  deed.kind = kBare[*index].kind;
  deed.press = kBare[*index].press;
  deed.place = report.place(tree);
  return deed;
}

}  // namespace

std::string_view master_name(int master) { return kMasters.at(static_cast<std::size_t>(master)); }

std::vector<Deed> read_deeds(const Tree* tree, Kind kind, Report& report) {
  std::vector<Deed> deeds;
  if (tree == nullptr) return deeds;
  if (tree->kind == Tree::Kind::sequence) {
    for (const Tree& one : tree->items)
      for (Deed& deed : read_deeds(&one, kind, report)) deeds.push_back(std::move(deed));
    return deeds;
  }
  const auto deed =
      tree->kind == Tree::Kind::mapping ? read_named(*tree, report) : read_bare(*tree, report);
  if (!deed) return deeds;
  check_fits(*tree, *deed, kind, report);
  deeds.push_back(*deed);
  return deeds;
}

namespace {

Shown::Kind kind_for(const Deed& deed) {
  switch (deed.kind) {
    case Deed::Kind::blackout:
      return Shown::Kind::blackout;
    case Deed::Kind::motion_stop:
      return Shown::Kind::motion_stop;
    case Deed::Kind::motion_arm:
      return Shown::Kind::motion_arm;
    case Deed::Kind::mark:
      return Shown::Kind::mark;
    case Deed::Kind::cue_go:
    case Deed::Kind::cue_back:
    case Deed::Kind::cue_off:
    case Deed::Kind::cue_to:
      return Shown::Kind::cue;
    case Deed::Kind::master:
      return Shown::Kind::master;
    case Deed::Kind::level:
      return Shown::Kind::level;
    default:
      return Shown::Kind::nothing;
  }
}

Shown shown_for(const Deed& deed) {
  Shown shown;
  shown.kind = kind_for(deed);
  shown.name = deed.name;
  shown.lamp = deed.lamp;
  shown.dof = deed.dof;
  shown.master = deed.master;
  if (deed.kind == Deed::Kind::cue_to) shown.cue = deed.amount;
  shown.place = deed.place;
  return shown;
}

/// {master: grand}, {level: key} or {lit: key}.
void read_named_shown(const Tree& tree, Shown& shown, Report& report) {
  Section section(tree, "what a control shows", report);
  const Tree* master = section.find("master");
  const Tree* level = section.find("level");
  const Tree* lit = section.find("lit");
  if ((master != nullptr) + (level != nullptr) + (lit != nullptr) != 1 && section.valid())
    report.error(tree, "it must show one thing",
                 "for example {master: grand}, {level: key} or {lit: key}");
  if (master != nullptr) {
    shown.kind = Shown::Kind::master;
    into(shown.master, master_in(master, report));
  } else if (level != nullptr || lit != nullptr) {
    shown.kind = level != nullptr ? Shown::Kind::level : Shown::Kind::lit;
    (void)read_lamp(level != nullptr ? level : lit, shown.lamp, report);
  }
  section.refuse_unknown();
}

}  // namespace

Shown read_shown(const Tree* tree, const std::vector<Deed>& deeds, Report& report) {
  if (tree == nullptr) return deeds.empty() ? Shown{} : shown_for(deeds.front());
  Shown shown;
  shown.place = report.place(*tree);
  if (tree->kind == Tree::Kind::mapping) {
    read_named_shown(*tree, shown, report);
  } else {
    into(shown.kind, choice<Shown::Kind>(tree,
                                         {{"nothing", Shown::Kind::nothing},
                                          {"blackout", Shown::Kind::blackout},
                                          {"motion stop", Shown::Kind::motion_stop},
                                          {"armed", Shown::Kind::motion_arm},
                                          {"cue", Shown::Kind::cue},
                                          {"tally", Shown::Kind::lit},
                                          {"holding", Shown::Kind::holding},
                                          {"trouble", Shown::Kind::trouble}},
                                         report));
  }
  return shown;
}

namespace {

std::string lamp_in_words(const std::string& lamp) { return lamp == "*" ? "every lamp" : lamp; }

}  // namespace

std::string in_words(const Deed& deed) {
  for (const Bare& bare : kBare)
    if (bare.kind == deed.kind && bare.press == deed.press) return bare.word;
  switch (deed.kind) {
    case Deed::Kind::master:
      return "master " + std::string(master_name(deed.master));
    case Deed::Kind::level:
      return std::string(deed.dof == core::Dof::intensity ? "level" : core::info(deed.dof).name) +
             " of " + lamp_in_words(deed.lamp);
    case Deed::Kind::release:
      return "release " + lamp_in_words(deed.lamp);
    case Deed::Kind::mark:
      return deed.name + " " + lamp_in_words(deed.lamp);
    case Deed::Kind::cue_to:
      return "cue " + digits(deed.amount);
    case Deed::Kind::look:
      return "look " + deed.name;
    case Deed::Kind::mood:
      return "mood " + deed.name;
    default:
      return deed.name + " by " + digits(deed.amount) + " stops";
  }
}

std::string in_words(const Shown& shown) {
  switch (shown.kind) {
    case Shown::Kind::nothing:
      return "";
    case Shown::Kind::blackout:
      return "blackout";
    case Shown::Kind::motion_stop:
      return "motion stop";
    case Shown::Kind::motion_arm:
      return "motion armed";
    case Shown::Kind::cue:
      return shown.cue >= 0 ? "cue " + digits(shown.cue) : "cue";
    case Shown::Kind::master:
      return "master " + std::string(master_name(shown.master));
    case Shown::Kind::level:
      return "level of " + lamp_in_words(shown.lamp);
    case Shown::Kind::lit:
      return lamp_in_words(shown.lamp) + " lit";
    case Shown::Kind::mark:
      return shown.name;
    case Shown::Kind::holding:
      return "holding";
    case Shown::Kind::trouble:
      return "trouble";
  }
  return "";
}

}  // namespace chiaro::studio
