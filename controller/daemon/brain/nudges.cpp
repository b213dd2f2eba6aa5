// SPDX-License-Identifier: Apache-2.0
// Looks that need no search: work light, and a live look bent by a nudge.
#include <algorithm>
#include <fmt/format.h>

#include "controller/daemon/brain/asked.h"
#include "controller/daemon/brain/brain.h"
#include "controller/daemon/brain/refusals.h"
#include "controller/design/words.h"

namespace chiaro::daemon {
namespace {

constexpr const char* kWorkLight = "Work light";

bool lights_the_front(const studio::Fixture& fixture) {
  return fixture.controlled &&
         (fixture.role == studio::Role::key || fixture.role == studio::Role::fill);
}

}  // namespace

studio::Rig Brain::work_light() const {
  const studio::Studio& studio = standing();
  studio::Rig rig = studio::placed_rig(studio);
  const double front = static_cast<double>(
      std::count_if(studio.fixtures.begin(), studio.fixtures.end(), lights_the_front));
  const double each = studio.exposure.grey_card.value / std::max(front, 1.0);
  for (std::size_t i = 0; i < studio.fixtures.size(); ++i) {
    core::FixtureState& state = rig.states[i];
    if (placements_->locked(i) || !studio.fixtures[i].controlled) continue;
    double most = 0;
    for (const auto& [dof, range] : studio.fixtures[i].ranges()) {
      if (dof == core::Dof::intensity) most = range.most;
      if (dof == core::Dof::cct) state.set(dof, range.clamp(studio.exposure.white_balance.value));
    }
    state.set(core::Dof::intensity, 1);
    const double full = design::lux_at_face(studio, rig, i);
    const bool front_lamp = lights_the_front(studio.fixtures[i]) || front == 0;
    state.set(core::Dof::intensity, front_lamp && full > 0 ? std::min(most, each / full) : 0);
  }
  return rig;
}

design::Look Brain::flat_look() const {
  design::Look look;
  look.name = kWorkLight;
  look.goal = "even light from the front";
  look.wanted = look.placed = work_light();
  look.judgement.verdict = look.placed_judgement.verdict = design::Verdict::reached;
  return look;
}

void Brain::renew_work_light(double fade_s) {
  live_->look.wanted = live_->look.placed = work_light();
  live_->record.json = design::look_to_json(studio_, live_->look);
  if (auto kept = store_->update_look(live_->record); !kept)
    notes_.push_back(core::to_string(kept.problems()));
  console_->apply(studio_, live_->look.placed, fade_s, world_.clock.now());
  draw(live_->record.id, live_->look.wanted, live_->look.placed);
}

void Brain::carry_out(const panel::WorkLight& light, const panel::Answer& answer) {
  panel::StartDesign ask;
  ask.flat = true;
  ask.title = kWorkLight;
  Live live;
  live.look = flat_look();
  live.record.name = ask.title;
  live.record.verdict = design::name_of(design::Verdict::reached);
  live.record.request = asked_to_json(ask);
  live.record.json = design::look_to_json(studio_, live.look);
  const auto id = store_->save_look(live.record);
  if (!id) return answer({refusal_of(id.problems(), 500)});
  live.record.id = *id;
  cancel_running();
  job_.reset();
  go_live(std::move(live), light.fade_s, true);
  store_->prune_looks(kMostNameless, *id);
  draw(*id, live_->look.wanted, live_->look.placed);
  answer({{}, 200, fmt::format(R"({{"id":{}}})", *id)});
}

void Brain::carry_out(const panel::Nudge& nudge, const panel::Answer& answer) {
  if (!live_)
    return answer({panel::Refusal{409, "no look is live", "look", "choose a mood first", {}}});
  if (ready_ && any_error(twin_problems_)) return answer({refusal_of(twin_problems_)});
  panel::StartDesign ask = asked_from_json(live_->record.request, live_->record.reference);
  ask.mood = live_->record.mood;
  ask.title = live_->record.name;
  ask.apply_fade_s = nudge.fade_s;
  ask.nudges.brighter += nudge.by.brighter;
  ask.nudges.softer += nudge.by.softer;
  ask.nudges.warmer += nudge.by.warmer;
  ask.nudges.contrast += nudge.by.contrast;
  DesignTask task = task_of(ask, {});
  task.from = live_->look;
  task.nudge = steps_of(nudge.by);
  begin(ask, std::move(task), answer);
}

}  // namespace chiaro::daemon
