// SPDX-License-Identifier: Apache-2.0
// Every driver by name, from drivers.def. Settings are plain values: a driver knows nothing of the
// studio file.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "controller/core/result.h"
#include "controller/ports/camera.h"
#include "controller/ports/network.h"
#include "controller/ports/output.h"

namespace chiaro::drivers {

/// What a port needs to know; a driver ignores what it has no use for.
struct OutputSettings {
  std::uint16_t universe = 1;
  std::string interface;  ///< network interface; "" = the system's choice
  std::string unicast;    ///< dotted IPv4; "" = multicast
  int priority = 100;
  std::string source_name = "Chiaro";
  std::array<std::uint8_t, 16> cid{};  ///< who we are, the same after every restart
  friend bool operator==(const OutputSettings&, const OutputSettings&) = default;
};

struct OutputEntry {
  std::string_view name, summary;
  std::unique_ptr<ports::OutputPort> (*make)(const OutputSettings& settings,
                                             ports::Network& network);
};
std::span<const OutputEntry> outputs();
/// The port, closed; a problem that names the nearest driver when there is none of that name.
core::Result<std::unique_ptr<ports::OutputPort>> make_output(const std::string& driver,
                                                             const OutputSettings& settings,
                                                             ports::Network& network);

/// What a camera driver needs to know. `stop` ends a grab early; it outlives the camera.
struct CameraSettings {
  std::string source;  ///< as in the studio file: "http://host/picture"
  const std::atomic<bool>* stop = nullptr;
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
