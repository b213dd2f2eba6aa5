// SPDX-License-Identifier: Apache-2.0
// The node's bytes are worked out by hand from config/fixtures, not by the code that encodes.
#include "simulator/virtual_studio/node.h"

#include <gtest/gtest.h>

#include "controller/studio/load.h"
#include "drivers/common/sacn_packet.h"
#include "tests/support/fake_network.h"

namespace chiaro::simulator {
namespace {

using namespace std::chrono_literals;
using core::Dof;
namespace sacn = drivers::sacn;

constexpr ports::TimePoint kStart{1000s};

class NodeTest : public testing::Test {
 protected:
  void SetUp() override {
    const std::filesystem::path config = CHIARO_SOURCE "/config";
    auto loaded = studio::load_studio(config / "studios/portrait.yaml", {config});
    ASSERT_TRUE(loaded) << core::to_string(loaded.problems());
    studio_ = std::move(loaded->studio);
    auto opened = Node::open(studio_, network_);
    ASSERT_TRUE(opened) << core::to_string(opened.problems());
    node_ = std::make_unique<Node>(std::move(*opened));
    socket_ = std::move(*network_.open_datagram({"lo", 0, false}));
  }
  /// Slot `slot` of the wire at `level`, all others 0.
  void send(std::uint8_t sequence, int slot, std::uint8_t level, std::uint8_t priority = 100,
            std::uint8_t source = 1, std::uint8_t options = 0) {
    auto packet = sacn::data_packet({{source}, "desk", priority, 1});
    std::array<std::uint8_t, 512> levels{};
    levels[static_cast<std::size_t>(slot - 1)] = level;
    sacn::set_frame(packet, sequence, options, levels);
    ASSERT_TRUE(socket_->send({sacn::multicast_group(1), sacn::kPort}, packet));
  }
  double back_at(ports::TimePoint now) {
    node_->listen(now);
    return node_->levels(now).at(*studio_.fixture_index("back")).get(Dof::intensity, -1);
  }

  support::FakeNetwork network_;
  studio::Studio studio_;
  std::unique_ptr<Node> node_;
  std::unique_ptr<ports::DatagramSocket> socket_;
};

// In the shipped studio the back light is one 8-bit channel at slot 9, linear.
constexpr int kBack = 9;

TEST_F(NodeTest, HasHeardNothingBeforeTheFirstLevels) {
  EXPECT_LE(back_at(kStart), 0);
  EXPECT_FALSE(node_->heard());
  send(1, kBack, 255, 100, 1, sacn::kPreview);
  node_->listen(kStart);
  EXPECT_FALSE(node_->heard());
}

TEST_F(NodeTest, DecodesTheLevelThroughThePatch) {
  send(1, kBack, 51);
  EXPECT_NEAR(back_at(kStart), 51 / 255.0, 1e-12);
  EXPECT_TRUE(node_->heard());
  EXPECT_EQ(node_->packets(), 1u);
  EXPECT_EQ(node_->report().front().sources, std::vector<std::string>{"desk"});
}

TEST_F(NodeTest, IgnoresLatePackets) {
  send(10, kBack, 100);
  send(9, kBack, 200);
  EXPECT_NEAR(back_at(kStart), 100 / 255.0, 1e-12);
  EXPECT_EQ(node_->out_of_sequence(), 1u);
}

TEST_F(NodeTest, ObeysTheHigherPriorityUntilItEnds) {
  send(1, kBack, 100, 100, 1);
  send(1, kBack, 40, 150, 2);
  EXPECT_NEAR(back_at(kStart), 40 / 255.0, 1e-12);
  send(2, kBack, 0, 150, 2, sacn::kTerminated);
  EXPECT_NEAR(back_at(kStart), 100 / 255.0, 1e-12);
}

TEST_F(NodeTest, HoldsTheLastLevelsWhenTheSourceIsLost) {
  send(1, kBack, 100);
  EXPECT_NEAR(back_at(kStart), 100 / 255.0, 1e-12);
  EXPECT_NEAR(back_at(kStart + 1h), 100 / 255.0, 1e-12);
  EXPECT_TRUE(node_->report().front().sources.empty());
}

TEST_F(NodeTest, ALostSourceNoLongerOutranksALivingOne) {
  send(1, kBack, 40, 150, 2);
  send(1, kBack, 100, 100, 1);
  EXPECT_NEAR(back_at(kStart), 40 / 255.0, 1e-12);
  node_->listen(kStart + 2s);
  send(2, kBack, 90, 100, 1);
  EXPECT_NEAR(back_at(kStart + 2s), 40 / 255.0, 1e-12);
  EXPECT_NEAR(back_at(kStart + 2501ms), 90 / 255.0, 1e-12);
}

TEST_F(NodeTest, IgnoresWhatIsNotSacn) {
  const std::array<std::uint8_t, 4> junk{1, 2, 3, 4};
  ASSERT_TRUE(socket_->send({sacn::multicast_group(1), sacn::kPort}, junk));
  node_->listen(kStart);
  EXPECT_FALSE(node_->heard());
}

TEST(Node, AnInterfaceThatIsNotThereIsAProblem) {
  const std::filesystem::path config = CHIARO_SOURCE "/config";
  auto loaded = studio::load_studio(config / "studios/portrait.yaml", {config});
  ASSERT_TRUE(loaded);
  std::get<studio::SacnOutput>(loaded->studio.outputs.front().driver).interface = "eth7";
  support::FakeNetwork network;
  EXPECT_FALSE(Node::open(loaded->studio, network));
}

}  // namespace
}  // namespace chiaro::simulator
