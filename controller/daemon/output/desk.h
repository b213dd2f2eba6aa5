// SPDX-License-Identifier: Apache-2.0
// Control surfaces at the hand: buttons, faders and stop contacts act here, whether or not a brain
// runs, and lamps and relays show what is being sent. A surface is plugged in as a `SurfacePlan`:
// which driver with which settings, and for each of its controls what it does (`Act`) and what it
// shows (`Tally`).
//
// What a control does becomes a wish, as on the control socket: a blackout has its own way and is
// on the wire with the next frame; levels are the source `own` (rig/wanted.h), above the look and
// the panel's faders until somebody moves those or applies a look; masters are the newest of all
// hands. Contacts settle in their driver (debounce); latches stay until somebody releases them.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "controller/core/result.h"
#include "controller/daemon/output/hand.h"
#include "drivers/registry.h"

namespace chiaro::daemon {

/// What a control does.
struct Act {
  enum class Kind : std::uint8_t {
    none,
    blackout,
    motion_stop,
    motion_arm,
    blind,
    master,   ///< fader or encoder
    level,    ///< fader or encoder: a DOF of `fixture`, over its whole range
    release,  ///< lets the faders of `fixture` go
    mark,     ///< `mark` on `fixture`
    cue_go,
    cue_back,
    cue_off,
    cue_to,  ///< `cue`
    ask      ///< `asked`, of the brain: a press, or an encoder's detents
  };
  /// Of blackout, motion stop, arming, blind and marks.
  enum class Press : std::uint8_t {
    latch,   ///< pressed: on. Nothing here releases it: for stop contacts and mushroom buttons
    clear,   ///< pressed: off. The button beside it
    toggle,  ///< pressed: the other way round
    follow   ///< on while pressed
  };
  Kind kind = Kind::none;
  Press press = Press::toggle;
  rig::Master master = rig::Master::grand;
  std::string fixture = "*";  ///< "*" = every one
  core::Dof dof = core::Dof::intensity;
  rig::Mark mark = rig::Mark::flash;
  double cue = 1;
  std::uint32_t asked = 0;  ///< which of studio::asked_of_brain
  double step = 0.01;       ///< of an encoder: what a detent adds, as a share of the whole range
};

/// What a control's lamp, motor or relay shows; 0..1.
enum class Tally : std::uint8_t {
  none,
  blackout,
  motion_stopped,
  motion_armed,
  holding,  ///< no brain is heard
  fault,    ///< a port is not good
  lit,      ///< any lamp is on; with a fixture in the act: that one
  master,   ///< the act's
  level,    ///< the act's fixture and DOF, over its range
  marked,   ///< the act's mark on the act's fixture
  cue       ///< 1 while the act's cue is on stage (of go, back and off: any); its number as a word
};

struct BoundControl {
  std::string control;  ///< a name in `settings.controls`
  Act act;
  Tally tally = Tally::none;
};

struct SurfacePlan {
  std::string name, driver;  ///< as people call it; a line of drivers.def
  drivers::SurfaceSettings settings;
  std::vector<BoundControl> controls;
};
using SurfacePlans = std::function<std::vector<SurfacePlan>(const studio::Studio&)>;

/// Runs on a thread of its own while the studio has surfaces. A fader takes hold only once it has
/// come to where the level is, so that nothing jumps; then it leads.
class Desk {
 public:
  /// Contacts must be looked at often: a blackout is to be on the wire 25 ms after it has settled.
  static constexpr ports::Duration kTick = std::chrono::milliseconds(2);

  /// All references outlive this. `real_time`: its thread may ask for a turn.
  Desk(Hand& hand, drivers::Surroundings& around, SurfacePlans plans, bool real_time);
  ~Desk();
  Desk(const Desk&) = delete;
  Desk& operator=(const Desk&) = delete;

  /// The studio that is being sent and the newest report of it: starts, changes and ends the
  /// surfaces, and lights their lamps. One thread (the housekeeper's), as often as it likes.
  void follow(const studio::Studio& studio, const rig::Sent& report);
  /// What surfaces ran into, when that is news. The housekeeper's thread.
  core::Problems take_problems();

  /// One round: listens, acts, shows, opens again what was lost. The desk's thread; tests without
  /// one call it themselves.
  void tick();

 private:
  struct Fader;
  struct Surface;
  void begin(const studio::Studio& studio);
  void end();
  void run();
  void open(Surface& surface, ports::TimePoint now);
  void stop_for_safety(const Surface& surface);
  void act(Surface& surface, const BoundControl& bound, double value, ports::TimePoint now);
  void press(const Act& act, bool on, ports::TimePoint now);
  void set(const Act& act, double share);
  core::Range range_of(const Act& act) const;
  double level_of(const Act& act) const;
  bool is_on(const Act& act) const;
  void wish(Wish wish, const std::string& fixture);
  void hold_flashes(ports::TimePoint now);
  void show(Surface& surface);
  double tally(const BoundControl& bound, std::string& word) const;

  Hand& hand_;
  drivers::Surroundings& around_;
  const SurfacePlans plans_of_;
  const bool real_time_;

  std::uint64_t fingerprint_ = 0;
  bool begun_ = false;
  std::vector<std::unique_ptr<Surface>> surfaces_;
  studio::Studio studio_;
  std::map<std::string, ports::TimePoint> flashing_;  ///< fixture: when its lease was renewed

  mutable std::mutex mutex_;
  rig::Sent told_;  ///< under the mutex: the newest report
  core::Problems problems_;

  rig::Sent sent_;  ///< the desk thread's copy
  std::atomic<bool> fresh_{false}, ending_{false};
  std::thread thread_;
};

}  // namespace chiaro::daemon
