// SPDX-License-Identifier: Apache-2.0
// What others' senders mean to our inputs: peer_receiver DRIVER UNIVERSE INTERFACE [SECONDS] prints
// one line of JSON whenever the levels change.
#include <cstdlib>
#include <iostream>
#include <string>

#include "drivers/common/real_world.h"
#include "drivers/registry.h"

int main(int count, char** words) {
  using namespace chiaro;
  if (count < 4) {
    std::cerr << "Usage: peer_receiver DRIVER UNIVERSE INTERFACE [SECONDS]\n";
    return 2;
  }
  ports::World& world = drivers::real_world(words[0]);
  drivers::Surroundings around{world.network, world.devices, world.clock};
  drivers::InputSettings settings;
  settings.universes = {static_cast<std::uint16_t>(std::atoi(words[2]))};
  settings.interface = words[3];
  auto input = drivers::make_input(words[1], settings, around);
  if (!input) return 1;
  if (const auto opened = (*input)->open(); !opened) {
    std::cerr << core::to_string(opened.problems());
    return 1;
  }
  std::cout << "{\"listening\": true}" << std::endl;
  ports::DmxFrame told;
  const auto end = world.clock.now() + std::chrono::seconds(count > 4 ? std::atoi(words[4]) : 30);
  for (auto now = world.clock.now(); now < end && !world.stop; now = world.clock.now()) {
    (*input)->listen(now);
    const ports::DmxFrame& frame = (*input)->frame(0, now);
    if (frame.levels != told.levels) {
      told = frame;
      std::cout << "{\"levels\": [";
      for (std::size_t i = 0; i < frame.levels.size(); ++i)
        std::cout << (i > 0 ? "," : "") << static_cast<int>(frame.levels[i]);
      std::cout << "]}" << std::endl;
    }
    world.clock.sleep_until(now + std::chrono::milliseconds(5));
  }
  return 0;
}
