// SPDX-License-Identifier: Apache-2.0
// MIDI surfaces by RtMidi.
#include "drivers/common/system_devices.h"

#if CHIARO_WITH_MIDI
#include <algorithm>
#include <rtmidi/RtMidi.h>
#endif

namespace chiaro::drivers {
#if CHIARO_WITH_MIDI
namespace {

class Midi final : public ports::MidiPort {
 public:
  /// False when there is no such device. The library throws where there is no sequencer at all.
  bool open(const std::string& name) {
    name_ = name;
    const auto in = find(in_);
    if (!in) return false;
    in_.openPort(*in, "Chiaro");
    in_.ignoreTypes(true, true, true);
    if (const auto out = find(out_)) out_.openPort(*out, "Chiaro");
    return true;
  }
  std::optional<std::size_t> receive(std::span<std::uint8_t> into) override {
    try {
      std::vector<unsigned char> message;
      in_.getMessage(&message);
      if (message.empty() && !find(in_)) return std::nullopt;
      const std::size_t size = std::min(message.size(), into.size());
      std::copy_n(message.begin(), size, into.begin());
      return size;
    } catch (const RtMidiError&) {
      return std::nullopt;
    }
  }
  bool send(std::span<const std::uint8_t> message) override {
    if (!out_.isPortOpen()) return true;  // a surface without lamps
    try {
      out_.sendMessage(message.data(), message.size());
      return true;
    } catch (const RtMidiError&) {
      return false;
    }
  }

 private:
  std::optional<unsigned> find(RtMidi& direction) const {
    for (unsigned i = 0; i < direction.getPortCount(); ++i)
      if (direction.getPortName(i).find(name_) != std::string::npos) return i;
    return std::nullopt;
  }
  std::string name_;
  RtMidiIn in_{RtMidi::UNSPECIFIED, "Chiaro"};
  RtMidiOut out_{RtMidi::UNSPECIFIED, "Chiaro"};
};

}  // namespace

core::Result<std::unique_ptr<ports::MidiPort>> SystemDevices::open_midi(const std::string& name) {
  std::string why = "is not plugged in";
  try {
    auto port = std::make_unique<Midi>();
    if (port->open(name)) return std::unique_ptr<ports::MidiPort>(std::move(port));
  } catch (const RtMidiError& error) {
    why = "cannot be opened: " + error.getMessage();
  }
  return core::Problem{{}, "the MIDI device '" + name + "' " + why, "`aconnect -l` lists them"};
}
#else
core::Result<std::unique_ptr<ports::MidiPort>> SystemDevices::open_midi(const std::string& name) {
  return built_without("RtMidi", "the MIDI device '" + name + "'", "librtmidi-dev");
}
#endif
}  // namespace chiaro::drivers
