// SPDX-License-Identifier: Apache-2.0
// What an operator does to single lamps: faders, locks, stands and knobs, meter readings.
#include <algorithm>
#include <fmt/format.h>

#include "controller/core/light_units.h"
#include "controller/daemon/brain/brain.h"
#include "controller/daemon/brain/refusals.h"
#include "controller/daemon/brain/words.h"

namespace chiaro::daemon {
namespace {

constexpr double kSolveAgainFade = 1.0;

}  // namespace

core::Result<core::Done> Brain::keep_placements() {
  standing_.reset();
  return store_->set("placed:" + studio_.name, placements_->to_json(studio_));
}

void Brain::carry_out(const panel::SetFixture& set, const panel::Answer& answer) {
  const auto index = studio_.fixture_index(set.fixture);
  if (!index) return answer({panel::Refusal{404, "no such fixture", set.fixture, "", {}}});
  const ports::TimePoint now = world_.clock.now();
  if (set.lock) {
    placements_->lock(*index, *set.lock);
    if (auto kept = keep_placements(); !kept) return answer({refusal_of(kept.problems(), 500)});
  }
  if (!set.release.empty()) console_->release(*index, set.release, now);
  if (set.set.present() != 0) console_->hold(*index, set.set, now);
  changed();
  answer({});
}

void Brain::carry_out(const panel::SetMaster& set, const panel::Answer& answer) {
  console_->set_master(set.master, set.level, world_.clock.now());
  changed();
  answer({});
}

void Brain::carry_out(const panel::Placed& placed, const panel::Answer& answer) {
  const auto index = studio_.fixture_index(placed.fixture);
  if (!index) return answer({panel::Refusal{404, "no such fixture", placed.fixture, ""}});
  core::FixtureState to = placed.at;
  if (to.present() == 0) {  // "exactly as wanted"
    const auto instruction = instruction_for(*index);
    if (!instruction)
      return answer({panel::Refusal{409, "'" + placed.fixture + "' need not be moved", "fixture",
                                    "say where it stands: {\"azimuth_deg\": …}"}});
    to = instruction->to;
  }
  placements_->move(*index, to);
  if (auto kept = keep_placements(); !kept) return answer({refusal_of(kept.problems(), 500)});
  store_->note(placed.fixture + " has been set by hand");
  solve_again(kSolveAgainFade);
  changed();
  answer({});
}

void Brain::carry_out(const panel::Measured& measured, const panel::Answer& answer) {
  const auto index = studio_.fixture_index(measured.fixture);
  if (!index) return answer({panel::Refusal{404, "no such fixture", measured.fixture, "", {}}});
  const studio::Fixture& fixture = studio_.fixtures[*index];
  std::optional<core::Candela> output;
  if (measured.lux) {
    const studio::Rig rig = sent_rig();
    const double level = measured.intensity.value_or(rig.states[*index].get(core::Dof::intensity));
    if (level < 0.005)
      return answer({panel::Refusal{409,
                                    "'" + fixture.name + "' is dark: a meter cannot know it so",
                                    "intensity",
                                    "raise it alone, read the meter, then send the reading",
                                    {}}});
    const double distance = measured.distance_m.value_or(
        place_of(standing(), fixture, placements_->at(*index)).distance);
    // The reading is of the lamp as it is fitted; the studio file's output is of the bare lamp.
    const double loss = fixture.fitted_output().value / std::max(fixture.output.value, 1e-9);
    output = core::Candela{core::candela_from(core::Lux{*measured.lux}, distance).value /
                           std::max(level * loss, 1e-6)};
  }
  placements_->measure(*index, output);
  if (auto kept = keep_placements(); !kept) return answer({refusal_of(kept.problems(), 500)});
  store_->note(output ? fmt::format("{}: output measured, {:.0f} cd", fixture.name, output->value)
                      : fixture.name + ": output as its data sheet says");
  ++studio_turn_;  // an older preparation in the queue is not the one to wait for
  prepare_twin();
  solve_again(kSolveAgainFade);
  changed();
  answer({{},
          200,
          fmt::format(R"({{"output_cd":{:.0f}}})", output ? output->value : fixture.output.value)});
}

}  // namespace chiaro::daemon
