// SPDX-License-Identifier: Apache-2.0
// What must be true of every output driver in drivers.def, over the network, USB or a serial line.
#include <gtest/gtest.h>

#include "drivers/registry.h"
#include "tests/support/stage_for_outputs.h"

namespace chiaro::drivers {
namespace {

using namespace std::chrono_literals;

class EveryOutput : public testing::TestWithParam<OutputEntry> {
 protected:
  void SetUp() override {
    ASSERT_TRUE(stage_.known()) << "give it a far end in tests/support/stage_for_outputs.cpp";
  }
  void send(std::uint8_t level) {
    frame_.levels.fill(level);
    now_ += 25ms;
    stage_.clock().advance(25ms);
    port_->send(frame_, now_);
  }

  support::StageForOutputs stage_{std::string(GetParam().name)};
  std::unique_ptr<ports::OutputPort> port_ = GetParam().make(stage_.settings(), stage_.around());
  ports::DmxFrame frame_;
  ports::TimePoint now_ = stage_.clock().now();
};

TEST_P(EveryOutput, IsClosedUntilOpenedAndSendsNothingBefore) {
  EXPECT_EQ(port_->report().health, ports::PortHealth::closed);
  send(1);
  EXPECT_EQ(stage_.reached(), 0u);
  EXPECT_EQ(port_->report().frames_sent, 0u);
}

TEST_P(EveryOutput, CountsWhatItSendsAndClosesOnRelease) {
  ASSERT_TRUE(port_->open());
  EXPECT_EQ(port_->report().health, ports::PortHealth::good);
  for (std::uint8_t i = 0; i < 10; ++i) send(i);
  EXPECT_EQ(port_->report().frames_sent, 10u);
  EXPECT_EQ(port_->report().frames_failed, 0u);
  port_->release(now_);
  EXPECT_EQ(port_->report().health, ports::PortHealth::closed);
}

TEST_P(EveryOutput, SendsNothingAfterRelease) {
  ASSERT_TRUE(port_->open());
  port_->release(now_);
  const auto before = stage_.reached();
  send(9);
  EXPECT_EQ(stage_.reached(), before);
}

TEST_P(EveryOutput, OpensAgainAfterRelease) {
  ASSERT_TRUE(port_->open());
  port_->release(now_);
  ASSERT_TRUE(port_->open());
  EXPECT_EQ(port_->report().health, ports::PortHealth::good);
}

TEST_P(EveryOutput, ReachesTheWireOnlyWhenItSaysItIsPhysical) {
  ASSERT_TRUE(port_->open());
  send(7);
  EXPECT_EQ(stage_.reached() > 0, port_->physical());
}

TEST_P(EveryOutput, SaysThatItBlocksWhenItsDeviceKeepsItWaiting) {
  ASSERT_TRUE(port_->open());
  if (stage_.serial() != nullptr) stage_.serial()->delay = 5ms;
  const auto before = stage_.clock().now();
  send(1);
  const bool waited = stage_.clock().now() > before + 25ms;
  EXPECT_TRUE(port_->blocks() || !waited);
}

/// The device's plug is pulled and put back; who owns the port opens it again while it is lost.
TEST_P(EveryOutput, SurvivesALostLinkAndComesBackWithTheSamePatch) {
  ASSERT_TRUE(port_->open());
  send(1);
  stage_.unplug(true);
  send(2);
  if (port_->physical()) {
    EXPECT_EQ(port_->report().health, ports::PortHealth::lost);
    EXPECT_GE(port_->report().frames_failed, 1u);
  }
  (void)port_->open();  // nobody there yet
  send(3);
  stage_.unplug(false);
  ASSERT_TRUE(port_->open());
  const auto before = stage_.reached();
  send(4);
  EXPECT_EQ(port_->report().health, ports::PortHealth::good);
  EXPECT_EQ(stage_.reached() > before, port_->physical());
  send(5);
  EXPECT_EQ(port_->report().health, ports::PortHealth::good);
}

TEST_P(EveryOutput, OneFailedSendIsCountedAndLosesNoMoreThanThat) {
  ASSERT_TRUE(port_->open());
  send(1);
  stage_.unplug(true);
  send(2);
  stage_.unplug(false);
  if (port_->report().health != ports::PortHealth::good) {
    ASSERT_TRUE(port_->open());
  }
  send(3);
  EXPECT_EQ(port_->report().frames_sent, port_->physical() ? 2u : 3u);
  EXPECT_EQ(port_->report().frames_failed, port_->physical() ? 1u : 0u);
}

INSTANTIATE_TEST_SUITE_P(, EveryOutput, testing::ValuesIn(outputs().begin(), outputs().end()),
                         [](const auto& about) { return std::string(about.param.name); });

TEST(Outputs, NameTheNearestDriverWhenThereIsNone) {
  support::StageForOutputs stage("mock");
  const auto port = make_output("sacnn", {}, stage.around());
  ASSERT_FALSE(port);
  EXPECT_EQ(port.problems()[0].remedy, "did you mean 'sacn'?");
}

}  // namespace
}  // namespace chiaro::drivers
