// SPDX-License-Identifier: Apache-2.0
#include "tests/support/fake_devices.h"

#include <algorithm>

namespace chiaro::support {

bool FakeDevice::works() {
  ++calls;
  if (delay.count() > 0 && clock != nullptr) clock->sleep_until(clock->now() + delay);
  if (!plugged) return false;
  if (fail_next > 0) {
    --fail_next;
    return false;
  }
  return true;
}

Bytes FakeSerial::all_written() const {
  const std::scoped_lock lock(mutex);
  Bytes all;
  for (const Event& event : events)
    if (event.kind == Event::written) all.insert(all.end(), event.bytes.begin(), event.bytes.end());
  return all;
}

namespace {

/// What is opened: counts itself open for as long as it lives.
template <class Far, class Port>
class Opened : public Port {
 public:
  explicit Opened(std::shared_ptr<Far> far) : far_(std::move(far)) {
    const std::scoped_lock lock(far_->mutex);
    ++far_->opens;
    ++far_->open_now;
  }
  ~Opened() override {
    const std::scoped_lock lock(far_->mutex);
    --far_->open_now;
  }
  Opened(const Opened&) = delete;
  Opened& operator=(const Opened&) = delete;

 protected:
  std::shared_ptr<Far> far_;
};

bool lost(FakeDevice& far) {
  if (far.lose_next == 0) return false;
  --far.lose_next;
  return true;
}

struct Serial final : Opened<FakeSerial, ports::SerialPort> {
  using Opened::Opened;
  bool write(std::span<const std::uint8_t> bytes) override {
    const std::scoped_lock lock(far_->mutex);
    if (!far_->works()) return false;
    if (lost(*far_)) return true;
    far_->events.push_back({FakeSerial::Event::written, {bytes.begin(), bytes.end()}});
    if (far_->answer)
      for (const std::uint8_t byte : far_->answer(bytes)) far_->to_read.push_back(byte);
    return true;
  }
  std::optional<std::size_t> read(std::span<std::uint8_t> into, ports::Duration) override {
    const std::scoped_lock lock(far_->mutex);
    if (!far_->works()) return std::nullopt;
    std::size_t got = 0;
    while (got < into.size() && !far_->to_read.empty()) {
      into[got++] = far_->to_read.front();
      far_->to_read.pop_front();
    }
    return got;
  }
  bool set_break(bool on) override {
    return note(on ? FakeSerial::Event::break_on : FakeSerial::Event::break_off);
  }
  bool drain() override { return note(FakeSerial::Event::drained); }

 private:
  bool note(FakeSerial::Event::Kind kind) {
    const std::scoped_lock lock(far_->mutex);
    if (!far_->works()) return false;
    far_->events.push_back({kind, {}});
    return true;
  }
};

struct Usb final : Opened<FakeUsb, ports::UsbDevice> {
  using Opened::Opened;
  Outcome control_out(std::uint8_t request, std::uint16_t value, std::uint16_t index,
                      std::span<const std::uint8_t> data, ports::Duration) override {
    const std::scoped_lock lock(far_->mutex);
    if (!far_->works()) return Outcome::gone;
    if (lost(*far_)) return Outcome::timed_out;
    if (far_->stall_next > 0) {
      --far_->stall_next;
      return Outcome::stalled;
    }
    far_->requests.push_back({request, value, index, {data.begin(), data.end()}});
    return Outcome::done;
  }
};

template <class Queue>
std::size_t pop_into(Queue& queue, std::span<std::uint8_t> into) {
  if (queue.empty()) return 0;
  const std::size_t size = std::min(queue.front().size(), into.size());
  std::copy_n(queue.front().begin(), size, into.begin());
  queue.pop_front();
  return size;
}

struct Hid final : Opened<FakeHid, ports::HidDevice> {
  using Opened::Opened;
  std::optional<std::size_t> read(std::span<std::uint8_t> into, ports::Duration) override {
    const std::scoped_lock lock(far_->mutex);
    if (!far_->works()) return std::nullopt;
    return pop_into(far_->to_read, into);
  }
  bool write(std::span<const std::uint8_t> report) override {
    const std::scoped_lock lock(far_->mutex);
    if (!far_->works()) return false;
    far_->written.emplace_back(report.begin(), report.end());
    return true;
  }
};

struct Gpio final : Opened<FakeGpioLine, ports::GpioLine> {
  using Opened::Opened;
  std::optional<bool> get() override {
    const std::scoped_lock lock(far_->mutex);
    if (!far_->works()) return std::nullopt;
    return far_->level != far_->settings.active_low;
  }
  bool set(bool on) override {
    const std::scoped_lock lock(far_->mutex);
    if (!far_->works()) return false;
    far_->level = on != far_->settings.active_low;
    far_->set_to.push_back(on);
    return true;
  }
};

struct Midi final : Opened<FakeMidi, ports::MidiPort> {
  using Opened::Opened;
  std::optional<std::size_t> receive(std::span<std::uint8_t> into) override {
    const std::scoped_lock lock(far_->mutex);
    if (!far_->works()) return std::nullopt;
    return pop_into(far_->to_read, into);
  }
  bool send(std::span<const std::uint8_t> message) override {
    const std::scoped_lock lock(far_->mutex);
    if (!far_->works()) return false;
    far_->written.emplace_back(message.begin(), message.end());
    return true;
  }
};

struct Modbus final : Opened<FakeModbus, ports::ModbusLink> {
  using Opened::Opened;
  Outcome write(std::uint8_t unit, std::uint16_t address, std::span<const std::uint16_t> values,
                ports::Duration timeout) override {
    return put({unit, address, {values.begin(), values.end()}, false}, timeout);
  }
  Outcome write_single(std::uint8_t unit, std::uint16_t address, std::uint16_t value,
                       ports::Duration timeout) override {
    return put({unit, address, {value}, true}, timeout);
  }
  Outcome read(std::uint8_t unit, bool input_registers, std::uint16_t address,
               std::span<std::uint16_t> into, ports::Duration timeout) override {
    const std::scoped_lock lock(far_->mutex);
    ++far_->reads;
    if (const Outcome outcome = reach(unit, timeout); outcome != Outcome::done) return outcome;
    FakeModbus::Unit& one = far_->units.at(unit);
    auto& bank = input_registers ? one.input : one.holding;
    for (std::size_t i = 0; i < into.size(); ++i)
      into[i] = bank[static_cast<std::uint16_t>(address + i)];
    return Outcome::done;
  }

 private:
  Outcome put(const FakeModbus::Write& write, ports::Duration timeout) {
    const std::scoped_lock lock(far_->mutex);
    if (write.unit != 0)
      if (const Outcome outcome = reach(write.unit, timeout); outcome != Outcome::done)
        return outcome;
    far_->writes.push_back(write);
    for (auto& [number, unit] : far_->units)
      if (write.unit == 0 || write.unit == number)
        for (std::size_t i = 0; i < write.values.size(); ++i)
          unit.holding[static_cast<std::uint16_t>(write.address + i)] = write.values[i];
    return Outcome::done;
  }
  Outcome reach(std::uint8_t unit, ports::Duration timeout) {
    if (!far_->works()) return Outcome::gone;
    far_->timeouts.push_back(timeout);
    const auto found = far_->units.find(unit);
    const bool there = found != far_->units.end() && !found->second.silent;
    const ports::Duration needs = there ? found->second.takes : timeout;
    if (far_->clock != nullptr)
      far_->clock->sleep_until(far_->clock->now() + std::min(needs, timeout));
    if (!there || needs > timeout || lost(*far_)) return Outcome::no_answer;
    return found->second.refuses ? Outcome::refused : Outcome::done;
  }
};

struct Ola final : Opened<FakeOla, ports::DmxStream> {
  using Opened::Opened;
  bool send(std::uint16_t universe, std::span<const std::uint8_t> levels) override {
    const std::scoped_lock lock(far_->mutex);
    if (!far_->works()) return false;
    far_->sent.push_back({universe, {levels.begin(), levels.end()}});
    return true;
  }
};

template <class Fakes>
std::vector<ports::DeviceFound> plugged(const Fakes& fakes) {
  std::vector<ports::DeviceFound> found;
  for (const auto& fake : fakes) {
    const std::scoped_lock lock(fake->mutex);
    if (fake->plugged) found.push_back(fake->found);
  }
  return found;
}

/// Opens the one device that is meant, as the real devices do.
template <class Opener, class Port, class Fakes>
core::Result<std::unique_ptr<Port>> open_one(const ports::DeviceMatch& match, const Fakes& fakes) {
  const auto chosen = ports::choose(match, plugged(fakes));
  if (!chosen) return chosen.problems();
  for (const auto& fake : fakes) {
    if (!fake->plugged || !ports::matches(chosen->identity, fake->found.identity)) continue;
    if (fake->forbidden)
      return core::Problem{{}, "may not open " + to_string(match) + ": Permission denied", ""};
    return std::unique_ptr<Port>(std::make_unique<Opener>(fake));
  }
  return core::Problem{{}, to_string(match) + " vanished", ""};
}

template <class Fake>
std::shared_ptr<Fake> fresh(const ports::DeviceMatch& identity, const std::string& driver) {
  auto fake = std::make_shared<Fake>();
  fake->found = {identity, driver};
  return fake;
}

}  // namespace

FakeDevices::FakeDevices() = default;
FakeDevices::~FakeDevices() = default;

std::shared_ptr<FakeSerial> FakeDevices::plug_serial(const ports::DeviceMatch& identity,
                                                     const std::string& kernel_driver) {
  const std::scoped_lock lock(mutex_);
  return serials_.emplace_back(fresh<FakeSerial>(identity, kernel_driver));
}
std::shared_ptr<FakeUsb> FakeDevices::plug_usb(const ports::DeviceMatch& identity) {
  const std::scoped_lock lock(mutex_);
  return usbs_.emplace_back(fresh<FakeUsb>(identity, ""));
}
std::shared_ptr<FakeHid> FakeDevices::plug_hid(const ports::DeviceMatch& identity) {
  const std::scoped_lock lock(mutex_);
  return hids_.emplace_back(fresh<FakeHid>(identity, "hid-generic"));
}
std::shared_ptr<FakeGpioLine> FakeDevices::plug_gpio(const std::string& chip, unsigned line) {
  const std::scoped_lock lock(mutex_);
  auto fake = std::make_shared<FakeGpioLine>();
  fake->settings.chip = chip;
  fake->settings.line = line;
  return gpios_.emplace_back(fake);
}
std::shared_ptr<FakeMidi> FakeDevices::plug_midi(const std::string& name) {
  const std::scoped_lock lock(mutex_);
  return midis_.emplace_back(fresh<FakeMidi>({.name = name}, ""));
}
std::shared_ptr<FakeModbus> FakeDevices::plug_modbus(const std::string& host_or_node) {
  const std::scoped_lock lock(mutex_);
  return modbuses_.emplace_back(fresh<FakeModbus>({.node = host_or_node}, ""));
}
std::shared_ptr<FakeOla> FakeDevices::plug_ola() {
  const std::scoped_lock lock(mutex_);
  return ola_ = std::make_shared<FakeOla>();
}

std::vector<ports::DeviceFound> FakeDevices::usb() {
  const std::scoped_lock lock(mutex_);
  auto found = plugged(serials_);
  for (const auto& one : plugged(usbs_)) found.push_back(one);
  return found;
}
std::vector<ports::DeviceFound> FakeDevices::hid() {
  const std::scoped_lock lock(mutex_);
  return plugged(hids_);
}

core::Result<std::unique_ptr<ports::SerialPort>> FakeDevices::open_serial(
    const ports::DeviceMatch& match, const ports::SerialSettings& settings) {
  const std::scoped_lock lock(mutex_);
  const auto chosen = ports::choose(match, plugged(serials_));
  if (chosen)
    for (const auto& fake : serials_)
      if (ports::matches(chosen->identity, fake->found.identity)) fake->settings = settings;
  return open_one<Serial, ports::SerialPort>(match, serials_);
}
core::Result<std::unique_ptr<ports::UsbDevice>> FakeDevices::open_usb(
    const ports::DeviceMatch& match) {
  const std::scoped_lock lock(mutex_);
  return open_one<Usb, ports::UsbDevice>(match, usbs_);
}
core::Result<std::unique_ptr<ports::HidDevice>> FakeDevices::open_hid(
    const ports::DeviceMatch& match) {
  const std::scoped_lock lock(mutex_);
  return open_one<Hid, ports::HidDevice>(match, hids_);
}
core::Result<std::unique_ptr<ports::GpioLine>> FakeDevices::open_gpio(
    const ports::GpioSettings& settings) {
  const std::scoped_lock lock(mutex_);
  for (const auto& fake : gpios_)
    if (fake->plugged && fake->settings.chip == settings.chip &&
        fake->settings.line == settings.line) {
      fake->settings = settings;
      return std::unique_ptr<ports::GpioLine>(std::make_unique<Gpio>(fake));
    }
  return core::Problem{{}, "there is no line " + std::to_string(settings.line), ""};
}
core::Result<std::unique_ptr<ports::MidiPort>> FakeDevices::open_midi(const std::string& name) {
  const std::scoped_lock lock(mutex_);
  return open_one<Midi, ports::MidiPort>({.name = name}, midis_);
}
core::Result<std::unique_ptr<ports::ModbusLink>> FakeDevices::open_modbus(
    const ports::ModbusLine& line) {
  const std::scoped_lock lock(mutex_);
  return open_one<Modbus, ports::ModbusLink>(
      {.node = line.host.empty() ? line.serial.node : line.host}, modbuses_);
}
core::Result<std::unique_ptr<ports::DmxStream>> FakeDevices::open_ola() {
  const std::scoped_lock lock(mutex_);
  if (!ola_ || !ola_->plugged) return core::Problem{{}, "olad does not answer", ""};
  return std::unique_ptr<ports::DmxStream>(std::make_unique<Ola>(ola_));
}

}  // namespace chiaro::support
