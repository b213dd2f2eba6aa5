// SPDX-License-Identifier: Apache-2.0
// A Modbus device that makes light: dimmer, 0-10 V module, DALI gateway, LED controller. Its levels
// are laid down by the output loop; the bus writes those that changed, neighbours in one message.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <vector>

#include "drivers/common/modbus_bus.h"

namespace chiaro::drivers::modbus {

/// What one channel of a device is: from which slots of a universe, by which law, to which
/// register.
struct Channel {
  std::uint16_t slot = 0;     ///< 0..511, of the first of its slots
  std::uint8_t slots = 1;     ///< 1 or 2, most significant first
  std::uint16_t address = 0;  ///< on the wire: counts from 0
  std::uint8_t words = 1;     ///< registers: 1 or 2
  bool low_word_first = false;
  double from = 0, to = 65535;  ///< the register's value at level 0 and 1
  /// `dali`: 0 is off, 1..254 are 0.1 % to 100 % evenly in the logarithm (IEC 62386-102); 255 is
  /// "no change" and never sent.
  enum class Law : std::uint8_t { linear, dali };
  Law law = Law::linear;
  friend bool operator==(const Channel&, const Channel&) = default;
};

/// The register's value for a level of 0..1. Real-time.
std::uint32_t register_value(const Channel& channel, double level);

struct ModuleSettings {
  std::uint8_t unit = 1;
  ports::Duration timeout = std::chrono::milliseconds(500);
  /// The device's own pace: so long between the end of a message to it and the next.
  ports::Duration least_gap{};
  /// Everything again so often: a module that lost its power has forgotten its levels.
  ports::Duration refresh = std::chrono::seconds(2);
  bool single_writes = false;  ///< for devices that know function 06 alone
  std::uint16_t most_registers = 123;
  std::vector<Channel> channels;  ///< ascending addresses, none twice
  friend bool operator==(const ModuleSettings&, const ModuleSettings&) = default;
};

class Module final : public Client {
 public:
  explicit Module(ModuleSettings settings);

  /// The newest levels, as a universe; those that were not written yet are passed over. Real-time,
  /// one thread.
  void put(std::span<const std::uint8_t> slots);

  ports::TimePoint due(ports::TimePoint now) const override;
  ports::ModbusLink::Outcome turn(ports::ModbusLink& link, ports::TimePoint now) override;
  void spoken(ports::TimePoint now) override { not_before_ = now + settings_.least_gap; }
  void line_opened() override;

  /// Thread-safe counts of messages and of those that failed.
  std::uint64_t written() const { return written_.load(std::memory_order_relaxed); }
  std::uint64_t failed() const { return failed_.load(std::memory_order_relaxed); }
  /// False after a failure, until a message has been answered again.
  bool answers() const { return answers_.load(std::memory_order_acquire); }

 private:
  struct Span {
    std::size_t first = 0, end = 0;  ///< channels
  };
  bool dirty(std::size_t i) const;
  Span next_span(ports::TimePoint now);
  ports::ModbusLink::Outcome write(ports::ModbusLink& link, Span span);

  const ModuleSettings settings_;
  std::vector<std::atomic<std::uint32_t>> wanted_;  ///< register values
  std::atomic<bool> any_{false};
  std::vector<std::uint32_t> there_;
  std::vector<bool> known_;  ///< what the device has is known
  std::size_t cursor_ = 0;   ///< where the next span is sought: everyone gets a turn
  std::size_t refreshed_ = 0;
  ports::TimePoint next_refresh_, not_before_;
  Patience patience_;
  std::vector<std::uint16_t> words_;
  std::atomic<std::uint64_t> written_{0}, failed_{0};
  std::atomic<bool> answers_{true};
};

}  // namespace chiaro::drivers::modbus
