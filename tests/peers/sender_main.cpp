// SPDX-License-Identifier: Apache-2.0
// One universe of known levels through one output driver, for others' receivers:
// peer_sender DRIVER UNIVERSE INTERFACE [SECONDS]. Slot n carries (7 n + 3) modulo 256, n from 0.
// For modbus INTERFACE is host:port: eight registers of two slots each, 0 to 10000.
#include <cstdlib>
#include <iostream>
#include <string>
#include <thread>

#include "drivers/common/real_world.h"
#include "drivers/registry.h"

int main(int count, char** words) {
  using namespace chiaro;
  if (count < 4) {
    std::cerr << "Usage: peer_sender DRIVER UNIVERSE INTERFACE [SECONDS]\n";
    return 2;
  }
  ports::World& world = drivers::real_world(words[0]);
  drivers::Surroundings around{world.network, world.devices, world.clock};
  drivers::OutputSettings settings;
  settings.universe = static_cast<std::uint16_t>(std::atoi(words[2]));
  settings.interface = words[3];
  settings.cid.fill(7);
  if (std::string(words[1]) == "modbus") {
    const std::string where = words[3];
    settings.line.host = where.substr(0, where.find(':'));
    settings.line.port = static_cast<std::uint16_t>(std::atoi(where.c_str() + where.find(':') + 1));
    for (std::uint16_t i = 0; i < 8; ++i)
      settings.module.channels.push_back({.slot = static_cast<std::uint16_t>(2 * i),
                                          .slots = 2,
                                          .address = static_cast<std::uint16_t>(16 + i),
                                          .to = 10000});
  }
  auto port = drivers::make_output(words[1], settings, around);
  if (!port) return 1;
  if (const auto opened = (*port)->open(); !opened) {
    std::cerr << core::to_string(opened.problems());
    return 1;
  }
  ports::DmxFrame frame;
  frame.universe = settings.universe;
  for (std::size_t i = 0; i < frame.levels.size(); ++i)
    frame.levels[i] = static_cast<std::uint8_t>((7 * i + 3) & 0xffu);
  const int seconds = count > 4 ? std::atoi(words[4]) : 8;
  for (int i = 0; i < 40 * seconds; ++i) {
    (*port)->send(frame, world.clock.now());
    world.clock.sleep_until(world.clock.now() + std::chrono::milliseconds(25));
  }
  const auto report = (*port)->report();
  std::cout << report.frames_sent << " sent, " << report.frames_failed << " failed\n";
  return report.frames_failed == 0 ? 0 : 1;
}
