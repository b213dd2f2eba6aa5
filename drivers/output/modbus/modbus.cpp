// SPDX-License-Identifier: Apache-2.0
// A universe that ends in the registers of a Modbus device instead of on a DMX line. The port only
// lays levels down; the line's one scheduler, shared by all its devices, does the talking.
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
      : settings_(settings), around_(around), module_(settings.module) {}
  ~ModbusPort() override { leave(); }
  ModbusPort(const ModbusPort&) = delete;
  ModbusPort& operator=(const ModbusPort&) = delete;

  core::Result<core::Done> open() override {
    if (settings_.module.channels.empty())
      return core::Problem{{}, "the Modbus device has no channels", "choose another map"};
    if (!bus_)
      bus_ = around_.shared.get<Bus>(name_of(settings_.line), [&] {
        return std::make_shared<Bus>(around_.devices, around_.clock, settings_.line,
                                     around_.threads);
      });
    if (const auto opened = bus_->open(); !opened) return opened.problems();
    bus_->add(module_);
    if (health_ == ports::PortHealth::lost) ++reconnects_;
    health_ = ports::PortHealth::good;
    opened_at_failure_ = module_.failed();
    return core::Done{};
  }

  void send(const ports::DmxFrame& frame, ports::TimePoint now) override {
    if (health_ == ports::PortHealth::closed) return;
    module_.put(frame.levels);
    if (bus_->threaded()) {
      bus_->wake();
    } else {
      while (bus_->step(now)) {
      }
    }
    const bool well =
        bus_->is_open() && (module_.answers() || module_.failed() == opened_at_failure_);
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
  bool physical() const override { return true; }
  /// Opening a line may take its time (a gateway that is off), so the port has a thread for that.
  bool blocks() const override { return true; }

 private:
  void leave() {
    if (bus_) bus_->remove(module_);
    bus_.reset();
  }

  const OutputSettings settings_;
  Surroundings& around_;
  Module module_;
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
