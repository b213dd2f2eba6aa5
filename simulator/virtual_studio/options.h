// SPDX-License-Identifier: Apache-2.0
// What chiaro-sim can be told on its command line.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "controller/ports/world.h"
#include "simulator/virtual_studio/camera.h"
#include "simulator/virtual_studio/lamp.h"
#include "simulator/virtual_studio/noise.h"

namespace chiaro::simulator {

struct SimOptions {
  std::string studio;
  std::uint16_t port = 8091;
  CameraOptions camera;
  double rate_hz = 15;
  Departures departures;
  Sensor sensor;
  bool stagehand = true;
  double stand_time_s = 1.5;
  std::string daemon = "http://127.0.0.1:8090";
  std::uint64_t seed = 1;
};
/// Nothing when the program must end with `exit` at once (help, or a wrong word).
std::optional<SimOptions> parse_sim_options(std::span<const std::string> arguments,
                                            ports::World& world, ports::Exit& exit);

}  // namespace chiaro::simulator
