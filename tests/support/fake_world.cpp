// SPDX-License-Identifier: Apache-2.0
#include "tests/support/fake_world.h"

#include <cstdlib>
#include <stdexcept>
#include <string>

namespace chiaro::support {

TemporaryFolder::TemporaryFolder() {
  std::string name = "/tmp/chiaro-test-XXXXXX";
  if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make " + name);
  path_ = name;
}
TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

FakeWorld::~FakeWorld() = default;

FakeWorld::FakeWorld(FakeClock& clock, ports::Network& network, const std::filesystem::path& folder)
    : world{clock,
            network,
            devices,
            in,
            out,
            err,
            false,
            std::filesystem::path(CHIARO_SOURCE) / "config",
            folder / "state",
            folder / "run",
            stop,
            reload} {
  std::filesystem::create_directories(folder / "state");
  std::filesystem::create_directories(folder / "run");
}

}  // namespace chiaro::support
