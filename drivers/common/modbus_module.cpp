// SPDX-License-Identifier: Apache-2.0
#include "drivers/common/modbus_module.h"

#include <algorithm>
#include <cmath>

namespace chiaro::drivers::modbus {

using Outcome = ports::ModbusLink::Outcome;

std::uint32_t register_value(const Channel& channel, double level) {
  level = std::clamp(level, 0.0, 1.0);
  if (channel.law == Channel::Law::dali) {
    if (level <= 0) return 0;
    // light = 10^((arc - 1) / (253 / 3) - 1) per cent
    const double arc = 1 + (std::log10(100 * level) + 1) * 253 / 3;
    return static_cast<std::uint32_t>(std::lround(std::clamp(arc, 1.0, 254.0)));
  }
  const double value = channel.from + level * (channel.to - channel.from);
  const double most = channel.words == 2 ? 4294967295.0 : 65535.0;
  return static_cast<std::uint32_t>(std::llround(std::clamp(value, 0.0, most)));
}

Module::Module(ModuleSettings settings)
    : settings_(std::move(settings)),
      wanted_(settings_.channels.size()),
      there_(settings_.channels.size()),
      known_(settings_.channels.size(), false) {
  words_.reserve(settings_.most_registers + 2u);
}

void Module::put(std::span<const std::uint8_t> slots) {
  for (std::size_t i = 0; i < settings_.channels.size(); ++i) {
    const Channel& channel = settings_.channels[i];
    const unsigned high = slots[channel.slot];
    const double level =
        channel.slots == 2 ? (high << 8u | slots[channel.slot + 1u]) / 65535.0 : high / 255.0;
    wanted_[i].store(register_value(channel, level), std::memory_order_relaxed);
  }
  any_.store(true, std::memory_order_release);
}

bool Module::dirty(std::size_t i) const {
  return !known_[i] || there_[i] != wanted_[i].load(std::memory_order_relaxed);
}

ports::TimePoint Module::due(ports::TimePoint) const {
  if (!any_.load(std::memory_order_acquire)) return ports::TimePoint::max();
  const ports::TimePoint earliest = std::max(not_before_, patience_.until());
  for (std::size_t i = 0; i < known_.size(); ++i)
    if (dirty(i)) return earliest;
  return std::max(earliest, next_refresh_);
}

/// From the cursor on: the next channel that changed, and its neighbours up to what one message
/// carries. Clean ones between two that changed are said again: cheaper than another message.
Module::Span Module::next_span(ports::TimePoint now) {
  const std::size_t count = settings_.channels.size();
  constexpr std::size_t kBridge = 4;
  std::size_t first = count;
  for (std::size_t i = 0; i < count && first == count; ++i)
    if (dirty((cursor_ + i) % count)) first = (cursor_ + i) % count;
  if (first == count) {  // nothing new: the refresh goes on where it was
    first = refreshed_;
    if (first == 0) next_refresh_ = now + settings_.refresh;
  }
  const bool refreshing = !dirty(first);
  std::size_t end = first + 1, last_wanted = end;
  const int most = settings_.single_writes ? 1 : settings_.most_registers;
  const auto address = [&](std::size_t i) { return settings_.channels[i].address; };
  while (end < count && address(end) == address(end - 1) + settings_.channels[end - 1].words &&
         address(end) + settings_.channels[end].words - address(first) <= most &&
         (refreshing || dirty(end) || end - last_wanted < kBridge)) {
    ++end;
    if (refreshing || dirty(end - 1)) last_wanted = end;
  }
  return {first, last_wanted};
}

Outcome Module::write(ports::ModbusLink& link, Span span) {
  words_.clear();
  for (std::size_t i = span.first; i < span.end; ++i) {
    const Channel& channel = settings_.channels[i];
    const std::uint32_t value = wanted_[i].load(std::memory_order_relaxed);
    there_[i] = value;  // what will be there if this succeeds
    const auto high = static_cast<std::uint16_t>(value >> 16u);
    const auto low = static_cast<std::uint16_t>(value & 0xffffu);
    if (channel.words == 2) words_.push_back(channel.low_word_first ? low : high);
    words_.push_back(channel.words == 2 && channel.low_word_first ? high : low);
  }
  const std::uint16_t at = settings_.channels[span.first].address;
  return settings_.single_writes && words_.size() == 1
             ? link.write_single(settings_.unit, at, words_[0], settings_.timeout)
             : link.write(settings_.unit, at, words_, settings_.timeout);
}

void Module::line_opened() {
  patience_.worked();
  std::fill(known_.begin(), known_.end(), false);
}

Outcome Module::turn(ports::ModbusLink& link, ports::TimePoint now) {
  const Span span = next_span(now);
  const Outcome outcome = write(link, span);
  const bool done = outcome == Outcome::done;
  for (std::size_t i = span.first; i < span.end; ++i) known_[i] = done;
  answers_.store(done, std::memory_order_release);
  if (done) {
    written_.fetch_add(1, std::memory_order_relaxed);
    patience_.worked();
    const bool all = span.first == 0 && span.end == settings_.channels.size();
    if (all || next_refresh_ == ports::TimePoint{}) next_refresh_ = now + settings_.refresh;
    cursor_ = span.end % settings_.channels.size();
    refreshed_ = cursor_;
  } else {
    failed_.fetch_add(1, std::memory_order_relaxed);
    patience_.failed(now);
    // It may have been without power: whatever was there is not known any more.
    std::fill(known_.begin(), known_.end(), false);
  }
  return outcome;
}

}  // namespace chiaro::drivers::modbus
