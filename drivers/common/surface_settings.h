// SPDX-License-Identifier: Apache-2.0
// A control surface as data: which device, and what each of its messages is called. One shape for
// HID, MIDI, OSC and GPIO, so that one mapping file format serves all.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "controller/ports/devices.h"

namespace chiaro::drivers {

struct SurfaceControl {
  std::string name;
  enum class Kind : std::uint8_t { button, fader, encoder };
  Kind kind = Kind::button;

  // MIDI: the message's kind and number; channel 0..15.
  enum class Midi : std::uint8_t { none, note, controller, pitch_bend };
  Midi midi = Midi::none;
  std::uint8_t channel = 0, number = 0;

  // HID: where in the input report. A button is one bit, an encoder a signed byte of steps, a fader
  // one or two bytes (low first) up to `most`.
  int byte = -1, bit = 0, bytes = 1, most = 255;
  /// HID: where in the output report its lamp is; -1 = none.
  int lamp_byte = -1, lamp_bit = 0;

  std::string osc{};  ///< address, such as /master/key

  ports::GpioSettings gpio{};
  std::chrono::milliseconds debounce{20};
  friend bool operator==(const SurfaceControl& a, const SurfaceControl& b) {
    return a.name == b.name && a.kind == b.kind;
  }
};

struct SurfaceSettings {
  ports::DeviceMatch device{};  ///< HID
  std::string midi_name{};      ///< MIDI: part of its name
  std::string interface {};     ///< OSC
  std::uint16_t port = 9000;    ///< OSC: where we listen
  int report_size = 0;          ///< HID: of output reports, with their number; 0 = no lamps
  std::uint8_t report_number = 0;
  std::vector<SurfaceControl> controls;
};

}  // namespace chiaro::drivers
