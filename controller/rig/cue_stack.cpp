// SPDX-License-Identifier: Apache-2.0
#include "controller/rig/cue_stack.h"

#include <algorithm>

namespace chiaro::rig {

using core::Dof;

void CueList::put(Cue cue) {
  const auto place =
      std::lower_bound(cues.begin(), cues.end(), cue.number,
                       [](const Cue& each, double number) { return each.number < number; });
  if (place != cues.end() && place->number == cue.number)
    *place = std::move(cue);
  else
    cues.insert(place, std::move(cue));
}

bool CueList::remove(double number) {
  return std::erase_if(cues, [&](const Cue& cue) { return cue.number == number; }) > 0;
}

void CueList::look_ahead() {
  for (std::size_t c = 0; c < cues.size(); ++c) {
    cues[c].ahead = cues[c].state;
    if (c + 1 == cues.size()) continue;
    auto& states = cues[c].ahead.fixtures;
    const auto& next = cues[c + 1].state.fixtures;
    for (std::size_t i = 0; i < std::min(states.size(), next.size()); ++i) {
      if (states[i].get(Dof::intensity) > 0 || next[i].get(Dof::intensity) <= 0) continue;
      const double dark = states[i].get(Dof::intensity);
      states[i].overlay(next[i]);
      states[i].set(Dof::intensity, dark);
    }
  }
}

std::ptrdiff_t CueStack::find(double number) const {
  for (std::size_t i = 0; i < list_->cues.size(); ++i)
    if (list_->cues[i].number == number) return static_cast<std::ptrdiff_t>(i);
  return -1;
}

void CueStack::take(std::unique_ptr<CueList>& list) {
  const std::ptrdiff_t was = playing_;
  const double number = was < 0 ? 0 : list_->cues[static_cast<std::size_t>(was)].number;
  std::swap(list_, list);
  playing_ = was < 0 ? -1 : find(number);
}

const Cue* CueStack::play(std::ptrdiff_t which, ports::TimePoint now) {
  if (which < 0 || which >= static_cast<std::ptrdiff_t>(list_->cues.size())) return nullptr;
  playing_ = which;
  went_ = now;
  const Cue& cue = list_->cues[static_cast<std::size_t>(which)];
  follows_ = cue.follow_s.has_value();
  return &cue;
}

const Cue* CueStack::go(ports::TimePoint now) { return play(playing_ + 1, now); }

const Cue* CueStack::back(ports::TimePoint now) {
  const Cue* cue = play(playing_ - 1, now);
  follows_ = false;  // who goes back wants to look at it
  return cue;
}

const Cue* CueStack::to(double number, ports::TimePoint now) { return play(find(number), now); }

const Cue* CueStack::due(ports::TimePoint now) {
  if (playing_ < 0 || !follows_) return nullptr;
  const Cue& cue = list_->cues[static_cast<std::size_t>(playing_)];
  if (!cue.follow_s || std::chrono::duration<double>(now - went_).count() < *cue.follow_s)
    return nullptr;
  follows_ = false;
  return go(now);
}

const Cue* CueStack::stand_at(double number) {
  playing_ = find(number);
  follows_ = false;
  return playing_ < 0 ? nullptr : &list_->cues[static_cast<std::size_t>(playing_)];
}

Sent::CueState CueStack::state(ports::TimePoint now) const {
  Sent::CueState state;
  state.playing = static_cast<std::int32_t>(playing_);
  state.cues = static_cast<std::uint32_t>(list_->cues.size());
  if (playing_ < 0) return state;
  const Cue& cue = list_->cues[static_cast<std::size_t>(playing_)];
  state.number = cue.number;
  const bool last = playing_ + 1 == static_cast<std::ptrdiff_t>(list_->cues.size());
  if (follows_ && cue.follow_s && !last)
    state.follow_s =
        std::max(0.0, *cue.follow_s - std::chrono::duration<double>(now - went_).count());
  return state;
}

}  // namespace chiaro::rig
