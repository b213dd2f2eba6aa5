// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/output/show.h"

#include <algorithm>
#include <utility>

#include "controller/daemon/box_words.h"
#include "controller/daemon/output/cue_book.h"
#include "controller/daemon/output/port_plan.h"

namespace chiaro::daemon {
namespace {

constexpr ports::Duration kIdlePeriod = std::chrono::milliseconds(25);
/// Off stage as gently as a fader that is let go.
const rig::SourceState kNoCue{{}, 0, rig::kReleaseFade};
/// A report of every lamp and every source costs more than all the levels: a quarter of the frames
/// is plenty for people and brains, and of a hall of lamps a tenth.
constexpr ports::Duration kReportPeriod = std::chrono::milliseconds(100);
constexpr ports::Duration kLongReportPeriod = std::chrono::milliseconds(250);
constexpr std::size_t kLongReport = 40'000;  // words

std::ptrdiff_t find_port(const Show* before, const PortPlan& plan) {
  if (before == nullptr) return -1;
  const auto& ports = before->ports();
  for (std::size_t i = 0; i < ports.size(); ++i) {
    if (!ports[i] || ports[i]->driver() != plan.driver) continue;
    drivers::OutputSettings wanted = plan.settings;
    wanted.source_name = ports[i]->settings().source_name;  // a stream keeps the name it began with
    if (ports[i]->settings() == wanted) return static_cast<std::ptrdiff_t>(i);
  }
  return -1;
}

}  // namespace

Show::Show(const studio::Studio& studio, const Options& options, ports::TimePoint now,
           const rig::Held* held)
    : studio_(studio),
      plan_(patch::Plan::of(studio)),
      governor_(studio, now, held),
      frames_(plan_.blank_frames()),
      tried_(studio_, plan_),
      report_(sized_sent(studio)),
      wanted_(sized_wanted(studio)) {
  report_.dry_run = options.dry_run;
  report_.asks_id = static_cast<std::uint64_t>(now.time_since_epoch().count());
}

Show::~Show() {
  delete incoming_.load();
  delete outgoing_.load();
}

core::Result<std::unique_ptr<Show>> Show::make(const studio::Studio& studio, const Options& options,
                                               ports::World& world, const rig::Held* held,
                                               const Show* before, core::Problems& warnings) {
  std::unique_ptr<Show> show(new Show(studio, options, world.clock.now(), held));
  patch::Plan::of(studio, &warnings);
  for (const auto& fixture : studio.fixtures) {
    const auto index =
        before == nullptr ? std::nullopt : before->studio_.fixture_index(fixture.name);
    show->fixtures_before_.push_back(index ? static_cast<std::ptrdiff_t>(*index) : -1);
  }
  show->recall_cues(read_cues(world.state_folder, studio, warnings), held);
  for (const auto& output : studio.outputs) show->add_port(output, options, before, warnings);
  for (const auto& fixture : studio.fixtures) {
    Motor motor;
    if (const auto far = fixture.far_motor()) {
      for (std::size_t i = 0; i < studio.outputs.size(); ++i)
        if (studio.outputs[i].universe == far->patch.universe)
          motor.port = static_cast<std::ptrdiff_t>(i);
      motor.slot = static_cast<std::uint16_t>(far->patch.address - 1);
    }
    show->motors_.push_back(motor);
  }
  show->wanted_words_.resize(wanted_format(studio).words);
  const BoxFormat format = sent_format(studio);
  show->sent_words_.resize(format.words);
  auto writer = BoxWriter::create(world.runtime_folder / "sent.box", format);
  if (!writer) return writer.problems();
  show->writer_ = std::move(*writer);
  return show;
}

void Show::add_port(const studio::Output& output, const Options& options, const Show* before,
                    core::Problems& warnings) {
  const PortPlan plan = plan_of(studio_, output, options.cid);
  const std::ptrdiff_t old = find_port(before, plan);
  ports_before_.push_back(old);
  rates_.push_back(plan.rate_hz);
  const auto universes = plan_.universes();
  frame_of_port_.push_back(static_cast<std::size_t>(
      std::lower_bound(universes.begin(), universes.end(), output.universe) - universes.begin()));
  drivers::Surroundings& around = *options.around;
  ports_.push_back(
      old >= 0 ? nullptr
               : std::make_unique<PortSlot>(plan.driver, plan.settings,
                                            open_port(plan, options.dry_run, around, warnings),
                                            plan.rate_hz, around.clock, options.real_time));
}

void Show::recall_cues(std::unique_ptr<rig::CueList> list, const rig::Held* held) {
  cues_.take(list);
  if (held == nullptr || !held->cue) return;
  if (const rig::Cue* cue = cues_.stand_at(*held->cue)) governor_.stand_on(cue->state);
}

void Show::play(const rig::Cue* cue, ports::TimePoint now) {
  if (cue != nullptr) governor_.play(cue->state, cue->ahead, now);
}

void Show::obey_for(std::size_t fixture, const Wish& wish, ports::TimePoint now) {
  if (wish.kind == Wish::Kind::mark) governor_.mark(fixture, wish.mark, wish.on, now);
  if (wish.kind == Wish::Kind::level) governor_.set_level(fixture, wish.dof, wish.number, now);
  if (wish.kind == Wish::Kind::release) governor_.release(fixture, now);
  if (wish.kind == Wish::Kind::home) home(fixture);
}

void Show::home(std::size_t fixture) {
  if (fixture >= motors_.size() || !governor_.motion_armed() || governor_.motion_stopped()) return;
  const Motor& motor = motors_[fixture];
  if (motor.port < 0) return;
  ports_[static_cast<std::size_t>(motor.port)]->port().order(
      {ports::AxisOrder::Kind::home, motor.slot});
}

/// Motors that know an order to stop get it at once; the levels alone would let them run on to
/// where they were sent last.
void Show::stop_motors() {
  const bool stopped = governor_.motion_stopped();
  if (std::exchange(motors_stopped_, stopped) == stopped) return;
  using Kind = ports::AxisOrder::Kind;
  for (auto& port : ports_) port->port().order({stopped ? Kind::stop : Kind::release, 0});
}

void Show::obey_for_those_meant(const Wish& wish, ports::TimePoint now) {
  if (wish.studio != studio_.fingerprint) return;
  if (wish.fixture != Wish::kEvery) return obey_for(wish.fixture, wish, now);
  for (std::size_t i = 0; i < studio_.fixtures.size(); ++i) obey_for(i, wish, now);
}

void Show::obey(const Wish& wish, ports::TimePoint now) {
  switch (wish.kind) {
    case Wish::Kind::mark:
    case Wish::Kind::level:
    case Wish::Kind::release:
    case Wish::Kind::home:
      obey_for_those_meant(wish, now);
      break;
    case Wish::Kind::ask:
      if (wish.studio == studio_.fingerprint && wish.fixture < report_.asks.size())
        report_.asks[wish.fixture] += wish.number;
      break;
    case Wish::Kind::motion_stop:
      governor_.stop_motion(wish.on);
      break;
    case Wish::Kind::motion_arm:
      governor_.arm_motion(wish.on);
      break;
    case Wish::Kind::cue_go:
      play(cues_.go(now), now);
      break;
    case Wish::Kind::cue_back:
      play(cues_.back(now), now);
      break;
    case Wish::Kind::cue_to:
      play(cues_.to(wish.number, now), now);
      break;
    case Wish::Kind::master:
      governor_.set_master(wish.master, wish.number);
      break;
    case Wish::Kind::blind:
      governor_.set_blind(wish.on);
      break;
    case Wish::Kind::cue_off:
      cues_.off();
      governor_.play(kNoCue, kNoCue, now);
      break;
  }
  last_report_ = {};  // who wished may look
}

void Show::take_over(Show& before) {
  governor_.carry_on(before.governor_, fixtures_before_);
  if (before.governor_.cue_plays()) cues_.stand_at(before.cues_.state(before.last_frame_).number);
  const ports::TimePoint next = before.next_deadline();
  for (std::size_t i = 0; i < ports_.size(); ++i) {
    if (ports_before_[i] >= 0) {
      std::swap(ports_[i], before.ports_[static_cast<std::size_t>(ports_before_[i])]);
      ports_[i]->set_rate(rates_[i]);
    } else {
      ports_[i]->start(next);
    }
  }
  report_.real_time = before.report_.real_time;
  last_frame_ = before.last_frame_;
}

void Show::start(ports::TimePoint start) {
  last_frame_ = start;
  for (auto& port : ports_) port->start(start);
}

ports::TimePoint Show::next_deadline() const {
  if (ports_.empty()) return last_frame_ + kIdlePeriod;  // nothing to send, but reports go on
  ports::TimePoint next = ports::TimePoint::max();
  for (const auto& port : ports_)
    if (port) next = std::min(next, port->next());
  return next;
}

bool Show::all_tried_since(ports::TimePoint since) const {
  return std::all_of(ports_.begin(), ports_.end(),
                     [&](const auto& port) { return !port || port->tried() >= since; });
}

void Show::hear(ports::TimePoint now) {
  // The old reader can only be passed back when the last one has been fetched: nothing is freed
  // on this thread.
  if (outgoing_.load(std::memory_order_acquire) == nullptr)
    if (BoxReader* fresh = incoming_.exchange(nullptr, std::memory_order_acq_rel)) {
      outgoing_.store(reader_.release(), std::memory_order_release);
      reader_.reset(fresh);
    }
  if (refused_.exchange(false, std::memory_order_acq_rel)) governor_.refuse();
  if (reader_ && reader_->read(wanted_words_)) {
    from_words(wanted_words_, wanted_);
    governor_.take(wanted_, now);
    tried_.take(wanted_);
  }
}

void Show::frame(ports::Clock& clock, LiveTape* tape) {
  if (tape != nullptr && !tape->runs()) tape = nullptr;
  const ports::TimePoint now = clock.now();
  last_frame_ = now;
  hear(now);
  if (!governor_.cue_plays()) cues_.off();  // a new look took its place
  play(cues_.due(now), now);
  plan_.encode(governor_.step(now), frames_);
  stop_motors();
  if (!governor_.blackout()) tried_.raise(frames_, now);
  for (std::size_t i = 0; i < ports_.size(); ++i) {
    if (!ports_[i]->due(now)) continue;
    const ports::DmxFrame& frame = frames_[frame_of_port_[i]];
    ports_[i]->send(frame, clock);
    if (tape != nullptr) tape->put(now, frame);
  }
  for (auto& port : ports_) port->flush();
  if (report_is_due(now)) report_now();
}

bool Show::report_is_due(ports::TimePoint now) const {
  const auto period = sent_words_.size() > kLongReport ? kLongReportPeriod : kReportPeriod;
  return now - last_report_ >= period || governor_.caution() != report_.caution ||
         governor_.blackout() != report_.blackout;
}

void Show::report_now() {
  last_report_ = last_frame_;
  governor_.report(report_);
  report_.cue = cues_.state(last_frame_);
  for (std::size_t i = 0; i < ports_.size(); ++i) {
    ports_[i]->report(report_.ports[i]);
    report_.ports[i].slots = frames_[frame_of_port_[i]].levels;
  }
  to_words(report_, sent_words_);
  writer_->post(sent_words_);
}

void Show::give_reader(std::unique_ptr<BoxReader> reader) {
  delete outgoing_.exchange(nullptr, std::memory_order_acq_rel);
  delete incoming_.exchange(reader.release(), std::memory_order_acq_rel);
}

void Show::release(ports::TimePoint now) {
  for (auto& port : ports_)
    if (port) port->release(now);
}

}  // namespace chiaro::daemon
