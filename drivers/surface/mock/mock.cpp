// SPDX-License-Identifier: Apache-2.0
// A surface that nobody touches.
#include "drivers/registry.h"

namespace chiaro::drivers::mock {
namespace {

class MockSurface final : public ports::Surface {
 public:
  core::Result<core::Done> open() override {
    health_ = ports::PortHealth::good;
    return core::Done{};
  }
  std::vector<ports::SurfaceEvent> listen(ports::TimePoint) override { return {}; }
  void show(const std::string&, double, const std::string&) override {}
  ports::PortHealth health() const override { return health_; }

 private:
  ports::PortHealth health_ = ports::PortHealth::closed;
};

}  // namespace

std::unique_ptr<ports::Surface> make_surface(const SurfaceSettings&, Surroundings&);
std::unique_ptr<ports::Surface> make_surface(const SurfaceSettings&, Surroundings&) {
  return std::make_unique<MockSurface>();
}

}  // namespace chiaro::drivers::mock
