// SPDX-License-Identifier: Apache-2.0
// A universe that ends in the registers of a Modbus device instead of on a DMX line. The port only
// lays levels down; the line's one scheduler, shared by all its devices, does the talking.
#include <algorithm>
#include <memory>
#include <vector>

#include "drivers/common/modbus_axis.h"
#include "drivers/common/modbus_module.h"
#include "drivers/registry.h"

namespace chiaro::drivers::modbus {
namespace {

/// Ports with the same one share a line.
std::string name_of(const ports::ModbusLine& line) {
  return line.host.empty() ? to_string(line.serial) : line.host + ":" + std::to_string(line.port);
}

class ModbusPort final : public ports::OutputPort {
 public:
  ModbusPort(const OutputSettings& settings, Surroundings& around)
      : settings_(settings), around_(around), module_(settings.module) {
    for (const AxisSettings& axis : settings.axes) axes_.push_back(std::make_unique<Axis>(axis));
  }
  ~ModbusPort() override { leave(); }
  ModbusPort(const ModbusPort&) = delete;
  ModbusPort& operator=(const ModbusPort&) = delete;

  core::Result<core::Done> open() override {
    if (settings_.module.channels.empty() && axes_.empty())
      return core::Problem{{}, "the Modbus device has no channels", "choose another map"};
    if (!bus_)
      bus_ = around_.shared.get<Bus>(name_of(settings_.line), [&] {
        return std::make_shared<Bus>(around_.devices, around_.clock, settings_.line,
                                     around_.threads);
      });
    if (const auto opened = bus_->open(); !opened) return opened.problems();
    if (!settings_.module.channels.empty()) bus_->add(module_);
    for (const auto& axis : axes_) bus_->add(*axis);
    if (health_ == ports::PortHealth::lost) ++reconnects_;
    health_ = ports::PortHealth::good;
    opened_at_failure_ = failures();
    return core::Done{};
  }

  void send(const ports::DmxFrame& frame, ports::TimePoint now) override {
    if (health_ == ports::PortHealth::closed) return;
    if (!settings_.module.channels.empty()) module_.put(frame.levels);
    for (const auto& axis : axes_) axis->put(frame.levels);
    if (bus_->threaded()) {
      bus_->wake();
    } else {
      while (bus_->step(now)) {
      }
    }
    const bool well = bus_->is_open() && (all_answer() || failures() == opened_at_failure_);
    if (well) {
      ++sent_;
      if (health_ == ports::PortHealth::lost) ++reconnects_;
    } else {
      ++failed_;
    }
    health_ = well ? ports::PortHealth::good : ports::PortHealth::lost;
  }

  /// Modules hold their last values.
  void release(ports::TimePoint) override {
    leave();
    health_ = ports::PortHealth::closed;
  }

  ports::PortReport report() const override { return {health_, sent_, failed_, reconnects_}; }
  void order(const ports::AxisOrder& order) override {
    using Kind = ports::AxisOrder::Kind;
    for (const auto& axis : axes_) {
      if (order.kind != Kind::home) axis->stop(order.kind == Kind::stop);
      if (order.kind == Kind::home && axis->settings().slot == order.slot) axis->home();
    }
  }
  std::vector<ports::AxisReport> axes() const override {
    std::vector<ports::AxisReport> all;
    for (const auto& axis : axes_) all.push_back(axis->report());
    return all;
  }
  bool physical() const override { return true; }
  /// Opening a line may take its time (a gateway that is off), so the port has a thread for that.
  bool blocks() const override { return true; }

 private:
  void leave() {
    if (bus_) {
      bus_->remove(module_);
      for (const auto& axis : axes_) bus_->remove(*axis);
    }
    bus_.reset();
  }
  std::uint64_t failures() const {
    std::uint64_t all = module_.failed();
    for (const auto& axis : axes_) all += axis->failed();
    return all;
  }
  bool all_answer() const {
    return module_.answers() && std::all_of(axes_.begin(), axes_.end(),
                                            [](const auto& axis) { return axis->answers(); });
  }

  const OutputSettings settings_;
  Surroundings& around_;
  Module module_;
  std::vector<std::unique_ptr<Axis>> axes_;
  std::shared_ptr<Bus> bus_;
  ports::PortHealth health_ = ports::PortHealth::closed;
  std::uint64_t sent_ = 0, failed_ = 0, reconnects_ = 0, opened_at_failure_ = 0;
};

}  // namespace

std::unique_ptr<ports::OutputPort> make(const OutputSettings&, Surroundings&);
std::unique_ptr<ports::OutputPort> make(const OutputSettings& settings, Surroundings& around) {
  return std::make_unique<ModbusPort>(settings, around);
}

}  // namespace chiaro::drivers::modbus
