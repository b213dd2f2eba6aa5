// SPDX-License-Identifier: Apache-2.0
// What must be true of every output driver in drivers.def.
#include <gtest/gtest.h>

#include "drivers/registry.h"
#include "tests/support/fake_clock.h"
#include "tests/support/fake_devices.h"
#include "tests/support/fake_network.h"

namespace chiaro::drivers {
namespace {

using namespace std::chrono_literals;

class EveryOutput : public testing::TestWithParam<OutputEntry> {
 protected:
  support::FakeNetwork network_;
  support::FakeDevices devices_;
  support::FakeClock clock_{support::FakeClock::Sleep::jumps};
  Surroundings around_{network_, devices_, clock_};
  std::unique_ptr<ports::OutputPort> port_ = GetParam().make(OutputSettings{}, around_);
  ports::DmxFrame frame_;
};

TEST_P(EveryOutput, IsClosedUntilOpenedAndSendsNothingBefore) {
  EXPECT_EQ(port_->report().health, ports::PortHealth::closed);
  port_->send(frame_, ports::TimePoint(1s));
  EXPECT_EQ(network_.sent(), 0u);
}

TEST_P(EveryOutput, CountsWhatItSendsAndClosesOnRelease) {
  ASSERT_TRUE(port_->open());
  EXPECT_EQ(port_->report().health, ports::PortHealth::good);
  for (int i = 0; i < 10; ++i) port_->send(frame_, ports::TimePoint(1s));
  EXPECT_EQ(port_->report().frames_sent, 10u);
  EXPECT_EQ(port_->report().frames_failed, 0u);
  port_->release(ports::TimePoint(1s));
  EXPECT_EQ(port_->report().health, ports::PortHealth::closed);
}

TEST_P(EveryOutput, OpensAgainAfterRelease) {
  ASSERT_TRUE(port_->open());
  port_->release(ports::TimePoint(1s));
  ASSERT_TRUE(port_->open());
  EXPECT_EQ(port_->report().health, ports::PortHealth::good);
}

TEST_P(EveryOutput, ReachesTheWireOnlyWhenItSaysItIsPhysical) {
  ASSERT_TRUE(port_->open());
  port_->send(frame_, ports::TimePoint(1s));
  EXPECT_EQ(network_.sent() > 0, port_->physical());
}

TEST_P(EveryOutput, SurvivesALostLinkAndComesBackByItself) {
  ASSERT_TRUE(port_->open());
  network_.unplug(true);
  port_->send(frame_, ports::TimePoint(1s));
  network_.unplug(false);
  port_->send(frame_, ports::TimePoint(2s));
  EXPECT_EQ(port_->report().health, ports::PortHealth::good);
}

INSTANTIATE_TEST_SUITE_P(, EveryOutput, testing::ValuesIn(outputs().begin(), outputs().end()),
                         [](const auto& about) { return std::string(about.param.name); });

TEST(Outputs, NameTheNearestDriverWhenThereIsNone) {
  support::FakeNetwork network;
  support::FakeDevices devices;
  support::FakeClock clock;
  Surroundings around{network, devices, clock};
  const auto port = make_output("sacnn", {}, around);
  ASSERT_FALSE(port);
  EXPECT_EQ(port.problems()[0].remedy, "did you mean 'sacn'?");
}

}  // namespace
}  // namespace chiaro::drivers
