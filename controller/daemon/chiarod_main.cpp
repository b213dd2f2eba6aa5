// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <vector>

#include "controller/daemon/brain/daemon.h"
#include "drivers/common/real_world.h"

int main(int count, char** words) {
  const std::vector<std::string> arguments(words + 1, words + count);
  return static_cast<int>(
      chiaro::daemon::run_daemon(arguments, chiaro::drivers::real_world(words[0])));
}
