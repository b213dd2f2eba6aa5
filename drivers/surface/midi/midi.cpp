// SPDX-License-Identifier: Apache-2.0
// MIDI surfaces: notes are buttons, controllers are faders or encoders, pitch bend is a long fader.
// Lamps and motors answer to the same message sent back.
#include <algorithm>
#include <array>
#include <cmath>

#include "drivers/registry.h"

namespace chiaro::drivers::midi {
namespace {

using Kind = SurfaceControl::Kind;
using Midi = SurfaceControl::Midi;
constexpr std::uint8_t kNoteOff = 0x80, kNoteOn = 0x90, kController = 0xb0, kPitchBend = 0xe0;

/// Relative encoders count 1, 2 … one way and 127, 126 … the other.
double steps(std::uint8_t value) { return value < 64 ? value : value - 128; }

class MidiSurface final : public ports::Surface {
 public:
  MidiSurface(const SurfaceSettings& settings, Surroundings& around)
      : settings_(settings), around_(around) {}

  core::Result<core::Done> open() override {
    port_.reset();
    auto port = around_.devices.open_midi(settings_.midi_name);
    if (!port) return port.problems();
    port_ = std::move(*port);
    health_ = ports::PortHealth::good;
    return core::Done{};
  }

  std::vector<ports::SurfaceEvent> listen(ports::TimePoint) override {
    std::vector<ports::SurfaceEvent> events;
    std::array<std::uint8_t, 16> message{};
    while (port_) {
      const auto size = port_->receive(message);
      if (!size) return lose(), events;
      if (*size == 0) break;
      if (*size >= 3) hear(message, events);
    }
    return events;
  }

  void show(const std::string& name, double value, const std::string&) override {
    const auto control = std::find_if(settings_.controls.begin(), settings_.controls.end(),
                                      [&](const auto& one) { return one.name == name; });
    if (!port_ || control == settings_.controls.end()) return;
    const auto seven = static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 1.0) * 127));
    std::array<std::uint8_t, 3> message{0, control->number, seven};
    switch (control->midi) {
      case Midi::note:
        message[0] = kNoteOn;
        break;
      case Midi::controller:
        message[0] = kController;
        break;
      case Midi::pitch_bend: {
        const auto bend = static_cast<unsigned>(std::lround(std::clamp(value, 0.0, 1.0) * 16383));
        message = {kPitchBend, static_cast<std::uint8_t>(bend & 0x7fu),
                   static_cast<std::uint8_t>(bend >> 7u)};
        break;
      }
      case Midi::none:
        return;
    }
    message[0] = static_cast<std::uint8_t>(message[0] | control->channel);
    if (!port_->send(message)) lose();
  }
  ports::PortHealth health() const override { return health_; }

 private:
  void hear(const std::array<std::uint8_t, 16>& m, std::vector<ports::SurfaceEvent>& events) const {
    const auto status = static_cast<std::uint8_t>(m[0] & 0xf0u),
               channel = static_cast<std::uint8_t>(m[0] & 0x0fu);
    for (const SurfaceControl& control : settings_.controls) {
      if (control.channel != channel) continue;
      const bool note = status == kNoteOn || status == kNoteOff;
      if (control.midi == Midi::note && note && control.number == m[1])
        events.push_back({control.name, status == kNoteOn && m[2] > 0 ? 1.0 : 0.0});
      if (control.midi == Midi::controller && status == kController && control.number == m[1])
        events.push_back({control.name, control.kind == Kind::encoder  ? steps(m[2])
                                        : control.kind == Kind::button ? (m[2] >= 64 ? 1.0 : 0.0)
                                                                       : m[2] / 127.0});
      if (control.midi == Midi::pitch_bend && status == kPitchBend)
        events.push_back({control.name, (m[1] | m[2] << 7) / 16383.0});
    }
  }
  void lose() {
    port_.reset();
    health_ = ports::PortHealth::lost;
  }

  const SurfaceSettings settings_;
  Surroundings& around_;
  std::unique_ptr<ports::MidiPort> port_;
  ports::PortHealth health_ = ports::PortHealth::closed;
};

}  // namespace

std::unique_ptr<ports::Surface> make_surface(const SurfaceSettings&, Surroundings&);
std::unique_ptr<ports::Surface> make_surface(const SurfaceSettings& settings,
                                             Surroundings& around) {
  return std::make_unique<MidiSurface>(settings, around);
}

}  // namespace chiaro::drivers::midi
