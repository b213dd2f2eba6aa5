// SPDX-License-Identifier: Apache-2.0
// A motor behind registers: an arc, a track, a yoke. What keeps it safe is kept here, beside the
// bus, and not only in what is asked of it: a motor once ran to the place that a power cut had left
// in a register.
//
// * It moves only when the wanted place changes while the motor can be heard. The first place after
//   a start, a lost line or a stop is taken as where it stands, and is never written.
// * It is led from where it is (its own word for it) to where it shall be, at the speed given.
// * A stop goes before everything else on the bus and is said again until it is answered.
// * It is homed only by an order, and an order that could not be carried out is dropped.
#pragma once

#include <atomic>
#include <cstdint>
#include <span>

#include "controller/ports/output.h"
#include "drivers/common/modbus_bus.h"

namespace chiaro::drivers::modbus {

struct AxisSettings {
  std::uint8_t unit = 1;
  ports::Duration timeout = std::chrono::milliseconds(500);
  ports::Duration least_gap{};
  std::uint16_t slot = 0;    ///< 0..510: two slots, most significant first
  std::uint16_t target = 0;  ///< register, as on the wire
  std::uint8_t words = 1;
  bool low_word_first = false;
  double from = 0, to = 65535;  ///< at 0 and 1; below 0: two's complement
  int actual = -1;
  bool actual_is_input = false;
  int status = -1;
  bool status_is_input = false;
  int moving_bit = -1, homed_bit = -1, fault_bit = -1;
  int home = -1, stop = -1;  ///< -1 = it has no such order
  std::uint16_t home_value = 1, stop_value = 1;
  double end_to_end_s = 10;  ///< the least time for the whole range
  friend bool operator==(const AxisSettings&, const AxisSettings&) = default;
};

class Axis final : public Client {
 public:
  static constexpr ports::Duration kPoll = std::chrono::milliseconds(250),
                                   kStep = std::chrono::milliseconds(50);
  explicit Axis(AxisSettings settings);

  /// Where it shall be, as two slots of a universe. Real-time, one thread.
  void put(std::span<const std::uint8_t> slots);
  /// Any thread; real-time.
  void stop(bool on);
  void home() { home_.store(true, std::memory_order_release); }
  ports::AxisReport report() const;
  bool answers() const { return answers_.load(std::memory_order_acquire); }
  std::uint64_t failed() const { return failed_.load(std::memory_order_relaxed); }
  const AxisSettings& settings() const { return settings_; }

  ports::TimePoint due(ports::TimePoint now) const override;
  bool urgent() const override { return stop_now_.load(std::memory_order_acquire); }
  ports::ModbusLink::Outcome turn(ports::ModbusLink& link, ports::TimePoint now) override;
  void spoken(ports::TimePoint now) override { not_before_ = now + settings_.least_gap; }
  void line_opened() override;

 private:
  using Outcome = ports::ModbusLink::Outcome;
  Outcome say_stop(ports::ModbusLink& link);
  Outcome say_home(ports::ModbusLink& link);
  Outcome lead(ports::ModbusLink& link, ports::TimePoint now);
  Outcome look(ports::ModbusLink& link, ports::TimePoint now);
  Outcome write_place(ports::ModbusLink& link, double share);
  Outcome read(ports::ModbusLink& link, int address, bool input, std::span<std::uint16_t> into);
  Outcome heard(Outcome outcome, ports::TimePoint now);
  bool stopped() const { return stopped_.load(std::memory_order_acquire); }
  bool has_place() const { return settings_.actual < 0 || place_known_; }
  void stand_still();
  bool asks() const;
  ports::TimePoint next_look() const;
  ports::TimePoint next_step() const;

  const AxisSettings settings_;
  std::atomic<std::uint32_t> wanted_{0};  ///< 0..65535
  std::atomic<bool> any_{false}, stopped_{false}, stop_now_{false}, home_{false};

  // The bus's thread.
  bool still_ = true;          ///< nothing was asked of it since `asked_`
  bool stop_unheard_ = false;  ///< it is said again
  bool place_known_ = false;
  std::uint32_t asked_ = 0;  ///< the wanted place that counts as where it stands
  bool asked_known_ = false;
  double led_ = 0;  ///< the share written last
  ports::TimePoint led_at_, looked_at_, not_before_;
  bool look_at_flags_ = false;
  int failures_ = 0;  ///< in a row
  Patience patience_;

  // For those who ask.
  std::atomic<double> place_{-1};
  std::atomic<bool> moving_{false}, homed_{false}, fault_{false}, answers_{true};
  std::atomic<std::uint64_t> failed_{0};
};

}  // namespace chiaro::drivers::modbus
