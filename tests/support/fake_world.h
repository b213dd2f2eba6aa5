// SPDX-License-Identifier: Apache-2.0
// A World for one program in a test: fake time, a network in memory, streams that can be read back
// and folders of its own that vanish with it. Several programs of one test share clock and network.
#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <sstream>

#include "controller/ports/world.h"
#include "tests/support/fake_clock.h"
#include "tests/support/fake_devices.h"
#include "tests/support/fake_network.h"

namespace chiaro::support {

/// A new empty folder with a short path (Unix sockets allow 107 characters), removed at the end.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// `out` and `err` may be read once the program has ended: its threads write them unguarded.
struct FakeWorld {
  /// Programs that talk through boxes and sockets share `folder`.
  FakeWorld(FakeClock& clock, ports::Network& network, const std::filesystem::path& folder);
  ~FakeWorld();

  FakeDevices devices;
  std::istringstream in;
  std::ostringstream out, err;
  std::atomic<bool> stop{false}, reload{false};
  ports::World world;
};

}  // namespace chiaro::support
