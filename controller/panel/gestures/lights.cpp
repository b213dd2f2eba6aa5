// SPDX-License-Identifier: Apache-2.0
// What a person does to one lamp, to a group of them, or to all.
#include <algorithm>
#include <fmt/format.h>

#include "controller/core/light_units.h"
#include "controller/panel/made.h"

namespace chiaro::panel {
namespace {

/// The fixture of an address; fills `refusal` when there is none.
const FixtureView* fixture_of(const Words& words, const State& state, Refusal& refusal) {
  const FixtureView* fixture = state.fixture(words[1]);
  if (!fixture) refusal = unknown_name("fixture", words[1], fixture_names(state));
  return fixture;
}

/// One degree of freedom of a body: null releases, a number sets within the fixture's limits.
void read_dof(Fields& fields, const FixtureView& fixture, const core::DofInfo& dof,
              SetFixture& gesture) {
  const std::string name(dof.file_name);
  const auto limit =
      std::find_if(fixture.limits.begin(), fixture.limits.end(),
                   [&](const auto& candidate) { return candidate.first == dof.dof; });
  if (limit == fixture.limits.end()) return;
  const bool by_hand = std::count(fixture.by_hand.begin(), fixture.by_hand.end(), dof.dof) > 0;
  if (!fields.has(name.c_str())) return;
  if (by_hand)
    return fields.fail(422, fmt::format("{} of '{}' is set by hand", name, fixture.name), name,
                       fmt::format("do it, then POST /api/v1/fixtures/{}/placed", fixture.name));
  if (fields.json().at(name).is_null()) return gesture.release.push_back(dof.dof);
  const core::Range range{core::file_value(dof.dof, limit->second.least),
                          core::file_value(dof.dof, limit->second.most)};
  if (const auto value = fields.number(name.c_str(), range))
    gesture.set.set(dof.dof, core::inside_value(dof.dof, *value));
}

/// A meter's reading, as a number or as the meter shows it.
std::optional<double> reading_of(Fields& fields) {
  constexpr core::Range kLux{0.1, 1e6};
  if (const auto text = fields.text("reading")) {
    const auto light = core::meter_reading(*text);
    if (light && kLux.contains(light->value)) return light->value;
    fields.fail(422, "'" + *text + "' is not a meter's reading", "reading",
                "write it as 420 lx, 39 fc, or f/5.6 1/50 ISO 100");
  }
  return fields.number("lux", kLux);
}

/// What may be said of something a hand sets. Where a stand really is may lie outside its region;
/// only the impossible is refused.
core::Range possible(const FixtureView& fixture, core::Dof dof) {
  if (dof == core::Dof::azimuth) return {-180, 180};
  if (dof == core::Dof::elevation) return {-90, 90};
  if (dof == core::Dof::distance) return {0.1, 100};
  for (const auto& [limited, range] : fixture.limits)
    if (limited == dof)
      return {core::file_value(dof, range.least), core::file_value(dof, range.most)};
  return {0, 1};
}

}  // namespace

Made set_fixture(const Request& request, const Words& words, const State& state) {
  Refusal refusal;
  const FixtureView* fixture = fixture_of(words, state, refusal);
  if (!fixture) return refusal;
  Fields fields(request.body);
  SetFixture gesture{fixture->name, {}, {}, {}};
  gesture.lock = fields.flag("lock");
  if (fields.flag("release").value_or(false))
    for (const core::DofInfo& dof : core::dofs()) gesture.release.push_back(dof.dof);
  for (const core::DofInfo& dof : core::dofs()) read_dof(fields, *fixture, dof, gesture);
  if (!fixture->controlled)
    fields.fail(422, "'" + fixture->name + "' is not controlled from here", fixture->name,
                "give it a patch in the studio file");
  return checked(fields, gesture);
}

Made placed(const Request& request, const Words& words, const State& state) {
  Refusal refusal;
  const FixtureView* fixture = fixture_of(words, state, refusal);
  if (!fixture) return refusal;
  Fields fields(request.body);
  Placed gesture{fixture->name, {}};
  if (fixture->by_hand.empty())
    fields.fail(422, "nothing of '" + fixture->name + "' is set by hand", fixture->name,
                "only stands, knobs, gels and flashes are");
  for (const core::Dof dof : fixture->by_hand) {
    const std::string name(core::info(dof).file_name);
    if (const auto value = fields.number(name.c_str(), possible(*fixture, dof)))
      gesture.at.set(dof, core::inside_value(dof, *value));
  }
  return checked(fields, gesture);
}

Made measured(const Request& request, const Words& words, const State& state) {
  Refusal refusal;
  const FixtureView* fixture = fixture_of(words, state, refusal);
  if (!fixture) return refusal;
  Fields fields(request.body);
  Measured gesture{fixture->name, {}, {}, {}};
  gesture.lux = reading_of(fields);
  gesture.distance_m = fields.number("distance_m", {0.1, 100});
  gesture.intensity = fields.number("intensity", {0.005, 1});
  const bool forget = fields.flag("forget").value_or(false);
  if (forget == gesture.lux.has_value())
    fields.fail(400, "what did the meter read?", "lux",
                "send {\"reading\": \"420 lx\"}, {\"lux\": 420}, or {\"forget\": true}");
  return checked(fields, gesture);
}

Made set_master(const Request& request, const Words& words, const State&) {
  const std::vector<std::string> names(std::begin(kMasterNames), std::end(kMasterNames));
  const auto found = std::find(names.begin(), names.end(), words[1]);
  if (found == names.end()) return unknown_name("master", words[1], names);
  Fields fields(request.body);
  fields.required("level");
  const double level = fields.number("level", {0, 1}).value_or(1);
  return checked(fields, SetMaster{static_cast<std::size_t>(found - names.begin()), level});
}

}  // namespace chiaro::panel
