// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/interview/learning.h"

#include <algorithm>
#include <iterator>
#include <vector>

#include "controller/daemon/interview/questions.h"
#include "controller/panel/gestures.h"
#include "controller/studio/reading/text.h"

namespace chiaro::daemon::interview {
namespace {

using studio::reading::Measure;

constexpr const char* kAgain = "again";

std::vector<std::string> sights() {
  std::vector<std::string> words(std::begin(panel::kSeen), std::end(panel::kSeen));
  words.push_back(kAgain);
  return words;
}

/// The slot itself, and the dimmer as far as it is known: colours show only with it up.
std::map<int, std::uint8_t> raised(const Unknown& lamp, const LearntLamp& so_far, int index) {
  std::map<int, std::uint8_t> slots;
  for (std::size_t i = 0; i < so_far.slots.size(); ++i)
    if (so_far.slots[i].sees == "dimmer") slots[lamp.address + static_cast<int>(i)] = 255;
  slots[lamp.address + index] = 255;
  return slots;
}

}  // namespace

LearntLamp learn(Dialogue& dialogue, Wire& wire, const Unknown& lamp) {
  LearntLamp learnt;
  learnt.profile = profile_name(lamp.name);
  learnt.model = lamp.name;
  dialogue.say("  Look at the lamp. Each slot goes up for three seconds; say what you saw.");
  dialogue.say(
      "  'fine' is the finer half of the slot before; 'keep' must stay up; 'again' repeats.");
  bool works = true;
  for (int index = 0; index < lamp.slots && !dialogue.ended();) {
    if (works) {
      const auto shown = wire.show(lamp.interface, static_cast<std::uint16_t>(lamp.universe),
                                   raised(lamp, learnt, index));
      works = static_cast<bool>(shown);
      if (!shown) dialogue.complain(shown.problems());
    }
    const std::string number = std::to_string(lamp.address + index);
    const std::string sees = dialogue.ask<std::string>(
        "  Slot " + number + " (" + studio::reading::any_of(sights()) + ")", "nothing",
        one_of(sights()));
    if (sees == kAgain) continue;
    learnt.slots.push_back({sees, 255});
    ++index;
  }
  learnt.output_cd = dialogue.ask<double>("  Output at full, on axis (a guess will do)", "5000 cd",
                                          a_quantity(Measure::intensity, {1, 1e7}));
  return learnt;
}

}  // namespace chiaro::daemon::interview
