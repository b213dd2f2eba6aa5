// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/output/housekeeper.h"

#include <algorithm>
#include <ostream>
#include <utility>

#include "controller/daemon/box_words.h"
#include "controller/daemon/output/last_levels.h"
#include "controller/studio/load.h"

namespace chiaro::daemon {
namespace {

constexpr ports::Duration kFirstRetry = std::chrono::milliseconds(250);
constexpr ports::Duration kLastRetry = std::chrono::seconds(2);

std::string told_as(rig::Caution caution, bool refused) {
  switch (caution) {
    case rig::Caution::normal:
      return "chiarod is heard";
    case rig::Caution::hold:
      return refused ? "chiarod reads another studio file: holding the levels"
                     : "no word from chiarod: holding the levels";
    case rig::Caution::fade_to_safe:
      return "fading between the look and the safe levels";
    case rig::Caution::blackout:
      return "blackout";
  }
  return "";
}

rig::Held held_in(const rig::Sent& report) {
  rig::Held held;
  held.fixtures = report.held;
  held.masters = report.masters;
  held.blackout = report.blackout;
  held.motion_stop = report.motion_stop.on;
  held.marks = report.marks;
  held.own_marks = report.own_marks;
  held.own = report.sources[static_cast<std::size_t>(rig::Source::own)].fixtures;
  held.fade_id = report.fade_id;
  held.master_id = report.master_id;
  held.blackout_id = report.blackout_id;
  held.stop_id = report.motion_stop.id;
  held.arm_id = report.motion_armed.id;
  if (report.cue.playing >= 0) held.cue = report.cue.number;
  return held;
}

}  // namespace

Housekeeper::Housekeeper(Hand& hand, const std::filesystem::path& studio_file,
                         const Show::Options& options, ports::World& world)
    : hand_(hand),
      show_(&hand.show()),
      studio_file_(studio_file),
      options_(options),
      world_(world),
      recorder_(hand),
      report_(sized_sent(hand.show().studio())),
      studio_(hand.show().studio()) {}

void Housekeeper::tick() {
  look_for_brain();
  read_report();
  read_axes();
  tell_changes();
  if (desk_ != nullptr) {
    desk_->follow(studio_, report_);  // both are changed by this thread alone
    say(desk_->take_problems());
  }
  say(recorder_.tick());
  mend_ports();
  save_if_due();
  std::unique_lock lock(reload_mutex_);
  const std::uint64_t asked = reloads_asked_;
  if (!world_.reload.exchange(false) && asked == reloads_done_) return;
  lock.unlock();
  const auto outcome = reload();
  lock.lock();
  reloads_done_ = asked;
  reload_problems_ = outcome.problems();
  reload_done_.notify_all();
}

void Housekeeper::look_for_brain() {
  const auto file = world_.runtime_folder / "wanted.box";
  const std::uint64_t identity = box_identity(file);
  if (identity == 0 || identity == brain_box_) return;
  brain_box_ = identity;
  auto reader = BoxReader::open(file, wanted_format(show_->studio()));
  if (reader) {
    show_->give_reader(std::move(*reader));
    return;
  }
  show_->refuse_brain();
  say(reader.problems());
}

void Housekeeper::read_report() {
  if (!report_reader_ || report_reader_->replaced()) {
    const BoxFormat format = sent_format(show_->studio());
    auto reader = BoxReader::open(world_.runtime_folder / "sent.box", format);
    if (!reader) return;
    report_reader_ = std::move(*reader);
    report_words_.resize(format.words);
    spare_ = sized_sent(show_->studio());
    resized_ = true;
  }
  if (!report_reader_->read(report_words_)) return;
  from_words(report_words_, spare_);
  const std::scoped_lock lock(report_mutex_);
  std::swap(report_, spare_);
  if (std::exchange(resized_, false)) spare_ = report_;  // it was of another studio
}

void Housekeeper::read_axes() {
  std::vector<Axis> axes;
  for (const auto& slot : show_->ports())
    for (const ports::AxisReport& axis : slot->port().axes())
      axes.push_back({slot->settings().universe, axis});
  const std::scoped_lock lock(report_mutex_);
  axes_ = std::move(axes);
}

std::vector<Housekeeper::Axis> Housekeeper::axes_now() const {
  const std::scoped_lock lock(report_mutex_);
  return axes_;
}

studio::Studio Housekeeper::studio_now() const {
  const std::scoped_lock lock(report_mutex_);
  return studio_;
}

rig::Sent Housekeeper::newest_report() const {
  const std::scoped_lock lock(report_mutex_);
  return report_;
}

void Housekeeper::tell_changes() {
  const rig::Caution now = report_.caution;
  if (report_.sent_ns == 0 || told_ == now) return;
  told_ = now;
  world_.err << "chiaro-output: " << told_as(now, report_.refused) << std::endl;
}

/// Ports that are not good are borrowed from the loop, opened again and given back, all in one
/// round, so that a pulled cable with 256 universes behind it does not keep this thread from the
/// rest of its work. The waits between the attempts double up to two seconds.
void Housekeeper::mend_ports() {
  std::vector<PortSlot*> borrowed;
  for (const auto& slot : show_->ports()) {
    PortWriter* const writer = slot->writer();
    if (writer) say(writer->take_problems());
    if ((writer && !writer->attempted()) || !is_due_for_mending(*slot)) continue;
    if (writer) {
      writer->mend();  // on its own thread: a device may take its time
      wait_longer(*slot);
    } else {
      borrowed.push_back(slot.get());
    }
  }
  if (borrowed.empty()) return;
  for (PortSlot* slot : borrowed) slot->ask();
  const auto all_lent = [&] {
    return std::all_of(borrowed.begin(), borrowed.end(), [](auto* slot) { return slot->lent(); });
  };
  for (int i = 0; i < 20 && !all_lent() && !ending_; ++i) wait_a_tick();
  for (PortSlot* slot : borrowed) {
    if (slot->lent()) (void)slot->port().open();
    slot->give_back();
    wait_longer(*slot);
  }
}

void Housekeeper::wait_longer(const PortSlot& slot) {
  Lost& lost = lost_.at(&slot);
  lost.wait = std::min(2 * lost.wait, kLastRetry);
  lost.next = world_.clock.now() + lost.wait;
}

bool Housekeeper::is_due_for_mending(const PortSlot& slot) {
  const auto universe = slot.settings().universe;
  if (slot.health() == ports::PortHealth::good) {
    if (lost_.erase(&slot) > 0)
      world_.err << "chiaro-output: universe " << universe << " is back" << std::endl;
    return false;
  }
  const ports::TimePoint now = world_.clock.now();
  const auto [entry, fresh] = lost_.try_emplace(&slot, Lost{now + kFirstRetry, kFirstRetry});
  if (fresh)
    world_.err << "chiaro-output: universe " << universe << " cannot be sent; trying again"
               << std::endl;
  return now >= entry->second.next;
}

void Housekeeper::wait_a_tick() { world_.clock.sleep_until(world_.clock.now() + kTick); }

void Housekeeper::finish() {
  read_report();
  save_now();
  say(recorder_.tick());
}

void Housekeeper::save_if_due() {
  const ports::TimePoint now = world_.clock.now();
  if (saved_ && now - saved_at_ < kSaveEvery) return;
  save_now();
}

void Housekeeper::save_now() {
  if (report_.sent_ns == 0) return;
  const rig::Held held = held_in(report_);
  if (saved_ && *saved_ == held) return;
  saved_ = held;
  saved_at_ = world_.clock.now();
  const auto written =
      write_last_levels(world_.state_folder / "last-levels.json", show_->studio(), held);
  if (!written && !save_failed_) say(written.problems());
  save_failed_ = !written;
}

void Housekeeper::end() {
  {
    const std::scoped_lock lock(reload_mutex_);
    ending_.store(true, std::memory_order_release);
  }
  reload_done_.notify_all();
}

core::Result<core::Done> Housekeeper::reload_now(ports::Duration patience) {
  std::unique_lock lock(reload_mutex_);
  const std::uint64_t mine = ++reloads_asked_;
  if (!reload_done_.wait_for(lock, patience, [&] { return reloads_done_ >= mine || ending_; }) ||
      reloads_done_ < mine)
    return core::Problem{{}, "the studio file is still being read", "ask again in a moment"};
  if (core::any_error(reload_problems_)) return reload_problems_;
  return core::Done{};
}

core::Result<core::Done> Housekeeper::reload() {
  auto loaded = studio::load_studio(studio_file_, studio::Folders{world_.config_folder});
  if (!loaded) {
    say(loaded.problems());
    world_.err << "chiaro-output: the studio file was not taken; nothing has changed" << std::endl;
    return loaded.problems();
  }
  if (loaded->studio.fingerprint == show_->studio().fingerprint) return core::Done{};
  core::Problems warnings = loaded->warnings;
  auto next = Show::make(loaded->studio, options_, world_, nullptr, show_, warnings);
  say(warnings);
  if (!next) {
    say(next.problems());
    return next.problems();
  }
  if (!swap_in(std::move(*next)))
    return core::Problem{{}, "the output loop did not take the new studio", "restart it"};
  world_.err << "chiaro-output: studio '" << show_->studio().name << "' read again" << std::endl;
  return core::Done{};
}

bool Housekeeper::swap_in(std::unique_ptr<Show> next) {
  Show* const fresh = next.get();
  hand_.offer(std::move(next));
  std::unique_ptr<Show> old;
  while (!(old = hand_.collect())) {
    if (ending_) return false;
    wait_a_tick();
  }
  old->release(world_.clock.now());  // the ports that the new studio has no use for
  show_ = fresh;
  {
    const std::scoped_lock lock(report_mutex_);
    studio_ = fresh->studio();
  }
  lost_.clear();
  brain_box_ = 0;
  report_reader_.reset();
  read_report();
  saved_.reset();
  return true;
}

void Housekeeper::say(const core::Problems& problems) {
  for (const auto& problem : problems)
    world_.err << "chiaro-output: " << core::to_string(problem) << std::endl;
}

}  // namespace chiaro::daemon
