// SPDX-License-Identifier: Apache-2.0
// What an operator may do with the studio as a whole; looks.cpp, lamps.cpp, kit.cpp and jobs.cpp
// have the rest.
#include <fmt/format.h>

#include "controller/daemon/brain/brain.h"
#include "controller/daemon/brain/refusals.h"
#include "controller/studio/load.h"

namespace chiaro::daemon {
namespace {

/// How long the answer to a blackout or a motion stop waits for the hand.
constexpr ports::Duration kDarkPatience = std::chrono::seconds(2);

}  // namespace

void Brain::perform(const panel::Gesture& gesture, panel::Answer answer) {
  // Whoever was answered may ask at once: what the state then says must know of this gesture.
  const panel::Answer told = [this, answer = std::move(answer)](const panel::Outcome& outcome) {
    if (dirty_) renew_state();  // it stays so: others are told on the loop's next turn
    answer(outcome);
  };
  std::visit([&](const auto& wish) { carry_out(wish, told); }, gesture);
}

void Brain::carry_out(const panel::Reload&, const panel::Answer& answer) {
  auto loaded = studio::load_studio(studio_.file, {world_.config_folder});
  if (!loaded) return answer({refusal_of(loaded.problems(), 422)});
  cancel_running();
  if (again_) again_->stop = true;
  moods_ = design::load_moods(studio::Folders{world_.config_folder}.moods());
  const std::int64_t live = live_ ? live_->record.id : 0;
  if (auto taken = take_studio(std::move(*loaded)); !taken)
    return answer({refusal_of(taken.problems(), 500)});
  panel::Refusal ignored;
  live_ = live != 0 ? load(live, ignored) : std::nullopt;
  adopted_ = true;  // this brain knows what it said
  errands_.add([this, here = here_, folder = world_.runtime_folder] {
    const auto done = hand_reload(folder);
    post_([this, here, problems = done.problems()] {
      if (!*here || problems.empty()) return;
      notes_.push_back("the output process did not take the new file: " + problems.front().what);
      changed();
    });
  });
  store_->note("studio file read again");
  answer({});
}

void Brain::carry_out(const panel::MotionStop& stop, const panel::Answer& answer) {
  const ports::TimePoint now = world_.clock.now();
  adopt(now);  // standstill does not wait for a hand; but what one does already is kept
  waiting_.push_back({console_->motion_stop(stop.on, now), true, now + kDarkPatience, answer});
  store_->note(stop.on ? "motion stopped" : "motion stop released");
  changed();
  speak(now);
}

void Brain::carry_out(const panel::Blackout& blackout, const panel::Answer& answer) {
  const ports::TimePoint now = world_.clock.now();
  adopt(now);  // darkness does not wait for a hand; but what one shows already comes back after it
  waiting_.push_back({console_->blackout(blackout.on, now), false, now + kDarkPatience, answer});
  store_->note(blackout.on ? "blackout" : "blackout released");
  changed();
  speak(now);
}

}  // namespace chiaro::daemon
