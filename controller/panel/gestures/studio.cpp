// SPDX-License-Identifier: Apache-2.0
// The studio as a whole: darkness, standstill, its file, and lamps it does not know yet.
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "controller/panel/made.h"

namespace chiaro::panel {
namespace {

constexpr std::size_t kMostTried = 32;  // as many as the box to the output process carries

template <class Switch>
Made switched(const Request& request) {
  Fields fields(request.body);
  fields.required("on");
  return checked(fields, Switch{fields.flag("on").value_or(true)});
}

std::uint16_t universe_of(Fields& fields, const State& state) {
  fields.required("universe");
  const auto universe =
      static_cast<std::uint16_t>(fields.number("universe", {1, 63999}).value_or(1));
  for (const OutputView& output : state.outputs)
    if (output.universe == universe) return universe;
  fields.fail(422, fmt::format("universe {} is not sent by this studio", universe), "universe",
              "add it to the outputs of the studio file");
  return universe;
}

/// Whose slot it is; nobody's: null.
const FixtureView* owner(const State& state, std::uint16_t universe, int slot) {
  for (const FixtureView& fixture : state.fixtures)
    if (fixture.patch && fixture.patch->universe == universe && slot >= fixture.patch->address &&
        slot < fixture.patch->address + fixture.patch->slots)
      return &fixture;
  return nullptr;
}

void check_free(Fields& fields, const State& state, std::uint16_t universe, int slot) {
  const FixtureView* whose = owner(state, universe, slot);
  if (whose != nullptr)
    fields.fail(409, fmt::format("slot {} belongs to '{}'", slot, whose->name), "slots",
                "take slots that no lamp has");
}

void read_levels(Fields& fields, const State& state, TrySlots& gesture) {
  fields.required("slots");
  const Json levels = fields.any("slots");
  if (!levels.is_object())
    return fields.fail(400, "'slots' must be an object", "slots",
                       "send {\"slots\": {\"21\": 128}}");
  if (levels.size() > kMostTried)
    return fields.fail(422, "that is too many slots at once", "slots",
                       fmt::format("raise at most {}", kMostTried));
  for (const auto& [name, level] : levels.items()) {
    const auto slot = number_of(name);
    if (!slot || *slot < 1 || *slot > 512 || !level.is_number_unsigned() ||
        level.get<std::uint64_t>() > 255)
      return fields.fail(422, fmt::format("slot '{}' cannot be raised so", name), "slots",
                         "slots are 1 to 512, levels 0 to 255");
    check_free(fields, state, gesture.universe, static_cast<int>(*slot));
    gesture.levels.emplace_back(static_cast<std::uint16_t>(*slot),
                                static_cast<std::uint8_t>(level.get<unsigned>()));
  }
}

void read_seen(Fields& fields, LearnLamp& lamp) {
  const std::vector<std::string> known(std::begin(kSeen), std::end(kSeen));
  fields.required("slots");
  const Json slots = fields.any("slots");
  if (!slots.is_array() || slots.empty() || slots.size() > kMostTried)
    return fields.fail(400, "'slots' must be a list of what each slot does", "slots",
                       "send {\"slots\": [{\"sees\": \"dimmer\"}]}, at most 32");
  for (const Json& slot : slots) {
    Fields each(slot.is_object() ? slot : Json::object());
    each.required("sees");
    LearnLamp::Slot seen{each.text("sees").value_or(""), 255};
    seen.level = static_cast<std::uint8_t>(each.number("level", {0, 255}).value_or(255));
    if (const auto fault = each.fault())
      return fields.fail(fault->status, fault->what, "slots", fault->remedy);
    if (std::find(known.begin(), known.end(), seen.sees) == known.end()) {
      const Refusal refusal = unknown_name("use of a slot", seen.sees, known);
      return fields.fail(422, refusal.what, "slots", refusal.remedy);
    }
    lamp.slots.push_back(std::move(seen));
  }
}

void read_light(Fields& fields, LearnLamp& lamp) {
  lamp.output_cd = fields.number("output_cd", {1, 1e7}).value_or(lamp.output_cd);
  lamp.cct.least = fields.number("warmest_k", {1500, 20000}).value_or(lamp.cct.least);
  lamp.cct.most = fields.number("coolest_k", {1500, 20000}).value_or(lamp.cct.most);
  if (lamp.cct.least > lamp.cct.most) std::swap(lamp.cct.least, lamp.cct.most);
}

void read_held(Fields& fields, const State& state, LearnLamp& lamp) {
  lamp.held = fields.text("held").value_or(lamp.held);
  if (std::find(std::begin(kHeldBy), std::end(kHeldBy), lamp.held) == std::end(kHeldBy))
    fields.fail(422, "'" + lamp.held + "' holds no lamp", "held",
                "send 'stand', 'hung', 'arc' or 'track'");
  lamp.over = fields.flag("over").value_or(lamp.over);
  lamp.travel_deg = fields.number("travel_deg", {1, 180}).value_or(lamp.travel_deg);
  lamp.far_end = fields.text("far_end").value_or(lamp.far_end);
  lamp.along = fields.number("along", {0, 1}).value_or(lamp.along);
  lamp.motor_bits = fields.number("motor_bits", {8, 16}).value_or(16) < 12 ? 8 : 16;
  const auto own = static_cast<double>(lamp.slots.size());
  lamp.motor_slot =
      static_cast<std::uint16_t>(fields.number("motor_slot", {own + 1, 512}).value_or(own + 1));
  if (lamp.held != "arc" && lamp.held != "track") return;
  for (int i = 0; i < lamp.motor_bits / 8; ++i)
    check_free(fields, state, lamp.universe, lamp.address + lamp.motor_slot - 1 + i);
}

}  // namespace

Made track_subject(const Request& request, const Words&, const State&) {
  constexpr double kFarthest = 50;  // metres, as large as a studio's subject may be
  Fields fields(request.body);
  TrackSubject gesture;
  fields.required("moved_m");
  const Json moved = fields.any("moved_m");
  core::Vec3 by;
  double* axes[] = {&by.x, &by.y, &by.z};
  bool fits = moved.is_array() && moved.size() == 3;
  for (std::size_t i = 0; i < 3 && fits; ++i) {
    fits = moved[i].is_number() && std::abs(moved[i].get<double>()) <= kFarthest;
    if (fits) *axes[i] = moved[i].get<double>();
  }
  if (!fits)
    fields.fail(422, "'moved_m' must be three lengths within 50 m", "moved_m",
                "send metres along the studio's axes, as in [0.1, 0, 0]");
  gesture.moved = by;
  gesture.turned = core::radians(fields.number("turned_deg", {-3600, 3600}).value_or(0));
  return checked(fields, gesture);
}

Made untrack_subject(const Request&, const Words&, const State&) { return Gesture(TrackSubject{}); }

Made reload(const Request& request, const Words&, const State&) {
  Fields fields(request.body);
  return checked(fields, Reload{});
}

Made motion_stop(const Request& request, const Words&, const State&) {
  return switched<MotionStop>(request);
}

Made blackout(const Request& request, const Words&, const State&) {
  return switched<Blackout>(request);
}

Made try_slots(const Request& request, const Words&, const State& state) {
  Fields fields(request.body);
  TrySlots gesture;
  gesture.universe = universe_of(fields, state);
  read_levels(fields, state, gesture);
  return checked(fields, gesture);
}

Made release_slots(const Request&, const Words&, const State&) { return Gesture(TrySlots{}); }

Made learn_lamp(const Request& request, const Words&, const State& state) {
  Fields fields(request.body);
  LearnLamp lamp;
  fields.required("name");
  lamp.name = fields.text("name").value_or("");
  if (lamp.name.empty() || lamp.name.size() > 60)
    fields.fail(422, "a lamp needs a name of at most 60 letters", "name",
                "call it what you call it");
  if (state.fixture(lamp.name))
    fields.fail(409, "there is a lamp '" + lamp.name + "' already", "name", "choose another name");
  lamp.role = fields.text("role").value_or(lamp.role);
  lamp.maker = fields.text("maker").value_or(lamp.maker);
  lamp.model = fields.text("model").value_or(lamp.name);
  lamp.universe = universe_of(fields, state);
  lamp.address = static_cast<std::uint16_t>(fields.number("address", {1, 512}).value_or(1));
  read_seen(fields, lamp);
  for (std::size_t i = 0; i < lamp.slots.size(); ++i)
    check_free(fields, state, lamp.universe, lamp.address + static_cast<int>(i));
  read_light(fields, lamp);
  lamp.place = fields.text("place").value_or(lamp.place);
  read_held(fields, state, lamp);
  lamp.add = fields.flag("add").value_or(false);
  return checked(fields, lamp);
}

}  // namespace chiaro::panel
