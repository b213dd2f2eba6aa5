// SPDX-License-Identifier: Apache-2.0
#include "controller/rig/governor.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "controller/rig/fade.h"
#include "controller/rig/flash_guard.h"

namespace chiaro::rig {

using core::Dof;
using core::FixtureState;
using core::kDofs;
using ports::TimePoint;

namespace {

constexpr int kDefault = -1;  // winner when no source has an opinion
constexpr double kLongestFade = 24 * 3600;

/// What is fixed about one lamp.
struct Lamp {
  std::uint32_t has = 0;  ///< bit per DOF
  std::array<core::Range, kDofs> range{};
  double slew_per_s = 0, safe = 0;
  bool ignores_blackout = false;
  std::optional<Master> master;  ///< beside the grand master
  FixtureState base;             ///< when nobody has an opinion

  bool can(std::size_t d) const { return (has >> d & 1u) != 0; }
};

/// What one DOF is doing.
struct Track {
  Fade fade;
  FlashGuard guard;
  double sent = 0;  ///< before masters: where the next fade starts
  int winner = kDefault;
};

std::optional<Master> master_of(studio::Role role) {
  switch (role) {
    case studio::Role::key:
      return Master::key;
    case studio::Role::fill:
      return Master::fill;
    case studio::Role::back:
    case studio::Role::hair:
    case studio::Role::kicker:
      return Master::back;
    case studio::Role::background:
      return Master::background;
    case studio::Role::practical:
      return std::nullopt;
  }
  return std::nullopt;
}

Lamp lamp_of(const studio::Fixture& fixture, const FixtureState& placed, bool dark) {
  Lamp lamp;
  lamp.slew_per_s = fixture.limits.slew_per_s;
  lamp.safe = std::clamp(fixture.limits.safe_level, 0.0, fixture.limits.most);
  lamp.ignores_blackout = fixture.limits.ignores_blackout;
  lamp.master = master_of(fixture.role);
  if (!fixture.controlled) return lamp;
  auto ranges = fixture.ranges();
  ranges.emplace_back(Dof::intensity, core::Range{0, 1});
  for (const auto& [dof, range] : ranges) {
    const auto d = core::index_of(dof);
    lamp.has |= 1u << d;
    lamp.range[d] = range;
    if (dof == Dof::intensity) lamp.range[d] = {0, std::clamp(fixture.limits.most, 0.0, 1.0)};
    double value = placed.get(dof, is_light(dof) && dof != Dof::intensity ? 1 : 0);
    if (dof == Dof::cct && !placed.has(dof)) value = fixture.profile.emitter.cct.value;
    if (dof == Dof::intensity && dark) value = lamp.safe;
    lamp.base.set(dof, lamp.range[d].clamp(value));
  }
  return lamp;
}

double tidy_master(double level) { return std::isfinite(level) ? std::clamp(level, 0.0, 1.0) : 1; }

}  // namespace

struct Governor::State {
  State(const studio::Studio& studio, TimePoint now)
      : fingerprint(studio.fingerprint),
        safety(studio.safety),
        last_word(now),
        last_step(now),
        levels(studio.fixtures.size()) {}

  std::uint64_t fingerprint;
  studio::Safety safety;
  std::vector<Lamp> lamps;
  std::vector<Track> tracks;   ///< lamp * kDofs + DOF
  std::vector<double> slewed;  ///< by lamp: intensity after slew, before blackout
  std::array<SourceState, kSources> sources;
  std::array<TimePoint, kSources> fade_start{};
  std::array<bool, kSources> fresh{};  ///< its fade id is new in the word being taken
  std::array<double, kMasters> masters{1, 1, 1, 1, 1};
  bool blackout = false, refused = false, stepped = false, heard = false;
  std::uint64_t blackout_id = 0;
  TimePoint last_word, last_step;
  double safe_progress = 0;  ///< 0 = as wanted, 1 = every lamp at its safe level
  Caution caution = Caution::hold;
  AllowedLevels levels;

  Track& track(std::size_t lamp, std::size_t d) { return tracks[lamp * kDofs + d]; }
  const Track& track(std::size_t lamp, std::size_t d) const { return tracks[lamp * kDofs + d]; }

  void add(const Lamp& lamp, const FixtureState* held);
  void hear_source(std::size_t s, const SourceState& word, TimePoint now);
  int winner(std::size_t lamp, Dof dof) const;
  double seconds_for(const Track& track, int winner, TimePoint now) const;
  void retarget(std::size_t lamp, Dof dof, TimePoint now);
  void judge(TimePoint now, double elapsed);
  double master(const Lamp& lamp) const;
  void step(std::size_t lamp, TimePoint now, double elapsed);
  double limited(std::size_t lamp, double wanted, double elapsed);
};

void Governor::State::add(const Lamp& lamp, const FixtureState* held) {
  lamps.push_back(lamp);
  FixtureState& base = lamps.back().base;
  for (std::size_t d = 0; d < kDofs; ++d) {
    const Dof dof = static_cast<Dof>(d);
    if (held != nullptr && lamp.can(d) && held->has(dof))
      base.set(dof, lamp.range[d].clamp(held->get(dof)));
    Track track;
    track.fade = Fade(dof, base.get(dof));
    track.guard = FlashGuard(base.get(dof));
    track.sent = base.get(dof);
    tracks.push_back(track);
  }
  slewed.push_back(0);  // set by the first step
}

Governor::Governor(const studio::Studio& studio, TimePoint now, const Held* held)
    : state_(std::make_unique<State>(studio, now)) {
  const studio::Rig placed = studio::placed_rig(studio);
  const bool dark = studio.safety.power_up == studio::Safety::PowerUp::dark;
  for (std::size_t i = 0; i < studio.fixtures.size(); ++i) {
    const FixtureState known = i < placed.states.size() ? placed.states[i] : FixtureState{};
    const bool kept = !dark && held != nullptr && i < held->fixtures.size();
    state_->add(lamp_of(studio.fixtures[i], known, dark), kept ? &held->fixtures[i] : nullptr);
  }
  for (auto& source : state_->sources) source.fixtures.resize(studio.fixtures.size());
  if (held == nullptr) return;
  state_->blackout = held->blackout;  // latched until somebody releases it, power cut or not
  if (!dark)
    for (std::size_t m = 0; m < kMasters; ++m) state_->masters[m] = tidy_master(held->masters[m]);
}

Governor::~Governor() = default;
Governor::Governor(Governor&&) noexcept = default;
Governor& Governor::operator=(Governor&&) noexcept = default;

void Governor::State::hear_source(std::size_t s, const SourceState& word, TimePoint now) {
  SourceState& mine = sources[s];
  fresh[s] = word.fade_id != mine.fade_id;
  if (fresh[s]) {
    mine.fade_id = word.fade_id;
    mine.fade_s = std::isfinite(word.fade_s) ? std::clamp(word.fade_s, 0.0, kLongestFade) : 0;
    fade_start[s] = now;
  }
  for (std::size_t i = 0; i < lamps.size(); ++i) {
    FixtureState& into = mine.fixtures[i];
    into = {};
    if (i >= word.fixtures.size()) continue;
    for (std::size_t d = 0; d < kDofs; ++d) {
      const Dof dof = static_cast<Dof>(d);
      if (!lamps[i].can(d) || !word.fixtures[i].has(dof)) continue;
      const double value = word.fixtures[i].get(dof);
      if (std::isfinite(value)) into.set(dof, lamps[i].range[d].clamp(value));
    }
  }
}

int Governor::State::winner(std::size_t lamp, Dof dof) const {
  for (int s = kSources - 1; s >= 0; --s)
    if (sources[static_cast<std::size_t>(s)].fixtures[lamp].has(dof)) return s;
  return kDefault;
}

/// How long the way to a new target takes: the winner's new fade; or the new fade of the source
/// that let go; or what is left of the winner's running fade.
double Governor::State::seconds_for(const Track& track, int winner, TimePoint now) const {
  const auto w = static_cast<std::size_t>(winner);
  const auto before = static_cast<std::size_t>(track.winner);
  if (winner != kDefault && fresh[w]) return sources[w].fade_s;
  if (winner != track.winner && track.winner != kDefault && fresh[before])
    return sources[before].fade_s;
  if (winner == kDefault) return 0;
  return sources[w].fade_s * (1 - progress(fade_start[w], sources[w].fade_s, now));
}

void Governor::State::retarget(std::size_t lamp, Dof dof, TimePoint now) {
  Track& t = track(lamp, core::index_of(dof));
  const int now_winner = winner(lamp, dof);
  const double target = now_winner == kDefault
                            ? lamps[lamp].base.get(dof)
                            : sources[static_cast<std::size_t>(now_winner)].fixtures[lamp].get(dof);
  const bool restarted = now_winner != kDefault && fresh[static_cast<std::size_t>(now_winner)];
  if (restarted || target != t.fade.target())
    t.fade.start(t.sent, target, now, seconds_for(t, now_winner, now));
  t.winner = now_winner;
}

void Governor::take(const Wanted& wanted, TimePoint now) {
  State& s = *state_;
  const TimePoint posted{std::chrono::nanoseconds(wanted.posted_ns)};
  if (posted > now + std::chrono::seconds(1)) return;  // left over from before a reboot
  if (wanted.blackout_id != s.blackout_id) {
    s.blackout_id = wanted.blackout_id;
    s.blackout = wanted.blackout;
  }
  s.refused = wanted.studio_fingerprint != s.fingerprint;
  if (s.refused) return;
  s.heard = true;
  s.last_word = std::max(s.last_word, std::min(posted, now));
  for (std::size_t i = 0; i < kMasters; ++i) s.masters[i] = tidy_master(wanted.masters[i]);
  for (std::size_t i = 0; i < kSources; ++i) s.hear_source(i, wanted.sources[i], now);
  for (std::size_t i = 0; i < s.lamps.size(); ++i)
    for (std::size_t d = 0; d < kDofs; ++d)
      if (s.lamps[i].can(d)) s.retarget(i, static_cast<Dof>(d), now);
}

void Governor::refuse() { state_->refused = true; }
void Governor::set_blackout(bool on) { state_->blackout = on; }
bool Governor::blackout() const { return state_->blackout; }
Caution Governor::caution() const { return state_->caution; }

void Governor::State::judge(TimePoint now, double elapsed) {
  const double silence = std::chrono::duration<double>(now - last_word).count();
  const bool silent = !heard || now - last_word > kSilence;
  const bool to_safe =
      !refused && safety.fade_to_safe_after_s && silence >= *safety.fade_to_safe_after_s && silent;
  const double reach = safety.fade_to_safe_s > 0 ? elapsed / safety.fade_to_safe_s : 1;
  // The way back is as gentle as the way there: no lamp jumps because a program came back.
  safe_progress = std::clamp(safe_progress + (to_safe ? reach : -reach), 0.0, 1.0);
  caution = blackout                       ? Caution::blackout
            : to_safe || safe_progress > 0 ? Caution::fade_to_safe
            : silent || refused            ? Caution::hold
                                           : Caution::normal;
}

double Governor::State::master(const Lamp& lamp) const {
  const double grand = masters[static_cast<std::size_t>(Master::grand)];
  return lamp.master ? grand * masters[static_cast<std::size_t>(*lamp.master)] : grand;
}

/// Nothing passes `most` or outruns the slew limit; the first frame starts where it is told.
double Governor::State::limited(std::size_t i, double wanted, double elapsed) {
  const Lamp& lamp = lamps[i];
  const double level = lamp.range[core::index_of(Dof::intensity)].clamp(wanted);
  const double reach = lamp.slew_per_s * elapsed;
  if (lamp.slew_per_s <= 0 || !stepped) return slewed[i] = level;
  return slewed[i] += std::clamp(level - slewed[i], -reach, reach);
}

void Governor::State::step(std::size_t i, TimePoint now, double elapsed) {
  const Lamp& lamp = lamps[i];
  FixtureState& out = levels.fixtures_[i];
  for (std::size_t d = 0; d < kDofs; ++d) {
    if (!lamp.can(d)) continue;
    const Dof dof = static_cast<Dof>(d);
    Track& t = track(i, d);
    t.sent = t.fade.at(now);
    if (t.winner == static_cast<int>(Source::manual))
      t.guard.follow(t.sent);
    else if (is_light(dof))
      t.sent = t.guard.allow(t.sent, now);
    out.set(dof, t.sent);
  }
  if (!lamp.can(core::index_of(Dof::intensity))) return;
  Track& t = track(i, core::index_of(Dof::intensity));
  const double m = master(lamp);
  const double wanted = blend(Dof::intensity, t.sent * m, lamp.safe, safe_progress);
  const double level = limited(i, wanted, elapsed);
  if (level != wanted && m > 0 && safe_progress <= 0)
    t.sent = std::clamp(level / m, 0.0, 1.0);  // a new fade starts from what is really sent
  const bool dark = blackout && !lamp.ignores_blackout;
  out.set(Dof::intensity, dark ? 0 : level);
}

const AllowedLevels& Governor::step(TimePoint now) {
  State& s = *state_;
  const double elapsed = std::chrono::duration<double>(now - s.last_step).count();
  s.judge(now, elapsed);
  for (std::size_t i = 0; i < s.lamps.size(); ++i) s.step(i, now, elapsed);
  s.last_step = now;
  s.stepped = true;
  return s.levels;
}

Sent Governor::empty_report() const {
  Sent sent;
  sent.fixtures.resize(state_->lamps.size());
  sent.held.resize(state_->lamps.size());
  for (auto& source : sent.sources) source.fixtures.resize(state_->lamps.size());
  return sent;
}

void Governor::report(Sent& into) const {
  const State& s = *state_;
  into.studio_fingerprint = s.fingerprint;
  into.sent_ns = s.last_step.time_since_epoch().count();
  std::copy(s.levels.fixtures_.begin(), s.levels.fixtures_.end(), into.fixtures.begin());
  for (std::size_t i = 0; i < s.lamps.size(); ++i)
    for (std::size_t d = 0; d < kDofs; ++d)
      if (s.lamps[i].can(d)) into.held[i].set(static_cast<Dof>(d), s.track(i, d).sent);
  for (std::size_t k = 0; k < kSources; ++k) {
    const SourceState& from = s.sources[k];
    std::copy(from.fixtures.begin(), from.fixtures.end(), into.sources[k].fixtures.begin());
    into.fade_id[k] = into.sources[k].fade_id = from.fade_id;
    into.sources[k].fade_s = from.fade_s;
    into.fade_progress[k] = progress(s.fade_start[k], from.fade_s, s.last_step);
  }
  into.masters = s.masters;
  into.caution = s.caution;
  into.blackout = s.blackout;
  into.blackout_id = s.blackout_id;
  into.refused = s.refused;
}

void Governor::carry_on(const Governor& before, std::span<const std::ptrdiff_t> from) {
  State& s = *state_;
  const State& old = *before.state_;
  for (std::size_t i = 0; i < s.lamps.size(); ++i) {
    if (i >= from.size() || from[i] < 0) continue;
    const auto j = static_cast<std::size_t>(from[i]);
    for (std::size_t d = 0; d < kDofs; ++d) {
      if (!s.lamps[i].can(d) || !old.lamps[j].can(d)) continue;
      const Dof dof = static_cast<Dof>(d);
      const core::Range range = s.lamps[i].range[d];
      Track& t = s.track(i, d) = old.track(j, d);
      t.fade.confine(range.least, range.most);
      t.sent = range.clamp(t.sent);
      s.lamps[i].base.set(dof, range.clamp(old.lamps[j].base.get(dof)));
    }
    for (std::size_t k = 0; k < kSources; ++k)
      s.sources[k].fixtures[i] = old.sources[k].fixtures[j];
    s.slewed[i] = old.slewed[j];
  }
  for (std::size_t k = 0; k < kSources; ++k) {
    s.sources[k].fade_id = old.sources[k].fade_id;
    s.sources[k].fade_s = old.sources[k].fade_s;
  }
  s.fade_start = old.fade_start;
  s.masters = old.masters;
  s.blackout = old.blackout;
  s.blackout_id = old.blackout_id;
  s.heard = old.heard;
  s.last_word = old.last_word;
  s.last_step = old.last_step;
  s.stepped = old.stepped;
  s.safe_progress = old.safe_progress;
  s.refused = true;  // until the brain speaks of the new studio
}

std::string_view name_of(Caution caution) {
  switch (caution) {
    case Caution::normal:
      return "normal";
    case Caution::hold:
      return "hold";
    case Caution::fade_to_safe:
      return "fade to safe";
    case Caution::blackout:
      return "blackout";
  }
  return "?";
}

}  // namespace chiaro::rig
