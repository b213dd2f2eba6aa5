// SPDX-License-Identifier: Apache-2.0
#include "tests/support/studio_text.h"

#include <fstream>
#include <stdexcept>

namespace chiaro::support {

const std::string& full_studio_text() {
  static const std::string kText = R"(studio: everything once
subjects:
  anna:
    stand_in: person
    eye_height: 1.55 m
    at: [-0.4, 0.1, 0]
    facing: 20 deg
    aim: [-0.4, 0.1, 1.5]
  vase:
    mesh: mesh.ply
    height: 40 cm
    at: [0.4, 0, 0.9]
    up: z
    front: -y
    material: {diffuse: [0.6, 0.5, 0.4], specular: 0.1, shininess: 24}
ceiling: 10 ft
background:
  - {plane: wall, through: [0, 2, 0], normal: [0, -2, 0], size: [6, 4], diffuse: 0.35}
  - {plane: floor, through: [0, 0, 0], normal: [0, 0, 1], specular: 0.05, shininess: 8}
cameras:
  side:
    at: [2, -2, 1.5]
    look_at: [0, 0, 1.4]
    vertical_fov: 0.5 rad
    shutter: 1/50 s
    aperture: f/2.8
    iso: 400
    lamps_may_show: yes
    source: {v4l2: /dev/video0}
  main: {at: [0, -2.6, 1.45], look_at: [0, 0, 1.35], vertical_fov: 22 deg, size: [320, 240], source: {http: "http://10.0.0.2/a"}}
  still: {at: [0, -3, 1], look_at: [0, 0, 1], vertical_fov: 30 deg, source: {file: frame.png}}
fixtures:
  key:
    role: key
    profile: generic/bicolour-panel
    mode: 4ch-16bit
    output: 14 kcd
    modifiers: [{softbox: [0.6, 0.9], loss: 1.3 stops}, bare]
    mount: {stand: {at: {azimuth: -45 deg, elevation: 35 deg, distance: 1.8 m}, azimuth: [-80 deg, 80 deg], elevation: [-45 deg, 70 deg], distance: [1.2 m, 2.4 m]}}
    patch: {universe: 1, address: 1}
    limits: {most: 80 %, dark_to_full: 2 s, safe_level: 0.1, house_light: yes, end_to_end: 20 s}
    curve: {gamma: 2.2}
    initial: {intensity: 30 %, cct: 4300 K}
  fill:
    role: fill
    profile: generic/bicolour-panel
    mode: 3ch-tint
    mount: {arc: {centre: [0, 0, 1.4], radius: 2 m, angle: [-80 deg, 80 deg], at: 40 deg, plane: vertical, axis: {universe: 2, address: 100}}}
    patch: {universe: 1, address: 5}
    curve: {table: [0, 0.1, 0.5, 1]}
  hair:
    role: hair
    profile: generic/dimmer
    mode: 1ch
    mount: {track: {from: [-1, 1, 2.5], to: [1, 1, 2.5], at: 25 %, axis: {channel: 2}}}
    patch: {universe: 2, address: 511}
  head:
    role: kicker
    profile: generic/rgb
    mode: 4ch-dimmer
    mount: {pan_tilt: {at: [1.5, 1, 2.4], aim_at: [0, 0, 1.4], pan: [-270 deg, 270 deg], tilt: [-120 deg, 120 deg]}}
    patch: {universe: 2, address: 1}
    initial: {red: 1, green: 0.5, blue: 0}
  tungsten:
    role: back
    profile: generic/dimmer
    mode: 1ch
    mount: {fixed: {at: [-0.8, 1.1, 2.3], aim_at: [0, 0, 1.4]}}
    patch: none
    by_hand: {intensity: knob, cct: {gel: [3200 K, 5600 K]}}
  flash:
    role: background
    profile: generic/daylight-dimmer
    mode: 3ch-24bit
    mount: {fixed: {at: [1.6, 0.8, 0.4], aim_at: [0.2, 2, 1.3]}}
    by_hand: {intensity: flash_power}
  drive:
    role: background
    profile: generic/rgbw
    mode: 8ch-16bit
    mount: {fixed: {at: [-1.6, 0.8, 0.4], aim_at: [0.2, 2, 1.3]}}
    patch: {modbus: rail, register: 40}
    curve: square
  window:
    role: practical
    profile: generic/dimmer
    mode: 1ch
    mount: {fixed: {at: [2, 0, 1.5], aim_at: [0, 0, 1.4]}}
    controlled: no
  free:
    role: key
    profile: generic/rgbw
    mode: 4ch
    mount: {virtual: {at: {azimuth: 10 deg, elevation: 20 deg, distance: 2 m}, separate_specular: yes}}
outputs:
  universe 1: {sacn: {interface: eth0, rate: 30 Hz, priority: 120, unicast: 10.0.0.7}}
  universe 2: mock
  universe 3: {mock: {rate: 25 Hz}}
buses:
  rail: {device: "tcp://10.0.0.9:502", baud: 19200}
exposure: {grey_card: 50 fc, white_balance: 5600 K}
ambient: {illuminance: 20 lx, cct: 4000 K}
safety: {when_silent: {fade_to_safe: {after: 60 s, over: 4 s}}, power_up: dark}
circuits:
  left wall: {limit: 2.3 kW, lamps: {hair: 650 W, head: 300 W}, tungsten: no}
keep_out:
  desk: {at: [1, -2, 1], radius: 0.8 m}
surfaces:
  faders: {midi: {map: korg/nanokontrol2, name: nanoKONTROL2 MIDI 1, do: {fader 6: {level: hair}, stop: [blackout on, motion stop]}}}
  pedal: {hid: {map: elgato/stream-deck-pedal, serial: A1, path: "1-2"}}
  tablet: {osc: {map: generic/tablet, interface: eth0, port: 9001}}
  wall: {gpio: {map: generic/wall-box, chip: gpiochip1}}
  nobody: mock
)";
  return kText;
}

void write_full_studio_files(const std::filesystem::path& folder) {
  std::ofstream(folder / "mesh.ply")
      << "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
         "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
         "0 0 0\n1 0 0\n0 0 1\n3 0 1 2\n";
  std::ofstream(folder / "mesh.obj") << "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n";
  std::ofstream(folder / "off.exr");
  std::ofstream(folder / "frame.png");
}

studio::Folders shipped_folders() { return {std::filesystem::path(CHIARO_SOURCE) / "config"}; }

std::string edited(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  if (at == std::string::npos || text.find(from, at + 1) != std::string::npos)
    throw std::logic_error("not exactly once in the text: " + from);
  return text.replace(at, from.size(), to);
}

}  // namespace chiaro::support
