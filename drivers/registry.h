// SPDX-License-Identifier: Apache-2.0
// Every driver by name, from drivers.def. Settings are plain values: a driver knows nothing of the
// studio file.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "controller/core/result.h"
#include "controller/ports/camera.h"
#include "controller/ports/input.h"
#include "controller/ports/output.h"
#include "controller/ports/surface.h"
#include "drivers/common/modbus_axis.h"
#include "drivers/common/modbus_module.h"
#include "drivers/common/surface_settings.h"
#include "drivers/common/surroundings.h"

namespace chiaro::drivers {

class VideoCalls;

/// What a port needs to know; a driver ignores what it has no use for.
struct OutputSettings {
  std::uint16_t universe = 1;
  std::string source_name = "Chiaro";

  // Over the network.
  std::string interface;               ///< network interface; "" = the system's choice
  std::string unicast;                 ///< dotted IPv4; "" = multicast, or Art-Net's subscribers
  int priority = 100;                  ///< sACN
  std::array<std::uint8_t, 16> cid{};  ///< who we are, the same after every restart
  std::uint16_t sync = 0;              ///< sACN: synchronisation universe; 0 = none
  bool art_sync = false;               ///< Art-Net: ArtSync after the last universe of each frame
  bool broadcast = false;              ///< Art-Net: to everybody, for nodes that answer no poll
  int port_address = -1;               ///< Art-Net's 15 bits; -1 = universe - 1
  /// Universes of this source on this interface, ascending. The port of the first one speaks for
  /// all (universe discovery), that of the last one ends each frame (synchronisation).
  std::vector<std::uint16_t> together;
  /// Says an unchanged universe only every 0.8 s after four repeats.
  bool quiet = false;

  // On a USB or serial line.
  ports::DeviceMatch device;
  int slots = 512;  ///< how many leave; some receivers flicker less with fewer
  int break_us = 176, mab_us = 16;
  double rate_hz = 40;             ///< a dongle that times itself is told
  int dongle_port = 1;             ///< of a dongle with several
  std::uint16_t ola_universe = 0;  ///< 0 = universe

  // A device on a Modbus line.
  ports::ModbusLine line;
  modbus::ModuleSettings module;
  std::vector<modbus::AxisSettings> axes;
  friend bool operator==(const OutputSettings&, const OutputSettings&) = default;
};

struct OutputEntry {
  std::string_view name, summary;
  std::unique_ptr<ports::OutputPort> (*make)(const OutputSettings& settings, Surroundings& around);
};
std::span<const OutputEntry> outputs();
/// The port, closed; a problem that names the nearest driver when there is none of that name.
core::Result<std::unique_ptr<ports::OutputPort>> make_output(const std::string& driver,
                                                             const OutputSettings& settings,
                                                             Surroundings& around);

/// What a DMX input needs to know.
struct InputSettings {
  std::vector<std::uint16_t> universes;
  std::string interface;
  std::string name = "Chiaro";  ///< Art-Net: what a controller's list of nodes shows
};

struct InputEntry {
  std::string_view name, summary;
  std::unique_ptr<ports::DmxInput> (*make)(const InputSettings& settings, Surroundings& around);
};
std::span<const InputEntry> inputs();
core::Result<std::unique_ptr<ports::DmxInput>> make_input(const std::string& driver,
                                                          const InputSettings& settings,
                                                          Surroundings& around);

struct SurfaceEntry {
  std::string_view name, summary;
  std::unique_ptr<ports::Surface> (*make)(const SurfaceSettings& settings, Surroundings& around);
};
std::span<const SurfaceEntry> surfaces();
core::Result<std::unique_ptr<ports::Surface>> make_surface(const std::string& driver,
                                                           const SurfaceSettings& settings,
                                                           Surroundings& around);

/// What a camera driver needs to know. `stop` ends a grab early; it outlives the camera.
struct CameraSettings {
  std::string source;  ///< as in the studio file: "http://host/picture"
  const std::atomic<bool>* stop = nullptr;
  core::Size size{640, 480};  ///< wished for; the camera gives the nearest that it has
  /// Where to hold what a camera would set by itself; where it stands when not given. In V4L2's
  /// units: 100 us, the device's own, kelvin.
  std::optional<std::int32_t> exposure_100us{}, gain{}, white_balance{};
  VideoCalls* video = nullptr;  ///< null = the system's
};

struct CameraEntry {
  std::string_view name, summary;  ///< the name is the source's scheme
  std::unique_ptr<ports::Camera> (*make)(const CameraSettings& settings, ports::Clock& clock);
};
std::span<const CameraEntry> cameras();
/// The camera for that source; a problem when no driver knows its scheme.
core::Result<std::unique_ptr<ports::Camera>> make_camera(const CameraSettings& settings,
                                                         ports::Clock& clock);

}  // namespace chiaro::drivers
