// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/output/desk.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "controller/daemon/output/real_time.h"

namespace chiaro::daemon {
namespace {

using ports::TimePoint;

constexpr ports::Duration kRetry = std::chrono::seconds(2);
/// A fader this close to the level has taken hold of it.
constexpr double kPickUp = 0.03;
/// While a person moves a fader its level is what was wished, not what the last report says.
constexpr ports::Duration kReportLag = std::chrono::milliseconds(400);
/// Often enough for a hand on a fader, seldom enough for the loop's list of wishes.
constexpr ports::Duration kFaderPace = std::chrono::milliseconds(20);
constexpr ports::Duration kRenewFlash = rig::kFlashLease / 4;

std::string number_word(double number) {
  std::string word = std::to_string(number);
  while (word.back() == '0') word.pop_back();
  if (word.back() == '.') word.pop_back();
  return word;
}

}  // namespace

/// A fader or encoder on its way.
struct Desk::Fader {
  bool attached = false;
  bool any = false;
  double last = 0;        ///< where the fader itself was
  double aimed = 0;       ///< what was wished last
  double pending = 0;     ///< what is to be wished
  bool waits = false;     ///< `pending` is newer than `aimed`
  TimePoint wished_at{};  ///< zero: never
};

struct Desk::Surface {
  SurfacePlan plan;
  std::unique_ptr<ports::Surface> port;
  TimePoint next_try;
  bool told_lost = false, was_good = false;
  std::map<std::string, Fader> faders;  ///< by control
  std::map<std::string, std::pair<double, std::string>> shown;

  drivers::SurfaceControl::Kind kind_of(const std::string& control) const {
    for (const auto& each : plan.settings.controls)
      if (each.name == control) return each.kind;
    return drivers::SurfaceControl::Kind::button;
  }
};

Desk::Desk(Hand& hand, drivers::Surroundings& around, SurfacePlans plans, bool real_time)
    : hand_(hand), around_(around), plans_of_(std::move(plans)), real_time_(real_time) {}
Desk::~Desk() { end(); }

void Desk::end() {
  ending_ = true;
  if (thread_.joinable()) thread_.join();
  ending_ = false;
  surfaces_.clear();
  flashing_.clear();
}

void Desk::follow(const studio::Studio& studio, const rig::Sent& report) {
  if (!begun_ || studio.fingerprint != fingerprint_) {
    end();
    begin(studio);
  }
  if (surfaces_.empty() || report.studio_fingerprint != fingerprint_) return;
  {
    const std::scoped_lock lock(mutex_);
    told_ = report;
  }
  fresh_ = true;
  if (around_.threads && !thread_.joinable()) thread_ = std::thread([this] { run(); });
}

void Desk::begin(const studio::Studio& studio) {
  begun_ = true;
  fingerprint_ = studio.fingerprint;
  studio_ = studio;
  for (SurfacePlan& plan : plans_of_(studio)) {
    auto made = drivers::make_surface(plan.driver, plan.settings, around_);
    const std::scoped_lock lock(mutex_);
    if (!made) {
      for (const auto& problem : made.problems()) problems_.push_back(problem);
      continue;
    }
    surfaces_.push_back(std::make_unique<Surface>());
    surfaces_.back()->plan = std::move(plan);
    surfaces_.back()->port = std::move(*made);
  }
}

core::Problems Desk::take_problems() {
  const std::scoped_lock lock(mutex_);
  return std::exchange(problems_, {});
}

void Desk::run() {
  if (real_time_) take_turn_below_loop();
  while (!ending_) {
    tick();
    around_.clock.sleep_until(around_.clock.now() + kTick);
  }
}

void Desk::tick() {
  const TimePoint now = around_.clock.now();
  const bool fresh = fresh_.exchange(false);
  if (fresh) {
    const std::scoped_lock lock(mutex_);
    sent_ = told_;
  }
  for (auto& surface : surfaces_) {
    if (surface->port->health() != ports::PortHealth::good) {
      if (std::exchange(surface->was_good, false)) stop_for_safety(*surface);
      open(*surface, now);
    }
    if (surface->port->health() != ports::PortHealth::good) continue;
    surface->was_good = true;
    for (const auto& event : surface->port->listen(now))
      for (const BoundControl& bound : surface->plan.controls)
        if (bound.control == event.control) act(*surface, bound, event.value, now);
    for (const BoundControl& bound : surface->plan.controls) {
      const auto fader = surface->faders.find(bound.control);
      if (fader == surface->faders.end() || !fader->second.waits) continue;
      if (now - fader->second.wished_at < kFaderPace) continue;
      fader->second.waits = false;
      fader->second.aimed = fader->second.pending;
      fader->second.wished_at = now;
      set(bound.act, fader->second.aimed);
    }
    if (fresh) show(*surface);
  }
  hold_flashes(now);
}

void Desk::open(Surface& surface, TimePoint now) {
  if (now < surface.next_try) return;
  surface.next_try = now + kRetry;
  const auto opened = surface.port->open();
  surface.shown.clear();
  if (opened) {
    surface.faders.clear();  // who knows where they stand now
    surface.told_lost = false;
    return;
  }
  if (std::exchange(surface.told_lost, true)) return;
  const std::scoped_lock lock(mutex_);
  for (core::Problem problem : opened.problems()) {
    problem.what = "surface '" + surface.plan.name + "': " + problem.what + "; trying again";
    problem.warning = true;
    problems_.push_back(problem);
  }
}

/// A stop contact that can no longer be read may be pressed: motors stand still until a person
/// says otherwise. Light stays, because dark is not safe.
void Desk::stop_for_safety(const Surface& surface) {
  Wish stop;
  stop.kind = Wish::Kind::motion_stop;
  stop.on = true;
  for (const BoundControl& bound : surface.plan.controls)
    if (bound.act.kind == Act::Kind::motion_stop && bound.act.press == Act::Press::latch)
      (void)hand_.wish(stop);
}

void Desk::act(Surface& surface, const BoundControl& bound, double value, TimePoint now) {
  using Kind = drivers::SurfaceControl::Kind;
  const Act& act = bound.act;
  if (act.kind == Act::Kind::ask) {
    Wish wish;
    wish.kind = Wish::Kind::ask;
    wish.studio = studio_.fingerprint;
    wish.fixture = act.asked;
    const bool turned = surface.kind_of(bound.control) == Kind::encoder;
    wish.number = turned ? value : value >= 0.5 ? 1 : 0;
    if (wish.number != 0) (void)hand_.wish(wish);
    return;
  }
  if (act.kind != Act::Kind::master && act.kind != Act::Kind::level)
    return press(act, value >= 0.5, now);
  Fader& fader = surface.faders[bound.control];
  const Kind kind = surface.kind_of(bound.control);
  const bool moving = fader.wished_at != TimePoint{} && now - fader.wished_at < kReportLag;
  const double level = fader.waits ? fader.pending : moving ? fader.aimed : level_of(act);
  if (kind == Kind::button) {  // a key that sets full, and gives back
    if (value >= 0.5) set(act, 1);
    return;
  }
  if (kind == Kind::encoder) {
    fader.pending = std::clamp(level + value * act.step, 0.0, 1.0);
    fader.waits = true;
    return;
  }
  if (!moving && !fader.waits && std::abs(fader.aimed - level) > kPickUp)
    fader.attached = false;  // somebody else has moved it since
  const bool crossed = fader.any && (fader.last - level) * (value - level) <= 0;
  fader.attached = fader.attached || crossed || std::abs(value - level) <= kPickUp;
  fader.last = value;
  fader.any = true;
  if (!fader.attached) return;
  fader.pending = std::clamp(value, 0.0, 1.0);
  fader.waits = true;
}

bool Desk::is_on(const Act& act) const {
  switch (act.kind) {
    case Act::Kind::blackout:
      return sent_.blackout;
    case Act::Kind::motion_stop:
      return sent_.motion_stop.on;
    case Act::Kind::motion_arm:
      return sent_.motion_armed.on;
    case Act::Kind::blind:
      return sent_.blind;
    case Act::Kind::mark:
      for (std::size_t i = 0; i < studio_.fixtures.size() && i < sent_.marks.size(); ++i)
        if ((act.fixture == "*" || act.fixture == studio_.fixtures[i].name) &&
            rig::has(sent_.own_marks[i], act.mark))
          return true;
      return false;
    default:
      return false;
  }
}

void Desk::press(const Act& act, bool pressed, TimePoint now) {
  if (!pressed && act.press != Act::Press::follow) return;
  const bool on = act.press == Act::Press::toggle  ? !is_on(act)
                  : act.press == Act::Press::clear ? false
                                                   : pressed;
  Wish wish;
  wish.on = on;
  switch (act.kind) {
    case Act::Kind::blackout:
      hand_.wish_blackout(on);
      sent_.blackout = on;  // a second press may come before the report
      return;
    case Act::Kind::motion_stop:
      wish.kind = Wish::Kind::motion_stop;
      sent_.motion_stop.on = on;
      break;
    case Act::Kind::motion_arm:
      wish.kind = Wish::Kind::motion_arm;
      sent_.motion_armed.on = on;
      break;
    case Act::Kind::blind:
      wish.kind = Wish::Kind::blind;
      sent_.blind = on;
      break;
    case Act::Kind::mark:
      wish.kind = Wish::Kind::mark;
      wish.mark = act.mark;
      if (act.mark == rig::Mark::flash && on) flashing_[act.fixture] = now;
      if (act.mark == rig::Mark::flash && !on) flashing_.erase(act.fixture);
      return this->wish(wish, act.fixture);
    case Act::Kind::release:
      wish.kind = Wish::Kind::release;
      if (!pressed) return;
      return this->wish(wish, act.fixture);
    case Act::Kind::cue_go:
      wish.kind = Wish::Kind::cue_go;
      break;
    case Act::Kind::cue_back:
      wish.kind = Wish::Kind::cue_back;
      break;
    case Act::Kind::cue_off:
      wish.kind = Wish::Kind::cue_off;
      break;
    case Act::Kind::cue_to:
      wish.kind = Wish::Kind::cue_to;
      wish.number = act.cue;
      break;
    case Act::Kind::none:
    case Act::Kind::master:
    case Act::Kind::level:
    case Act::Kind::ask:
      return;
  }
  if (pressed || act.press == Act::Press::follow) (void)hand_.wish(wish);
}

/// A flash falls by itself when its button can no longer say that it is held.
void Desk::hold_flashes(TimePoint now) {
  for (auto& [fixture, renewed] : flashing_) {
    if (now - renewed < kRenewFlash) continue;
    renewed = now;
    Wish wish;
    wish.kind = Wish::Kind::mark;
    wish.mark = rig::Mark::flash;
    wish.on = true;
    this->wish(wish, fixture);
  }
}

void Desk::wish(Wish wish, const std::string& fixture) {
  const auto index = studio_.fixture_index(fixture);
  if (!index && fixture != "*") return;
  wish.studio = studio_.fingerprint;
  wish.fixture = index ? static_cast<std::uint32_t>(*index) : Wish::kEvery;
  (void)hand_.wish(wish);
}

void Desk::set(const Act& act, double share) {
  Wish wish;
  if (act.kind == Act::Kind::master) {
    wish.kind = Wish::Kind::master;
    wish.master = act.master;
    wish.number = share;
    (void)hand_.wish(wish);
    return;
  }
  const core::Range range = range_of(act);
  wish.kind = Wish::Kind::level;
  wish.dof = act.dof;
  wish.number = range.least + share * (range.most - range.least);
  this->wish(wish, act.fixture);
}

/// Of the act's lamp; of all of them together that of the first that has the DOF.
core::Range Desk::range_of(const Act& act) const {
  for (const auto& fixture : studio_.fixtures) {
    if (act.fixture != "*" && act.fixture != fixture.name) continue;
    for (const auto& [dof, range] : fixture.ranges())
      if (dof == act.dof) return range;
  }
  return {0, 1};
}

double Desk::level_of(const Act& act) const {
  if (act.kind == Act::Kind::master) return sent_.masters[static_cast<std::size_t>(act.master)];
  for (std::size_t i = 0; i < studio_.fixtures.size() && i < sent_.held.size(); ++i)
    if (act.fixture == "*" || act.fixture == studio_.fixtures[i].name) {
      const core::Range range = range_of(act);
      const double width = std::max(range.most - range.least, 1e-9);
      return std::clamp((sent_.held[i].get(act.dof) - range.least) / width, 0.0, 1.0);
    }
  return 0;
}

double Desk::tally(const BoundControl& bound, std::string& word) const {
  const Act& act = bound.act;
  switch (bound.tally) {
    case Tally::none:
      return 0;
    case Tally::blackout:
      return sent_.blackout ? 1 : 0;
    case Tally::motion_stopped:
      return sent_.motion_stop.on ? 1 : 0;
    case Tally::motion_armed:
      return sent_.motion_armed.on ? 1 : 0;
    case Tally::holding:
      return sent_.caution == rig::Caution::hold || sent_.caution == rig::Caution::fade_to_safe ? 1
                                                                                                : 0;
    case Tally::fault:
      for (const auto& port : sent_.ports)
        if (static_cast<ports::PortHealth>(port.health) != ports::PortHealth::good) return 1;
      return 0;
    case Tally::lit:
      for (std::size_t i = 0; i < studio_.fixtures.size() && i < sent_.fixtures.size(); ++i)
        if ((act.fixture == "*" || act.fixture == studio_.fixtures[i].name) &&
            sent_.fixtures[i].get(core::Dof::intensity) > 0)
          return 1;
      return 0;
    case Tally::master:
    case Tally::level: {
      const double level = level_of(act);
      word = std::to_string(static_cast<int>(std::lround(100 * level)));
      return level;
    }
    case Tally::marked:
      return is_on(act) ? 1 : 0;
    case Tally::cue:
      if (sent_.cue.playing < 0) return 0;
      word = number_word(sent_.cue.number);
      return act.kind != Act::Kind::cue_to || sent_.cue.number == act.cue ? 1 : 0;
  }
  return 0;
}

void Desk::show(Surface& surface) {
  for (const BoundControl& bound : surface.plan.controls) {
    if (bound.tally == Tally::none) continue;
    std::string word;
    const double value = tally(bound, word);
    auto& shown = surface.shown;
    const auto before = shown.find(bound.control);
    if (before != shown.end() && before->second == std::pair(value, word)) continue;
    shown[bound.control] = {value, word};
    surface.port->show(bound.control, value, word);
  }
}

}  // namespace chiaro::daemon
