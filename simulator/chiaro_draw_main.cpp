// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <vector>

#include "drivers/common/real_world.h"
#include "simulator/moods/draw.h"

int main(int count, char** words) {
  const std::vector<std::string> arguments(words + 1, words + count);
  return static_cast<int>(
      chiaro::simulator::run_draw(arguments, chiaro::drivers::real_world(words[0])));
}
