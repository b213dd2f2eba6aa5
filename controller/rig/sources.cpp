// SPDX-License-Identifier: Apache-2.0
#include "controller/rig/sources.h"

#include <algorithm>
#include <cmath>

namespace chiaro::rig {

using core::Dof;
using core::FixtureState;
using core::kDofs;
using ports::TimePoint;

namespace {
constexpr double kLongestFade = 24 * 3600;
constexpr auto kCue = static_cast<std::size_t>(Source::cue);
constexpr auto kLook = static_cast<std::size_t>(Source::look);
constexpr auto kManual = static_cast<std::size_t>(Source::manual);
constexpr auto kOwn = static_cast<std::size_t>(Source::own);
}  // namespace

void Sources::add(const Lamp& lamp, const FixtureState* held) {
  for (std::size_t d = 0; d < kDofs; ++d) {
    const Dof dof = static_cast<Dof>(d);
    double value = lamp.base.get(dof);
    if (held != nullptr && lamp.can(d) && held->has(dof))
      value = lamp.range[d].clamp(held->get(dof));
    Track track;
    track.fade = Fade(dof, value);
    track.guard = FlashGuard(value);
    track.sent = value;
    tracks_.push_back(track);
  }
  for (auto& word : words_) word.fixtures.emplace_back();
  changed_.push_back(0);
}

void Sources::begin(std::size_t s, std::uint64_t id, double fade_s, TimePoint now) {
  fresh_[s] = id != words_[s].fade_id;
  if (!fresh_[s]) return;
  words_[s].fade_id = id;
  words_[s].fade_s = std::isfinite(fade_s) ? std::clamp(fade_s, 0.0, kLongestFade) : 0;
  start_[s] = now;
}

bool Sources::hear_source(std::size_t s, const Lamp& lamp, std::size_t i, const SourceState& word) {
  FixtureState heard;
  if (i < word.fixtures.size())
    for (std::size_t d = 0; d < kDofs; ++d) {
      const Dof dof = static_cast<Dof>(d);
      if (!lamp.can(d) || !word.fixtures[i].has(dof)) continue;
      const double value = word.fixtures[i].get(dof);
      if (std::isfinite(value)) heard.set(dof, lamp.range[d].clamp(value));
    }
  FixtureState& mine = words_[s].fixtures[i];
  if (!fresh_[s] && heard == mine) return false;
  if (s == kManual && fresh_[s])  // the newest fader has the say
    for (std::size_t d = 0; d < kDofs; ++d)
      if (const Dof dof = static_cast<Dof>(d);
          heard.has(dof) && (!mine.has(dof) || mine.get(dof) != heard.get(dof)))
        words_[kOwn].fixtures[i].clear(dof);
  mine = heard;
  return true;
}

void Sources::hear(std::span<const Lamp> lamps, std::span<const SourceState, kSources> words,
                   TimePoint now, std::vector<std::uint8_t>& woken) {
  for (std::size_t s = 0; s < kSources; ++s) {
    fresh_[s] = false;
    if (s == kCue || s == kOwn) continue;
    begin(s, words[s].fade_id, words[s].fade_s, now);
    for (std::size_t i = 0; i < lamps.size(); ++i)
      if (hear_source(s, lamps[i], i, words[s])) changed_[i] = 1;
  }
  if (cue_ && fresh_[kLook]) end_cue(now, words_[kLook].fade_s);
  if (fresh_[kLook]) end_own(now, words_[kLook].fade_s);
  retarget_all(lamps, now, woken);
}

void Sources::hear_cue(std::span<const Lamp> lamps, const SourceState& cue,
                       const SourceState& ahead, std::span<const Marks> marks, TimePoint now,
                       std::vector<std::uint8_t>& woken) {
  fresh_.fill(false);
  begin(kCue, words_[kCue].fade_id + 1, cue.fade_s, now);
  for (std::size_t i = 0; i < lamps.size(); ++i) {
    hear_source(kCue, lamps[i], i, has(marks[i], Mark::move_in_black) ? ahead : cue);
    changed_[i] = 1;
  }
  cue_ = !cue.fixtures.empty();
  retarget_all(lamps, now, woken);
}

void Sources::end_cue(TimePoint now, double fade_s) {
  begin(kCue, words_[kCue].fade_id + 1, fade_s, now);
  for (auto& state : words_[kCue].fixtures) state = {};
  std::fill(changed_.begin(), changed_.end(), std::uint8_t{1});
  cue_ = false;
}

/// As the brain's own faders do, so that a click on a look shows that look.
void Sources::end_own(TimePoint now, double fade_s) {
  const auto empty = [](const FixtureState& state) { return state.present() == 0; };
  auto& own = words_[kOwn].fixtures;
  if (std::all_of(own.begin(), own.end(), empty)) return;
  begin(kOwn, words_[kOwn].fade_id + 1, fade_s, now);
  for (std::size_t i = 0; i < own.size(); ++i) {
    if (!empty(own[i])) changed_[i] = 1;
    own[i] = {};
  }
}

void Sources::hear_own(std::size_t i, std::span<const Lamp> lamps, Dof dof, double value,
                       TimePoint now, std::vector<std::uint8_t>& woken) {
  const std::size_t d = core::index_of(dof);
  if (!lamps[i].can(d) || !std::isfinite(value)) return;
  fresh_.fill(false);
  begin(kOwn, words_[kOwn].fade_id + 1, 0, now);
  words_[kOwn].fixtures[i].set(dof, lamps[i].range[d].clamp(value));
  changed_[i] = 1;
  retarget_all(lamps, now, woken);
}

void Sources::release_own(std::size_t i, std::span<const Lamp> lamps, double fade_s, TimePoint now,
                          std::vector<std::uint8_t>& woken) {
  if (words_[kOwn].fixtures[i].present() == 0) return;
  fresh_.fill(false);
  begin(kOwn, words_[kOwn].fade_id + 1, fade_s, now);
  words_[kOwn].fixtures[i] = {};
  changed_[i] = 1;
  retarget_all(lamps, now, woken);
}

void Sources::recall_own(std::size_t i, const Lamp& lamp, const FixtureState& own) {
  for (std::size_t d = 0; d < kDofs; ++d)
    if (const Dof dof = static_cast<Dof>(d);
        lamp.can(d) && own.has(dof) && std::isfinite(own.get(dof)))
      words_[kOwn].fixtures[i].set(dof, lamp.range[d].clamp(own.get(dof)));
}

void Sources::retarget_all(std::span<const Lamp> lamps, TimePoint now,
                           std::vector<std::uint8_t>& woken) {
  for (std::size_t i = 0; i < lamps.size(); ++i) {
    if (changed_[i] == 0) continue;
    changed_[i] = 0;
    woken[i] = 1;
    for (std::size_t d = 0; d < kDofs; ++d)
      if (lamps[i].can(d)) retarget(i, lamps[i], static_cast<Dof>(d), now);
  }
}

int Sources::winner(std::size_t lamp, Dof dof) const {
  for (int s = kSources - 1; s >= 0; --s)
    if (words_[static_cast<std::size_t>(s)].fixtures[lamp].has(dof)) return s;
  return kDefault;
}

/// How long the way to a new target takes: the winner's new fade; or the new fade of the source
/// that let go; or what is left of the winner's running fade.
double Sources::seconds_for(const Track& track, int winner, TimePoint now) const {
  const auto w = static_cast<std::size_t>(winner);
  const auto before = static_cast<std::size_t>(track.winner);
  if (winner != kDefault && fresh_[w]) return words_[w].fade_s;
  if (winner != track.winner && track.winner != kDefault && fresh_[before])
    return words_[before].fade_s;
  if (winner == kDefault) return 0;
  return words_[w].fade_s * (1 - progress_of(w, now));
}

bool Sources::retarget(std::size_t i, const Lamp& lamp, Dof dof, TimePoint now) {
  Track& t = track(i, core::index_of(dof));
  const int now_winner = winner(i, dof);
  const double target = now_winner == kDefault
                            ? lamp.base.get(dof)
                            : words_[static_cast<std::size_t>(now_winner)].fixtures[i].get(dof);
  const bool restarted = now_winner != kDefault && fresh_[static_cast<std::size_t>(now_winner)];
  const bool turned = restarted || target != t.fade.target();
  if (turned) t.fade.start(t.sent, target, now, seconds_for(t, now_winner, now));
  t.winner = now_winner;
  return turned;
}

void Sources::remember(const std::array<std::uint64_t, kSources>& fade_ids) {
  for (std::size_t s = 0; s < kSources; ++s) words_[s].fade_id = fade_ids[s];
}

void Sources::stand_on(std::span<const Lamp> lamps, const SourceState& cue) {
  fresh_[kCue] = true;
  for (std::size_t i = 0; i < lamps.size(); ++i) hear_source(kCue, lamps[i], i, cue);
  fresh_[kCue] = false;
  cue_ = true;
}

void Sources::carry(std::size_t i, const Lamp& lamp, const Sources& before, std::size_t j,
                    const Lamp& was) {
  for (std::size_t d = 0; d < kDofs; ++d) {
    if (!lamp.can(d) || !was.can(d)) continue;
    const core::Range range = lamp.range[d];
    Track& t = track(i, d) = before.track(j, d);
    t.fade.confine(range.least, range.most);
    t.sent = range.clamp(t.sent);
  }
  for (std::size_t s = 0; s < kSources; ++s) words_[s].fixtures[i] = before.words_[s].fixtures[j];
}

void Sources::carry_fades(const Sources& before) {
  for (std::size_t s = 0; s < kSources; ++s) {
    words_[s].fade_id = before.words_[s].fade_id;
    words_[s].fade_s = before.words_[s].fade_s;
  }
  start_ = before.start_;
  cue_ = before.cue_;
}

}  // namespace chiaro::rig
