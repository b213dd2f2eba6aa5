// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/box_words.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <vector>

namespace chiaro::daemon {
namespace {

using core::Dof;
using core::FixtureState;
using Slots = decltype(rig::Sent::Port::slots);  // eight to a word
static_assert(std::tuple_size_v<Slots> % sizeof(std::uint64_t) == 0);

// One function says the order of the words; Put and Take walk it in the two directions, and Count
// measures it, so that the three cannot disagree.
class Put {
 public:
  explicit Put(std::span<std::uint64_t> words) : next_(words.data()) {}
  void word(std::uint64_t value) { *next_++ = value; }
  void operator()(const std::uint64_t& v) { word(v); }
  void operator()(const std::int64_t& v) { word(static_cast<std::uint64_t>(v)); }
  void operator()(const double& v) { word(std::bit_cast<std::uint64_t>(v)); }
  void operator()(const bool& v) { word(v ? 1 : 0); }
  void operator()(const FixtureState& v) {
    word(v.present());
    for (std::size_t d = 0; d < core::kDofs; ++d) (*this)(v.get(static_cast<Dof>(d)));
  }
  template <class T>
  void small(const T& v) {
    word(static_cast<std::uint64_t>(v));
  }
  /// Eight to a word.
  void bytes(const std::vector<std::uint8_t>& v) {
    for (std::size_t at = 0; at < v.size(); at += 8) {
      std::uint64_t packed = 0;
      for (std::size_t i = at; i < std::min(at + 8, v.size()); ++i)
        packed |= std::uint64_t{v[i]} << 8u * (i - at);
      word(packed);
    }
  }
  void slots(const Slots& v) {
    std::memcpy(next_, v.data(), v.size());
    next_ += v.size() / sizeof(std::uint64_t);
  }

 private:
  std::uint64_t* next_;
};

class Take {
 public:
  explicit Take(std::span<const std::uint64_t> words) : next_(words.data()) {}
  std::uint64_t word() { return *next_++; }
  void operator()(std::uint64_t& v) { v = word(); }
  void operator()(std::int64_t& v) { v = static_cast<std::int64_t>(word()); }
  void operator()(double& v) { v = std::bit_cast<double>(word()); }
  void operator()(bool& v) { v = word() != 0; }
  void operator()(FixtureState& v) {
    const std::uint64_t present = word();
    v = {};
    for (std::size_t d = 0; d < core::kDofs; ++d) {
      double value = 0;
      (*this)(value);
      if ((present >> d & 1u) != 0) v.set(static_cast<Dof>(d), value);
    }
  }
  template <class T>
  void small(T& v) {
    v = static_cast<T>(word());
  }
  void bytes(std::vector<std::uint8_t>& v) {
    for (std::size_t at = 0; at < v.size(); at += 8) {
      const std::uint64_t packed = word();
      for (std::size_t i = at; i < std::min(at + 8, v.size()); ++i)
        v[i] = static_cast<std::uint8_t>(packed >> 8u * (i - at) & 0xffu);
    }
  }
  void slots(Slots& v) {
    std::memcpy(v.data(), next_, v.size());
    next_ += v.size() / sizeof(std::uint64_t);
  }

 private:
  const std::uint64_t* next_;
};

class Count {
 public:
  template <class T>
  void operator()(const T&) {
    ++words;
  }
  void operator()(const FixtureState&) { words += 1 + core::kDofs; }
  template <class T>
  void small(const T&) {
    ++words;
  }
  void bytes(const std::vector<std::uint8_t>& v) { words += (v.size() + 7) / 8; }
  void slots(const Slots& v) { words += v.size() / sizeof(std::uint64_t); }
  std::size_t words = 0;
};

template <class Walk, class Tried>
void walk_tried(Walk& walk, Tried& tried) {
  walk.small(tried.universe);
  walk.small(tried.slot);
  walk.small(tried.level);
}

template <class Walk, class Latch>
void walk_latch(Walk& walk, Latch& latch) {
  walk(latch.on);
  walk(latch.id);
}

template <class Walk, class Wanted>
void walk_wanted(Walk& walk, Wanted& wanted) {
  walk(wanted.studio_fingerprint);
  walk(wanted.posted_ns);
  for (auto& source : wanted.sources) {
    walk(source.fade_id);
    walk(source.fade_s);
    for (auto& state : source.fixtures) walk(state);
  }
  for (auto& master : wanted.masters) walk(master);
  for (auto& id : wanted.master_id) walk(id);
  walk(wanted.blackout);
  walk(wanted.blackout_id);
  walk.bytes(wanted.marks);
  for (auto& id : wanted.release_id) walk(id);
  walk(wanted.blind);
  walk_latch(walk, wanted.motion_stop);
  walk_latch(walk, wanted.motion_armed);
  for (auto& tried : wanted.tried) walk_tried(walk, tried);
  walk(wanted.tried_until_ns);
}

template <class Walk, class Port>
void walk_port(Walk& walk, Port& port) {
  walk.small(port.universe);
  walk.small(port.health);
  walk(port.rate_hz);
  walk(port.frames);
  walk(port.failed);
  walk(port.late);
  walk(port.missed);
  walk(port.jitter_us_p50);
  walk(port.jitter_us_p99);
  walk(port.jitter_us_p999);
  walk.slots(port.slots);
}

template <class Walk, class Sent>
void walk_sent(Walk& walk, Sent& sent) {
  walk(sent.studio_fingerprint);
  walk(sent.sent_ns);
  for (auto& state : sent.fixtures) walk(state);
  for (auto& state : sent.held) walk(state);
  for (auto& source : sent.sources) {
    walk(source.fade_id);
    walk(source.fade_s);
    for (auto& state : source.fixtures) walk(state);
  }
  for (auto& master : sent.masters) walk(master);
  for (auto& id : sent.master_id) walk(id);
  for (auto& id : sent.fade_id) walk(id);
  for (auto& progress : sent.fade_progress) walk(progress);
  walk.small(sent.caution);
  walk(sent.blackout);
  walk(sent.blackout_id);
  walk(sent.refused);
  walk.bytes(sent.marks);
  walk.bytes(sent.own_marks);
  walk.bytes(sent.limited);
  walk(sent.blind);
  walk_latch(walk, sent.motion_stop);
  walk_latch(walk, sent.motion_armed);
  walk.small(sent.axes_waiting);
  for (auto& circuit : sent.circuits) {
    walk(circuit.draw_w);
    walk(circuit.scale);
  }
  walk.small(sent.cue.playing);
  walk(sent.cue.number);
  walk.small(sent.cue.cues);
  walk(sent.cue.follow_s);
  for (auto& port : sent.ports) walk_port(walk, port);
  for (auto& ask : sent.asks) walk(ask);
  walk(sent.asks_id);
  walk(sent.real_time);
  walk(sent.dry_run);
}

}  // namespace

rig::Wanted sized_wanted(const studio::Studio& studio) {
  rig::Wanted wanted;
  for (auto& source : wanted.sources) source.fixtures.resize(studio.fixtures.size());
  wanted.marks.resize(studio.fixtures.size());
  wanted.release_id.resize(studio.fixtures.size());
  return wanted;
}

rig::Sent sized_sent(const studio::Studio& studio) {
  rig::Sent sent;
  sent.fixtures.resize(studio.fixtures.size());
  sent.held.resize(studio.fixtures.size());
  for (auto& source : sent.sources) source.fixtures.resize(studio.fixtures.size());
  sent.marks.resize(studio.fixtures.size());
  sent.own_marks.resize(studio.fixtures.size());
  sent.limited.resize(studio.fixtures.size());
  sent.circuits.resize(studio.circuits.size());
  sent.ports.resize(studio.outputs.size());
  sent.asks.resize(studio::asked_of_brain(studio).size());
  return sent;
}

BoxFormat wanted_format(const studio::Studio& studio) {
  Count count;
  const rig::Wanted wanted = sized_wanted(studio);
  walk_wanted(count, wanted);
  return {BoxKind::wanted, studio.fingerprint, count.words};
}

BoxFormat sent_format(const studio::Studio& studio) {
  Count count;
  const rig::Sent sent = sized_sent(studio);
  walk_sent(count, sent);
  return {BoxKind::sent, studio.fingerprint, count.words};
}

void to_words(const rig::Wanted& wanted, std::size_t fixtures, std::span<std::uint64_t> words) {
  rig::Wanted padded = wanted;
  for (auto& source : padded.sources) source.fixtures.resize(fixtures);
  padded.marks.resize(fixtures);
  padded.release_id.resize(fixtures);
  Put put(words);
  walk_wanted(put, padded);
}

void from_words(std::span<const std::uint64_t> words, rig::Wanted& wanted) {
  Take take(words);
  walk_wanted(take, wanted);
}

void to_words(const rig::Sent& sent, std::span<std::uint64_t> words) {
  Put put(words);
  walk_sent(put, sent);
}

void from_words(std::span<const std::uint64_t> words, rig::Sent& sent) {
  Take take(words);
  walk_sent(take, sent);
}

}  // namespace chiaro::daemon
