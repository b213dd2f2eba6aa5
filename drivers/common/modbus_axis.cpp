// SPDX-License-Identifier: Apache-2.0
#include "drivers/common/modbus_axis.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace chiaro::drivers::modbus {

using Outcome = ports::ModbusLink::Outcome;
using ports::TimePoint;

namespace {

constexpr double kFull = 65535;
/// One lost message in a thousand is usual; this many in a row are a motor that is off.
constexpr int kPatience = 3;

/// A register pair or single, as its maker counts: signed where the range goes below 0.
double number_in(const AxisSettings& axis, std::span<const std::uint16_t> words) {
  std::uint32_t raw = words[0];
  if (axis.words == 2)
    raw = axis.low_word_first ? words[0] | static_cast<std::uint32_t>(words[1]) << 16u
                              : static_cast<std::uint32_t>(words[0]) << 16u | words[1];
  const bool is_signed = std::min(axis.from, axis.to) < 0;
  if (!is_signed) return raw;
  return axis.words == 2 ? static_cast<double>(static_cast<std::int32_t>(raw))
                         : static_cast<double>(static_cast<std::int16_t>(raw));
}

}  // namespace

Axis::Axis(AxisSettings settings) : settings_(settings) {}

void Axis::put(std::span<const std::uint8_t> slots) {
  const unsigned high = slots[settings_.slot], low = slots[settings_.slot + 1u];
  wanted_.store(high << 8u | low, std::memory_order_relaxed);
  any_.store(true, std::memory_order_release);
}

void Axis::stop(bool on) {
  const bool before = stopped_.exchange(on, std::memory_order_acq_rel);
  if (on && !before) stop_now_.store(true, std::memory_order_release);
}

ports::AxisReport Axis::report() const {
  ports::AxisReport report;
  report.slot = settings_.slot;
  report.place = place_.load(std::memory_order_relaxed);
  report.wanted = wanted_.load(std::memory_order_relaxed) / kFull;
  report.moving = moving_.load(std::memory_order_relaxed);
  report.homed = homed_.load(std::memory_order_relaxed);
  report.fault = fault_.load(std::memory_order_relaxed);
  report.heard = answers_.load(std::memory_order_acquire);
  report.can_home = settings_.home >= 0;
  return report;
}

/// From here on it counts as standing where it is wanted: only another wish moves it.
void Axis::stand_still() {
  asked_ = wanted_.load(std::memory_order_relaxed);
  asked_known_ = any_.load(std::memory_order_acquire);
  still_ = true;
}

void Axis::line_opened() {
  patience_.worked();
  place_known_ = false;
  home_.store(false, std::memory_order_release);
  stand_still();
}

TimePoint Axis::next_look() const {
  if (settings_.actual < 0 && settings_.status < 0) return TimePoint::max();
  return looked_at_ == TimePoint{} ? TimePoint{} : looked_at_ + kPoll;
}

bool Axis::asks() const {
  if (!any_.load(std::memory_order_acquire) || stopped() || !has_place() || !asked_known_)
    return false;
  return !still_ || wanted_.load(std::memory_order_relaxed) != asked_;
}

TimePoint Axis::next_step() const { return led_at_ == TimePoint{} ? TimePoint{} : led_at_ + kStep; }

TimePoint Axis::due(TimePoint) const {
  TimePoint next = next_look();
  if (asks()) next = std::min(next, next_step());
  const bool news = !asked_known_ && any_.load(std::memory_order_acquire);
  if (news || stop_unheard_ || home_.load(std::memory_order_acquire)) next = TimePoint{};
  return next == TimePoint::max() ? next : std::max({next, not_before_, patience_.until()});
}

Outcome Axis::turn(ports::ModbusLink& link, TimePoint now) {
  if (stop_now_.exchange(false, std::memory_order_acq_rel) || (stop_unheard_ && stopped()))
    return heard(say_stop(link), now);
  stop_unheard_ = false;
  if (stopped() || !asked_known_) stand_still();
  if (home_.exchange(false, std::memory_order_acq_rel) && settings_.home >= 0 && !stopped())
    return heard(say_home(link), now);
  if (asks() && next_step() <= now && next_step() <= next_look())
    return heard(lead(link, now), now);
  if (next_look() <= now) return heard(look(link, now), now);
  return Outcome::done;
}

Outcome Axis::say_stop(ports::ModbusLink& link) {
  stand_still();
  home_.store(false, std::memory_order_release);
  Outcome outcome = Outcome::done;
  if (settings_.stop >= 0)
    outcome = link.write_single(settings_.unit, static_cast<std::uint16_t>(settings_.stop),
                                settings_.stop_value, settings_.timeout);
  else if (place_known_)  // without an order to stop: it shall be where it is
    outcome = write_place(link, place_.load(std::memory_order_relaxed));
  stop_unheard_ = outcome != Outcome::done;
  return outcome;
}

Outcome Axis::say_home(ports::ModbusLink& link) {
  stand_still();
  return link.write_single(settings_.unit, static_cast<std::uint16_t>(settings_.home),
                           settings_.home_value, settings_.timeout);
}

/// One step from where it is towards where it shall be.
Outcome Axis::lead(ports::ModbusLink& link, TimePoint now) {
  const std::uint32_t wanted = wanted_.load(std::memory_order_relaxed);
  if (still_) {  // it sets out
    led_ = settings_.actual >= 0 ? std::clamp(place_.load(std::memory_order_relaxed), 0.0, 1.0)
                                 : asked_ / kFull;
    led_at_ = now - kStep;
    still_ = false;
  }
  const double most = std::min(std::chrono::duration<double>(now - led_at_).count(), 0.25) /
                      std::max(settings_.end_to_end_s, 0.1);
  const double gap = wanted / kFull - led_;
  led_ = std::abs(gap) <= most ? wanted / kFull : led_ + std::copysign(most, gap);
  led_at_ = now;
  const Outcome outcome = write_place(link, led_);
  if (outcome == Outcome::done && led_ == wanted / kFull) {
    asked_ = wanted;
    still_ = true;
  }
  return outcome;
}

Outcome Axis::write_place(ports::ModbusLink& link, double share) {
  const auto value = static_cast<std::uint32_t>(
      std::llround(settings_.from + share * (settings_.to - settings_.from)) & 0xffffffffLL);
  const auto high = static_cast<std::uint16_t>(value >> 16u);
  const auto low = static_cast<std::uint16_t>(value & 0xffffu);
  if (settings_.words == 1)
    return link.write_single(settings_.unit, settings_.target, low, settings_.timeout);
  const std::array<std::uint16_t, 2> words{settings_.low_word_first ? low : high,
                                           settings_.low_word_first ? high : low};
  return link.write(settings_.unit, settings_.target, words, settings_.timeout);
}

Outcome Axis::read(ports::ModbusLink& link, int address, bool input,
                   std::span<std::uint16_t> into) {
  return link.read(settings_.unit, input, static_cast<std::uint16_t>(address), into,
                   settings_.timeout);
}

/// One register group at a time: the bus has others to serve.
Outcome Axis::look(ports::ModbusLink& link, TimePoint now) {
  std::array<std::uint16_t, 2> words{};
  const bool flags = settings_.status >= 0 && (look_at_flags_ || settings_.actual < 0);
  if (!flags) {
    const auto into = std::span(words).first(settings_.words);
    const Outcome outcome = read(link, settings_.actual, settings_.actual_is_input, into);
    if (outcome == Outcome::done) {
      const double share =
          (number_in(settings_, into) - settings_.from) / (settings_.to - settings_.from);
      place_.store(share, std::memory_order_relaxed);
      place_known_ = true;
    }
    look_at_flags_ = settings_.status >= 0 && outcome == Outcome::done;
    if (!look_at_flags_) looked_at_ = now;
    return outcome;
  }
  const Outcome outcome =
      read(link, settings_.status, settings_.status_is_input, std::span(words).first(1));
  if (outcome == Outcome::done) {
    const auto bit = [&](int number) { return number >= 0 && (words[0] >> number & 1) != 0; };
    moving_.store(bit(settings_.moving_bit), std::memory_order_relaxed);
    homed_.store(bit(settings_.homed_bit), std::memory_order_relaxed);
    fault_.store(bit(settings_.fault_bit), std::memory_order_relaxed);
  }
  look_at_flags_ = false;
  looked_at_ = now;
  return outcome;
}

Outcome Axis::heard(Outcome outcome, TimePoint now) {
  answers_.store(outcome == Outcome::done, std::memory_order_release);
  if (outcome == Outcome::done) {
    patience_.worked();
    failures_ = 0;
    return outcome;
  }
  failed_.fetch_add(1, std::memory_order_relaxed);
  patience_.failed(now);
  if (++failures_ < kPatience) return outcome;
  // It has been away: what was asked before is not asked again when it is back.
  place_known_ = false;
  stand_still();
  return outcome;
}

}  // namespace chiaro::drivers::modbus
