// SPDX-License-Identifier: Apache-2.0
#include "controller/importers/capability.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "controller/importers/xml.h"

namespace chiaro::importers {
namespace {

using studio::Segment;

bool is_word(std::string_view words, std::string_view word) {
  for (std::size_t at = words.find(word); at != std::string_view::npos;
       at = words.find(word, at + 1)) {
    const auto letter = [&](std::size_t i) {
      return i < words.size() && std::isalpha(static_cast<unsigned char>(words[i])) != 0;
    };
    if ((at == 0 || !letter(at - 1)) && !letter(at + word.size())) return true;
  }
  return false;
}

bool flashes(const std::string& words) {
  return mentions(words, {"strob", "pulse", "flash", "random", "sound", "auto", "macro", "program",
                          "speed", "ramp", "lightning", "reset", "lamp o", "chase", "effect"});
}
bool is_open(const Capability& c) {
  if (c.open) return true;
  if (c.closed || flashes(c.words))
    return mentions(c.words, {"no strob", "strobe off", "no flash"});
  return mentions(c.words, {"open", "no function", "no effect", "full", "normal", "no strob",
                            "strobe off", "lamp on", "light on", "led on", "100%", "static"}) ||
         is_word(c.words, "on");
}
bool is_closed(const Capability& c) {
  if (c.closed) return true;
  return !c.open && !flashes(c.words) &&
         (mentions(c.words, {"close", "blackout", "black out", "dark", "no light"}) ||
          is_word(c.words, "off") || is_word(c.words, "shut"));
}
bool dims(const Capability& c) {
  return c.to - c.from >= 8 && !flashes(c.words) &&
         (mentions(c.words, {"dim", "intens", "bright", "0-100", "0 - 100", "100-0", "100 - 0",
                             "0% to 100%", "0...100", "%", "linear", "master", "0 to 100"}));
}
bool falls(const std::string& words) {
  return mentions(words, {"100-0", "100 - 0", "100% - 0", "100%-0", "100 to 0", "100% to 0",
                          "bright to dark", "bright - dark", "decreas", "full to"});
}

double middle(const Capability& c, double full) { return std::round(0.5 * (c.from + c.to)) / full; }

}  // namespace

bool mentions(std::string_view words, std::initializer_list<std::string_view> any) {
  return std::any_of(any.begin(), any.end(), [&](std::string_view each) {
    return words.find(each) != std::string_view::npos;
  });
}

Meaning meaning_of_name(const std::string& name) {
  const auto is = [&](std::initializer_list<std::string_view> any) {
    return std::any_of(any.begin(), any.end(), [&](auto each) { return is_word(name, each); });
  };
  if (mentions(name, {"macro", "speed", "program", "auto", "strobe", "wheel", "preset", "sound",
                      "background", "effect", "mode", "function", "curve", "gobo"}))
    return Meaning::unknown;
  if (is({"pan"}) && is({"tilt"})) return Meaning::unknown;
  if (is({"pan"})) return Meaning::pan;
  if (is({"tilt"})) return Meaning::tilt;
  if (is({"zoom"})) return Meaning::zoom;
  if (mentions(name, {"temperature", "colour temp", "color temp"}) || is({"cct"}))
    return Meaning::cct;
  if (mentions(name, {"warm"})) return Meaning::warm_white;
  if (is({"red"}) || name == "r") return Meaning::red;
  if (is({"green"}) || name == "g") return Meaning::green;
  if (is({"blue"}) || name == "b") return Meaning::blue;
  if (is({"white"}) || mentions(name, {"cool", "cold"}) || name == "w") return Meaning::white;
  if (is({"amber"})) return Meaning::amber;
  if (is({"lime"})) return Meaning::lime;
  if (is({"dimmer", "dim", "intensity", "brightness", "master", "dimming"}))
    return Meaning::intensity;
  return Meaning::unknown;
}

std::optional<core::Range> kelvins_in(const std::string& words) {
  std::vector<double> found;
  for (std::size_t i = 0; i < words.size();) {
    if (std::isdigit(static_cast<unsigned char>(words[i])) == 0) {
      ++i;
      continue;
    }
    std::size_t end = i;
    while (end < words.size() && std::isdigit(static_cast<unsigned char>(words[end])) != 0) ++end;
    const double value = number_in(std::string_view(words).substr(i, end - i), 1000, 25000, 0);
    if (value > 0) found.push_back(value);
    i = end;
  }
  if (found.size() != 2 || found[0] == found[1] || words.find('k') == std::string::npos)
    return std::nullopt;
  return core::Range{found[0], found[1]};
}

std::vector<Segment> dimmer_law(const std::vector<Capability>& capabilities, double full) {
  const Capability* dimming = nullptr;
  for (const Capability& c : capabilities)
    if (dims(c) && (dimming == nullptr || c.to - c.from > dimming->to - dimming->from))
      dimming = &c;
  if (dimming == nullptr || (dimming->from <= 0 && dimming->to >= full)) return {};
  std::vector<Segment> law;
  for (const Capability& c : capabilities) {
    const double from = c.from / full, to = c.to / full;
    if (!law.empty() && from <= law.back().dmx_to) continue;  // libraries overlap now and then
    if (&c == dimming) {
      const bool down = falls(c.words);
      law.push_back({from, to, down ? 1.0 : 0.0, down ? 0.0 : 1.0, Segment::Law::continuous});
    } else if (is_closed(c)) {
      law.push_back({from, to, 0, 0, Segment::Law::neutral});
    } else if (is_open(c)) {
      law.push_back({from, to, 1, 1, Segment::Law::neutral});
    } else {
      law.push_back({from, to, 0, 0, Segment::Law::no_effect});
    }
  }
  return law;
}

Shutter shutter_law(const std::vector<Capability>& capabilities, double full) {
  Shutter law;
  const Capability* open = nullptr;
  for (const Capability& c : capabilities) {
    if (is_open(c) && (open == nullptr || (c.open && !open->open))) open = &c;
    if (is_closed(c) && !law.closed) law.closed = middle(c, full);
  }
  if (open != nullptr) {
    law.open = middle(*open, full);
    if (law.closed) law.lit = law.open;
    return law;
  }
  // Nothing is called open: where it is neither closed nor flashing, else at rest.
  for (const Capability& c : capabilities)
    if (!is_closed(c) && !flashes(c.words)) {
      law.open = middle(c, full);
      if (law.closed) law.lit = law.open;
      return law;
    }
  law.open = law.closed && *law.closed < 0.5 ? 1 : 0;
  return law;
}

double idle(const std::vector<Capability>& capabilities, double full) {
  if (capabilities.empty()) return 0;
  const auto asks_nothing = [](const Capability& c) {
    return c.open ||
           mentions(c.words, {"no function", "no effect", "not used", "none", "manual", "normal",
                              "open", "dmx", "disabled", "no macro", "no color", "white"}) ||
           is_word(c.words, "off") || is_word(c.words, "no");
  };
  const Capability& first = capabilities.front();
  if (asks_nothing(first) || (!flashes(first.words) && !is_closed(first))) return first.from / full;
  for (const Capability& c : capabilities)
    if (asks_nothing(c)) return middle(c, full);
  return first.from / full;
}

}  // namespace chiaro::importers
