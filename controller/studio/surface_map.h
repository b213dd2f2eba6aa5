// SPDX-License-Identifier: Apache-2.0
// What the buttons, faders and lamps of a control surface do: one file format for GPIO lines, HID
// devices, MIDI controllers and OSC tablets. Maps are files in config/surfaces; a user's own stand
// in a folder `surfaces` beside the studio file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "controller/core/dof.h"
#include "controller/core/result.h"

namespace chiaro::studio {

/// What one use of a control asks for. All but the last three kinds need no brain.
struct Deed {
  enum class Kind : std::uint8_t {
    blackout,
    motion_stop,
    motion_arm,
    blind,
    mark,     ///< `name` on the lamp `lamp`: highlight, flash, solo, park or move in black
    release,  ///< lets the faders of `lamp` go
    master,   ///< index
    level,    ///< of `lamp`: its intensity, or what `dof` says
    cue_go,
    cue_back,
    cue_off,
    cue_to,  ///< `amount`
    look,    ///< recalls the kept look `name`
    mood,    ///< finds and applies the mood `name`
    nudge    ///< `name`: brighter, softer, warmer or contrast, by `amount` stops
  };
  enum class Press : std::uint8_t {
    toggle,  ///< turned round at every press
    on,      ///< nothing here takes it back: for stop contacts
    off,
    follow  ///< as long as it is held
  };
  Kind kind = Kind::blackout;
  Press press = Press::toggle;
  std::string name{};
  std::string lamp = "*";  ///< "*" = every one
  core::Dof dof = core::Dof::intensity;
  int master = 0;      ///< 0 grand, 1 key, 2 fill, 3 back, 4 background
  double step = 0.02;  ///< master and level: what one detent of an encoder adds
  double amount = 0;   ///< a cue's number; a nudge's stops at a press or a detent
  core::Place place{};
};
constexpr bool needs_brain(Deed::Kind kind) { return kind >= Deed::Kind::look; }
/// "blackout", "master grand", "level of key": for lists.
std::string in_words(const Deed& deed);

/// What a control's lamp, motor, display or relay answers to.
struct Shown {
  enum class Kind : std::uint8_t {
    nothing,
    blackout,
    motion_stop,
    motion_arm,
    cue,      ///< lit while a cue is on stage
    master,   ///< how far it is open
    level,    ///< of `lamp`, from end to end
    lit,      ///< lit while `lamp` gives light: tally, relay
    mark,     ///< lit while `lamp` has the mark `name`
    holding,  ///< lit while the levels are held because no brain is heard
    trouble   ///< lit while a port is lost
  };
  Kind kind = Kind::nothing;
  std::string name{}, lamp = "*";
  core::Dof dof = core::Dof::intensity;
  int master = 0;
  double cue = -1;  ///< of one cue alone; -1 = any
  core::Place place{};
};
std::string in_words(const Shown& shown);

struct SurfaceControl {
  std::string name;
  enum class Kind : std::uint8_t { button, fader, encoder };
  Kind kind = Kind::button;
  std::vector<Deed> deeds;  ///< none: it only shows
  Shown shown;

  // Where it is, by the map's driver.
  enum class Midi : std::uint8_t { none, note, controller, pitch_bend };
  Midi midi = Midi::none;
  int channel = 0, number = 0;  ///< MIDI; channel 0..15
  /// HID: a button is one bit of the input report, an encoder a signed byte, a fader one or two
  /// bytes up to `most`; its lamp is a bit of the output report, -1 = none.
  int byte = -1, bit = 0, bytes = 1, most = 255, lamp_byte = -1, lamp_bit = 0;
  std::string osc{};   ///< address
  std::string chip{};  ///< GPIO
  int line = -1;
  bool output = false, active_low = false, pull_up = false;
  double debounce_s = 0.02;
  core::Place place{};
};

struct SurfaceMap {
  std::string name;           ///< "korg/nanokontrol2"
  std::string maker, device;  ///< for people
  std::string driver;         ///< "gpio", "hid", "midi" or "osc"
  // How it calls itself, unless the studio file says which one.
  std::string midi_name;
  std::uint16_t vendor = 0, product = 0;
  int report_size = 0, report_number = 0;  ///< HID: of output reports, with their number
  std::vector<SurfaceControl> controls;
  std::uint64_t fingerprint = 0;  ///< of the text
  const SurfaceControl* control(std::string_view control_name) const;
};

/// Every problem of the map at once. `own` is the user's folder, `shipped` config/surfaces.
core::Result<SurfaceMap> load_surface_map(const std::string& name, const std::filesystem::path& own,
                                          const std::filesystem::path& shipped);
core::Result<SurfaceMap> parse_surface_map(const std::string& yaml, const std::string& name,
                                           const std::string& file);
std::vector<std::string> surface_map_names(const std::filesystem::path& folder);

/// "grand", "key" …: as people call the masters.
std::string_view master_name(int master);

}  // namespace chiaro::studio
