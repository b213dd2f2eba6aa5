// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "drivers/common/sacn_packet.h"
#include "drivers/common/sacn_receiver.h"

namespace chiaro::drivers::sacn {
namespace {

using namespace std::chrono_literals;

const ports::TimePoint kStart{100s};

Packet packet(std::uint8_t source, std::uint8_t sequence, std::uint8_t level,
              std::uint8_t priority = 100, std::uint8_t options = 0) {
  Stream stream;
  stream.cid.fill(source);
  stream.priority = priority;
  stream.universe = 7;
  Packet p = data_packet(stream);
  std::array<std::uint8_t, kSlots> levels;
  levels.fill(level);
  set_frame(p, sequence, options, levels);
  return p;
}

TEST(SacnSequence, FollowsTheSigned8BitRuleAtTheWrapAround) {
  EXPECT_TRUE(in_sequence(255, 0));
  EXPECT_FALSE(in_sequence(5, 250));  // -11: late, though 245 as plain integers
  EXPECT_FALSE(in_sequence(7, 7));
  EXPECT_FALSE(in_sequence(119, 100));  // -19
  EXPECT_TRUE(in_sequence(120, 100));   // -20
  EXPECT_TRUE(in_sequence(0, 127));
}

TEST(SacnParser, ReadsBackWhatWasBuilt) {
  Stream stream;
  stream.cid.fill(0xc5);
  stream.source_name = "Studio 1";
  stream.priority = 150;
  stream.universe = 0x1234;
  const Packet bytes = data_packet(stream);
  const auto read = parse(bytes);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->cid, stream.cid);
  EXPECT_EQ(read->source_name, "Studio 1");
  EXPECT_EQ(read->priority, 150);
  EXPECT_EQ(read->universe, 0x1234);
  EXPECT_EQ(read->levels.size(), 512u);
  EXPECT_FALSE(read->terminated || read->preview || read->force_sync);
}

TEST(SacnParser, RefusesEveryCutAndLengthenedDatagram) {
  const Packet good = packet(1, 1, 9);
  for (std::size_t size = 0; size < good.size(); ++size)
    EXPECT_FALSE(parse(std::span(good).first(size))) << size;
  std::vector<std::uint8_t> longer(good.begin(), good.end());
  longer.push_back(0);
  EXPECT_FALSE(parse(longer));
}

TEST(SacnParser, RefusesEachFieldThatIsWrong) {
  const struct {
    std::size_t where;
    std::uint8_t value;
    Refusal why;
  } kWrong[] = {{at::preamble + 1, 0x11, Refusal::not_acn},
                {at::identifier, 'X', Refusal::not_acn},
                {at::root_length, 0x60, Refusal::wrong_length},
                {at::root_vector + 3, 8, Refusal::other_vector},
                {at::framing_length + 1, 0, Refusal::wrong_length},
                {at::framing_vector + 3, 1, Refusal::other_vector},
                {at::dmp_vector, 3, Refusal::other_vector},
                {at::address_type, 0xa2, Refusal::wrong_property},
                {at::address_step + 1, 2, Refusal::wrong_property},
                {at::value_count + 1, 0, Refusal::wrong_property},
                {at::priority, 201, Refusal::wrong_priority},
                {at::universe, 0xff, Refusal::wrong_universe}};
  for (const auto& wrong : kWrong) {
    Packet bytes = packet(1, 1, 9);
    bytes[wrong.where] = wrong.value;
    Refusal why = Refusal::none;
    EXPECT_FALSE(parse(bytes, &why)) << wrong.where;
    EXPECT_EQ(why, wrong.why) << wrong.where;
  }
}

TEST(SacnReceiver, IgnoresPreviewOtherStartCodesAndOtherUniverses) {
  Receiver receiver({7});
  EXPECT_EQ(receiver.hear(packet(1, 1, 200, 100, kPreview), kStart),
            Receiver::Heard::not_for_lamps);
  Packet other = packet(1, 2, 200);
  other[at::start_code] = 0xdd;
  EXPECT_EQ(receiver.hear(other, kStart), Receiver::Heard::not_for_lamps);
  Packet elsewhere = packet(1, 3, 200);
  put16(elsewhere, at::universe, 8);
  EXPECT_EQ(receiver.hear(elsewhere, kStart), Receiver::Heard::other_universe);
  EXPECT_EQ(receiver.frame(0, kStart).levels[0], 0);
}

TEST(SacnReceiver, HighestPriorityWinsAndEqualOnesMergeHighestTakesPrecedence) {
  Receiver receiver({7});
  receiver.hear(packet(1, 1, 200, 100), kStart);
  receiver.hear(packet(2, 1, 50, 120), kStart);
  EXPECT_EQ(receiver.frame(0, kStart).levels[511], 50);
  receiver.hear(packet(3, 1, 60, 120), kStart);
  EXPECT_EQ(receiver.frame(0, kStart).levels[511], 60);
}

TEST(SacnReceiver, HoldsTheLastLookAfterASourceEnds) {
  Receiver receiver({7});
  receiver.hear(packet(1, 1, 80), kStart);
  receiver.hear(packet(2, 1, 30, 90), kStart);
  EXPECT_EQ(receiver.hear(packet(1, 2, 80, 100, kTerminated), kStart), Receiver::Heard::terminated);
  EXPECT_EQ(receiver.frame(0, kStart).levels[0], 30);
  EXPECT_EQ(receiver.frame(0, kStart + 3s).levels[0], 30);
  EXPECT_TRUE(receiver.sources(0).empty());
}

TEST(SacnReceiver, ForgetsASourceAfterTwoAndAHalfSilentSecondsAndThenTakesAnySequence) {
  Receiver receiver({7});
  receiver.hear(packet(1, 100, 80), kStart);
  EXPECT_EQ(receiver.hear(packet(1, 99, 90), kStart + 1s), Receiver::Heard::out_of_sequence);
  EXPECT_EQ(receiver.hear(packet(1, 99, 90), kStart + 2501ms), Receiver::Heard::levels);
}

}  // namespace
}  // namespace chiaro::drivers::sacn
