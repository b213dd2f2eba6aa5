// SPDX-License-Identifier: Apache-2.0
// Art-Net conversations, written down as a script: who says what at what time.
#include <gtest/gtest.h>
#include <map>

#include "drivers/common/artnet_controller.h"
#include "drivers/common/artnet_node.h"
#include "drivers/registry.h"
#include "tests/support/stage_for_outputs.h"

namespace chiaro::drivers::artnet {
namespace {

using namespace std::chrono_literals;

const ports::TimePoint kStart{100s};
const ports::Endpoint kDesk{"10.0.0.1", kPort}, kOther{"10.0.0.2", kPort},
    kThird{"10.0.0.3", kPort};

DmxPacket dmx(int port_address, std::uint8_t sequence, std::uint8_t level) {
  DmxPacket packet = dmx_packet(port_address);
  std::array<std::uint8_t, kSlots> levels;
  levels.fill(level);
  set_frame(packet, sequence, levels);
  return packet;
}

TEST(ArtNetPackets, ReadBackWhatWasWritten) {
  const auto packet = dmx(0x1234, 200, 9);
  const auto read = parse_dmx(packet);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->port_address, 0x1234);
  EXPECT_EQ(read->sequence, 200);
  EXPECT_EQ(read->levels.size(), 512u);
}

TEST(ArtNetPackets, RefuseOddLongAndCutLengths) {
  const auto with_length = [](unsigned length) {
    auto packet = dmx(0, 1, 1);
    packet[16] = static_cast<std::uint8_t>(length >> 8);
    packet[17] = static_cast<std::uint8_t>(length & 255);
    return parse_dmx(packet).has_value();
  };
  EXPECT_TRUE(with_length(512) && with_length(2) && with_length(24));
  EXPECT_FALSE(with_length(0) || with_length(3) || with_length(514));
  const auto whole = dmx(0, 1, 1);
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_FALSE(parse_dmx(std::span(whole).first(size))) << size;
}

TEST(ArtNetPackets, RefuseAnOlderProtocolAndTheOtherEndsOperationCode) {
  auto packet = dmx(0, 1, 1);
  packet[11] = 13;
  EXPECT_FALSE(parse_dmx(packet));
  packet = dmx(0, 1, 1);
  std::swap(packet[8], packet[9]);
  EXPECT_FALSE(parse_dmx(packet));
}

TEST(ArtNetSequence, RunsFrom1To255AndZeroIsAlwaysNew) {
  EXPECT_TRUE(in_sequence(255, 1));
  EXPECT_TRUE(in_sequence(1, 2));
  EXPECT_FALSE(in_sequence(5, 5));
  EXPECT_FALSE(in_sequence(5, 4));
  EXPECT_FALSE(in_sequence(5, 250));
  EXPECT_TRUE(in_sequence(100, 60));
  EXPECT_TRUE(in_sequence(7, 0));
  EXPECT_TRUE(in_sequence(0, 7));
}

class ANode : public testing::Test {
 protected:
  Node node_{{0, 1, 17}, {{10, 0, 0, 9}, {2, 0, 0, 0, 0, 9}, "Lamps"}};
  Node::Heard hear(std::span<const std::uint8_t> bytes, const ports::Endpoint& from,
                   ports::Duration at) {
    return node_.hear(bytes, from, kStart + at);
  }
};

TEST_F(ANode, AnswersAPollWithinASecondAndOnce) {
  EXPECT_EQ(hear(poll_packet(), kDesk, 0s), Node::Heard::poll);
  std::vector<Node::Answer> answers;
  for (auto at = 0ms; at <= 1000ms; at += 10ms)
    for (auto& answer : node_.answers(kStart + at)) answers.push_back(answer);
  // Port-addresses 0 and 1 share a sub-net; 17 has another, hence a second answer.
  ASSERT_EQ(answers.size(), 2u);
  EXPECT_EQ(answers[0].to, kDesk);
  const auto first = parse_reply(answers[0].bytes), second = parse_reply(answers[1].bytes);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->outputs, 2u);
  EXPECT_EQ(first->bind_index, 1);
  EXPECT_EQ(second->port_addresses[0], 17);
  EXPECT_EQ(second->bind_index, 2);
  EXPECT_EQ(name_in_reply(answers[0].bytes), "Lamps");
  EXPECT_TRUE(node_.answers(kStart + 5s).empty());
}

TEST_F(ANode, MergesTwoSendersAndForgetsOneAfterTenSeconds) {
  hear(dmx(0, 1, 40), kDesk, 0s);
  hear(dmx(0, 1, 60), kOther, 1s);
  EXPECT_EQ(hear(dmx(0, 1, 255), kThird, 1s), Node::Heard::third_source);
  EXPECT_EQ(node_.levels(0, kStart + 1s)[5], 60);
  for (auto at = 2s; at <= 12s; at += 1s)
    hear(dmx(0, static_cast<std::uint8_t>(at.count()), 40), kDesk, at);
  EXPECT_EQ(node_.levels(0, kStart + 12s)[5], 40);
  EXPECT_EQ(node_.sources(0), std::vector<std::string>{"10.0.0.1"});
}

TEST_F(ANode, WaitsForSyncOnceItHasComeAndNoLongerFourSecondsLater) {
  hear(dmx(0, 1, 10), kDesk, 0s);
  EXPECT_EQ(node_.levels(0, kStart)[0], 10);  // no sync yet: at once
  EXPECT_EQ(hear(sync_packet(), kDesk, 1s), Node::Heard::sync);
  hear(dmx(0, 2, 20), kDesk, 2s);
  EXPECT_EQ(node_.levels(0, kStart + 2s)[0], 10);
  hear(sync_packet(), kDesk, 3s);
  EXPECT_EQ(node_.levels(0, kStart + 3s)[0], 20);
  hear(dmx(0, 3, 30), kDesk, 4s);
  EXPECT_EQ(node_.levels(0, kStart + 6900ms)[0], 20);
  EXPECT_EQ(node_.levels(0, kStart + 7100ms)[0], 30);
}

TEST_F(ANode, IgnoresSyncWhileItMerges) {
  hear(sync_packet(), kDesk, 0s);
  hear(dmx(0, 1, 40), kDesk, 1s);
  hear(dmx(0, 1, 60), kOther, 1s);
  EXPECT_EQ(node_.levels(0, kStart + 1s)[0], 60);
}

TEST_F(ANode, DropsWhatComesLateAndWhatIsForOthers) {
  hear(dmx(0, 9, 90), kDesk, 0s);
  EXPECT_EQ(hear(dmx(0, 8, 80), kDesk, 0s), Node::Heard::out_of_sequence);
  EXPECT_EQ(hear(dmx(5, 1, 80), kDesk, 0s), Node::Heard::other_port);
  EXPECT_EQ(node_.levels(0, kStart)[0], 90);
}

/// The port of a studio in a conversation with nodes on the same wire.
class ASender : public testing::Test {
 protected:
  ASender() {
    node_socket_ = std::move(*stage_.network().open_datagram({"lo", kPort, true, false}));
    settings_.universe = 1;
    settings_.interface = "lo";
  }
  std::unique_ptr<ports::OutputPort> port() {
    auto port = std::move(*make_output("artnet", settings_, stage_.around()));
    EXPECT_TRUE(port->open());
    return port;
  }
  void frame(ports::OutputPort& port) {
    now_ += 25ms;
    port.send(frame_, now_);
  }
  /// What the node has heard since it was last asked, by operation.
  std::map<Operation, int> heard() {
    std::map<Operation, int> count;
    std::array<std::uint8_t, 1024> bytes;
    while (const auto size = node_socket_->receive(bytes, nullptr))
      if (const auto operation = operation_of(std::span(bytes).first(*size))) ++count[*operation];
    return count;
  }
  void answer(std::uint8_t universe) {
    Reply reply;
    reply.ip = {127, 0, 0, 1};
    reply.short_name = "node";
    reply.ports = {{universe, true, false, false}};
    node_socket_->send({"127.0.0.1", kPort}, reply_packet(reply));
  }

  support::StageForOutputs stage_{"mock"};
  OutputSettings settings_;
  ports::DmxFrame frame_;
  ports::TimePoint now_ = stage_.clock().now();
  std::unique_ptr<ports::DatagramSocket> node_socket_;
};

TEST_F(ASender, PollsEverybodyBetweenTwoAndAHalfAndThreeSecondsApart) {
  auto sender = port();
  for (int i = 0; i < 400; ++i) frame(*sender);  // ten seconds
  EXPECT_EQ(heard()[Operation::poll], 4);
}

TEST_F(ASender, SendsLevelsOnlyToWhoAskedAndStopsWhenItIsGone) {
  auto sender = port();
  frame(*sender);
  EXPECT_EQ(heard()[Operation::dmx], 0);
  answer(5);  // wants another universe
  frame(*sender);
  frame(*sender);
  EXPECT_EQ(heard()[Operation::dmx], 0);
  answer(0);
  for (int i = 0; i < 10; ++i) frame(*sender);
  // The wire in memory gives a datagram to both sockets on the port: the node's is one of them.
  EXPECT_EQ(heard()[Operation::dmx], 10);
  now_ += Controller::kGone + 1s;
  heard();
  frame(*sender);
  EXPECT_EQ(heard()[Operation::dmx], 0);
}

/// A socket at which datagrams come faster than anybody reads them.
class EndlessSocket final : public ports::DatagramSocket {
 public:
  explicit EndlessSocket(int& read) : read_(read) {}
  bool send(const ports::Endpoint&, std::span<const std::uint8_t>) override { return true; }
  std::optional<std::size_t> receive(std::span<std::uint8_t> into, ports::Endpoint*) override {
    ++read_;
    const auto packet = dmx_packet(1);
    std::copy(packet.begin(), packet.end(), into.begin());
    return packet.size();
  }
  core::Result<core::Done> join(const std::string&) override { return core::Done{}; }

 private:
  int& read_;
};
class EndlessNetwork final : public ports::Network {
 public:
  core::Result<std::unique_ptr<ports::DatagramSocket>> open_datagram(const Options&) override {
    return std::unique_ptr<ports::DatagramSocket>(std::make_unique<EndlessSocket>(read));
  }
  std::optional<Address> address_of(const std::string&) override {
    return Address{"127.0.0.1", "127.255.255.255", {}};
  }
  int read = 0;
};

TEST(ArtNetController, GoesOnWhenOthersFloodItsSocketAndReadsOnceAFrame) {
  EndlessNetwork network;
  Controller controller(network, "lo");
  ASSERT_TRUE(controller.open());
  for (int port = 0; port < 100; ++port) controller.hear(ports::TimePoint(1s));
  EXPECT_EQ(network.read, Controller::kMostAtOnce);
  controller.hear(ports::TimePoint(2s));
  EXPECT_EQ(network.read, 2 * Controller::kMostAtOnce);
}

TEST_F(ASender, KeepsWithinTheFourSecondsThatNodesAllowWhenItIsQuiet) {
  settings_.quiet = true;
  settings_.unicast = "127.0.0.1";
  auto sender = port();
  int sent = 0, longest = 0, silent = 0;
  for (int i = 0; i < 1600; ++i) {  // forty seconds, nothing changes
    frame(*sender);
    const int now = heard()[Operation::dmx];
    sent += now;
    silent = now > 0 ? 0 : silent + 1;
    longest = std::max(longest, silent);
  }
  EXPECT_LT(longest * 25, 800);
  EXPECT_LT(sent, 80);
  frame_.levels[0] = 1;
  frame(*sender);
  EXPECT_EQ(heard()[Operation::dmx], 1) << "a change leaves at once";
}

TEST_F(ASender, EndsEachFrameWithOneSyncFromTheLastUniverse) {
  settings_.art_sync = true;
  settings_.together = {1, 2};
  settings_.broadcast = true;
  auto first = port();
  settings_.universe = 2;
  auto last = port();
  for (int i = 0; i < 4; ++i) {
    first->send(frame_, now_);
    frame(*last);
  }
  const auto count = heard();
  EXPECT_EQ(count.at(Operation::dmx), 8);
  EXPECT_EQ(count.at(Operation::sync), 4);
  EXPECT_EQ(count.at(Operation::poll), 1) << "one controller polls for both";
}

/// A wire on which so many nodes with addresses of their own answer the first poll.
class Crowd final : public ports::Network {
 public:
  explicit Crowd(int nodes) : nodes_(nodes) {}
  core::Result<std::unique_ptr<ports::DatagramSocket>> open_datagram(const Options&) override {
    struct Socket final : ports::DatagramSocket {
      explicit Socket(int nodes) : left(nodes) {}
      bool send(const ports::Endpoint&, std::span<const std::uint8_t>) override { return true; }
      std::optional<std::size_t> receive(std::span<std::uint8_t> into,
                                         ports::Endpoint* from) override {
        if (left-- <= 0) return std::nullopt;
        Reply reply;
        reply.ip = {10, 0, 1, static_cast<std::uint8_t>(left)};
        reply.ports = {{3, true, false, false}};
        const auto bytes = reply_packet(reply);
        std::copy(bytes.begin(), bytes.end(), into.begin());
        *from = {dotted(reply.ip), kPort};
        return bytes.size();
      }
      core::Result<core::Done> join(const std::string&) override { return core::Done{}; }
      int left;
    };
    return std::unique_ptr<ports::DatagramSocket>(std::make_unique<Socket>(nodes_));
  }
  std::optional<Address> address_of(const std::string&) override {
    return Address{"10.0.0.1", "10.0.255.255", {}};
  }

 private:
  const int nodes_;
};

TEST(ArtNetController, TellsFortyNodesEachAndMoreThanThatAllAtOnce) {
  for (const auto& [nodes, told] : {std::pair{40, 40u}, std::pair{41, 1u}}) {
    Crowd crowd(nodes);
    Controller controller(crowd, "eth0");
    ASSERT_TRUE(controller.open());
    controller.hear(kStart);
    const auto subscribers = controller.subscribers(3, kStart);
    ASSERT_EQ(subscribers.size(), told);
    EXPECT_EQ(subscribers[0].address == "10.0.255.255", nodes > 40);
  }
}

}  // namespace
}  // namespace chiaro::drivers::artnet
