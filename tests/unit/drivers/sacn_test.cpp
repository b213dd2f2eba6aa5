// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <set>

#include "drivers/common/sacn_packet.h"
#include "drivers/common/sacn_receiver.h"
#include "drivers/registry.h"
#include "tests/support/stage_for_outputs.h"

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

/// The same packet with another start code.
Packet priorities(std::uint8_t source, std::uint8_t sequence, std::uint8_t priority) {
  Packet p = packet(source, sequence, priority);
  p[at::start_code] = kAddressPriorities;
  return p;
}
Packet synchronised(std::uint8_t sequence, std::uint8_t level, std::uint8_t options = 0) {
  Packet p = packet(1, sequence, level, 100, options);
  put16(p, at::sync_universe, 9);
  return p;
}
SyncPacket sync(std::uint8_t sequence) {
  Cid cid;
  cid.fill(1);
  SyncPacket p = sync_packet(cid, 9);
  p[sync_at::sequence] = sequence;
  return p;
}

class APriorityReceiver : public testing::Test {
 protected:
  Receiver receiver_{{7}, {.per_address_priority = true, .synchronised = false}};
  int level(ports::Duration at) { return receiver_.frame(0, kStart + at).levels[0]; }
};

TEST_F(APriorityReceiver, WaitsASecondAndAHalfForANewSourcesPriorities) {
  receiver_.hear(packet(1, 1, 80), kStart);
  EXPECT_EQ(level(1s), 0);
  EXPECT_EQ(level(1500ms), 80);
}

TEST_F(APriorityReceiver, TakesASourceAtOnceWhenItsPrioritiesCome) {
  receiver_.hear(packet(1, 1, 80), kStart);
  EXPECT_EQ(receiver_.hear(priorities(1, 2, 120), kStart + 20ms), Receiver::Heard::priorities);
  EXPECT_EQ(level(20ms), 80);
}

TEST_F(APriorityReceiver, LetsTheHighestPriorityOfEachAddressWinAndMergesTies) {
  receiver_.hear(packet(1, 1, 200), kStart);
  Packet mine = priorities(1, 2, 100);
  mine[at::levels + 0] = 0;    // not mine, whatever my level says
  mine[at::levels + 1] = 150;  // above the other
  mine[at::levels + 2] = 90;   // below
  receiver_.hear(mine, kStart);
  receiver_.hear(packet(2, 1, 50, 100), kStart);
  const auto& frame = receiver_.frame(0, kStart + 1600ms);
  EXPECT_EQ(frame.levels[0], 50);
  EXPECT_EQ(frame.levels[1], 200);
  EXPECT_EQ(frame.levels[2], 50);
  EXPECT_EQ(frame.levels[3], 200);  // a tie: the highest level
}

TEST_F(APriorityReceiver, FallsBackToThePacketsPriorityWhenTheyCease) {
  receiver_.hear(packet(1, 1, 200, 50), kStart);
  receiver_.hear(priorities(1, 2, 150), kStart);
  for (std::uint8_t i = 0; i < 40; ++i) {
    const auto at = kStart + i * 100ms;
    receiver_.hear(packet(1, static_cast<std::uint8_t>(3 + i), 200, 50), at);
    receiver_.hear(packet(2, static_cast<std::uint8_t>(1 + i), 10, 100), at);
    if (i == 20) {
      EXPECT_EQ(level(i * 100ms), 200);
    }
  }
  EXPECT_EQ(level(3900ms), 10);
}

TEST(SacnReceiver, StaysSmallWhateverOthersSend) {
  Receiver receiver({1}, {.per_address_priority = false, .synchronised = true});
  const ports::TimePoint now(10s);
  int refused = 0;
  std::set<std::uint16_t> joined;
  for (int i = 0; i < 1000; ++i) {
    Stream stream;
    stream.cid.fill(static_cast<std::uint8_t>(i & 0xff));
    stream.cid[0] = static_cast<std::uint8_t>(i >> 8);
    stream.universe = 1;
    stream.sync_universe = static_cast<std::uint16_t>(100 + i);
    refused += receiver.hear(data_packet(stream), now) == Receiver::Heard::refused;
    while (const auto universe = receiver.sync_to_join()) joined.insert(universe);
  }
  EXPECT_EQ(receiver.sources(0).size(), Receiver::kMostSources);
  EXPECT_EQ(refused, 1000 - static_cast<int>(Receiver::kMostSources));
  EXPECT_EQ(joined.size(), Receiver::kMostJoined);
  receiver.frame(0, now + 10s);  // all of them are gone
  Stream stream;
  stream.universe = 1;
  EXPECT_EQ(receiver.hear(data_packet(stream), now + 10s), Receiver::Heard::levels);
}

TEST(SacnReceiver, TakesPriorityZeroAsAPriority) {
  Receiver receiver({7});
  receiver.hear(packet(1, 1, 80, 0), kStart);
  EXPECT_EQ(receiver.frame(0, kStart).levels[0], 80);
}

class ASynchronisedReceiver : public testing::Test {
 protected:
  Receiver receiver_{{7}, {.per_address_priority = false, .synchronised = true}};
  int level(ports::Duration at) { return receiver_.frame(0, kStart + at).levels[0]; }
};

TEST_F(ASynchronisedReceiver, ShowsLevelsAtOnceUntilAFirstSyncAndThenWaitsForEach) {
  receiver_.hear(synchronised(1, 10), kStart);
  EXPECT_EQ(receiver_.sync_to_join(), 9);
  EXPECT_EQ(receiver_.sync_to_join(), 0);
  EXPECT_EQ(level(0s), 10);
  EXPECT_EQ(receiver_.hear(sync(1), kStart + 25ms), Receiver::Heard::sync);
  receiver_.hear(synchronised(2, 20), kStart + 50ms);
  EXPECT_EQ(level(60ms), 10);
  EXPECT_EQ(receiver_.hear(sync(1), kStart + 70ms), Receiver::Heard::out_of_sequence);
  EXPECT_EQ(level(70ms), 10);
  receiver_.hear(sync(2), kStart + 75ms);
  EXPECT_EQ(level(75ms), 20);
}

TEST_F(ASynchronisedReceiver, GoesOnWithoutWhenSyncCeasesUnlessToldToHold) {
  receiver_.hear(synchronised(1, 10), kStart);
  receiver_.hear(sync(1), kStart);
  receiver_.hear(synchronised(2, 20), kStart + 3s);
  EXPECT_EQ(level(3s), 20);
  receiver_.hear(synchronised(3, 30, kForceSync), kStart + 4s);
  EXPECT_EQ(level(4s), 20);
}

TEST(SacnDiscovery, PagesHold512UniversesEachAndReadBack) {
  Stream stream;
  stream.source_name = "Studio 1";
  std::vector<std::uint16_t> universes;
  for (std::uint16_t u = 1; u <= 600; ++u) universes.push_back(u);
  const auto pages = discovery_pages(stream, universes);
  ASSERT_EQ(pages.size(), 2u);
  const auto first = parse_discovery(pages[0]), second = parse_discovery(pages[1]);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->universes.size(), 512u);
  EXPECT_EQ(second->universes.back(), 600);
  EXPECT_EQ(second->page, 1);
  EXPECT_EQ(second->last_page, 1);
  EXPECT_EQ(first->source_name, "Studio 1");
  EXPECT_EQ(discovery_pages(stream, {}).size(), 1u);
  for (std::size_t size = 0; size < pages[1].size(); ++size)
    EXPECT_FALSE(parse_discovery(std::span(pages[1]).first(size))) << size;
}

/// What the sACN ports of one studio put on the wire together.
class ASource : public testing::Test {
 protected:
  ASource() {
    ear_ = std::move(*stage_.network().open_datagram({"lo", kPort, true, false}));
    for (const std::uint16_t u : std::vector<std::uint16_t>{1, 2, 9, kDiscoveryUniverse})
      EXPECT_TRUE(ear_->join(multicast_group(u)));
    settings_.together = {1, 2};
    settings_.interface = "lo";
  }
  std::unique_ptr<ports::OutputPort> port(std::uint16_t universe) {
    settings_.universe = universe;
    auto port = std::move(*make_output("sacn", settings_, stage_.around()));
    EXPECT_TRUE(port->open());
    return port;
  }
  struct Count {
    int data = 0, sync = 0, pages = 0;
  };
  Count heard() {
    Count count;
    std::array<std::uint8_t, 2048> bytes;
    while (const auto size = ear_->receive(bytes, nullptr)) {
      const auto datagram = std::span(bytes).first(*size);
      count.data += parse(datagram).has_value();
      count.sync += parse_sync(datagram).has_value();
      if (const auto page = parse_discovery(datagram)) {
        ++count.pages;
        EXPECT_EQ(page->universes, (std::vector<std::uint16_t>{1, 2}));
      }
    }
    return count;
  }
  support::StageForOutputs stage_{"mock"};
  OutputSettings settings_;
  std::unique_ptr<ports::DatagramSocket> ear_;
};

TEST_F(ASource, TellsItsUniversesOnceInTenSecondsForAllPorts) {
  auto first = port(1), second = port(2);
  for (auto at = 0ms; at < 21s; at += 25ms) {
    first->send({}, kStart + at);
    second->send({}, kStart + at);
  }
  const Count count = heard();
  EXPECT_EQ(count.pages, 3);
  EXPECT_EQ(count.data, 2 * 21 * 40);
}

TEST_F(ASource, EndsEachFrameWithOneSyncFromTheLastUniverse) {
  settings_.sync = 9;
  auto first = port(1), second = port(2);
  for (int i = 0; i < 3; ++i) {
    first->send({}, kStart);
    second->send({}, kStart);
  }
  EXPECT_EQ(heard().sync, 3);
}

TEST_F(ASource, NeverFallsSilentForTheEightTenthsOfASecondWhenItIsQuiet) {
  settings_.quiet = true;
  auto only = port(1);
  int silent = 0, longest = 0, sent = 0;
  for (int i = 0; i < 800; ++i) {
    only->send({}, kStart + i * 25ms);
    const int now = heard().data;
    sent += now;
    silent = now > 0 ? 0 : silent + 1;
    longest = std::max(longest, silent);
  }
  EXPECT_LT(longest * 25, 800);
  EXPECT_LT(sent, 60);
}

}  // namespace
}  // namespace chiaro::drivers::sacn
