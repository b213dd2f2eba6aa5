// SPDX-License-Identifier: Apache-2.0
#include "drivers/common/rdm.h"

#include <gtest/gtest.h>
#include <set>

#include "drivers/common/usbpro_packet.h"
#include "drivers/common/usbpro_rdm.h"
#include "tests/support/stage_for_outputs.h"

namespace chiaro::drivers::rdm {
namespace {

Bytes bytes_of(std::initializer_list<int> numbers) {
  Bytes bytes;
  for (const int number : numbers) bytes.push_back(static_cast<std::uint8_t>(number));
  return bytes;
}

/// A mute; its sum, 0x062b, worked out by hand.
TEST(RdmPacket, IsWhatTheStandardSays) {
  const Message mute{0x123456789abc, 0xcba987654321, 5, 1, Command::discover, false, 2, {}};
  const Bytes expected =
      bytes_of({0xcc, 0x01, 24, 0x12, 0x34, 0x56, 0x78, 0x9a, 0xbc, 0xcb, 0xa9, 0x87, 0x65,
                0x43, 0x21, 5,  1,    0,    0,    0,    0x10, 0,    2,    0,    0x06, 0x2b});
  EXPECT_EQ(packet(mute), expected);
}

TEST(RdmPacket, ReadsBackWhatWasWrittenAndNothingElse) {
  const Message asked{42, 43, 7, 1, Command::set, true, 0x1000, {1, 2, 3}};
  Bytes bytes = packet(asked);
  const auto back = parse(bytes);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->to, 42u);
  EXPECT_EQ(back->from, 43u);
  EXPECT_EQ(back->number, 7);
  EXPECT_TRUE(back->answer);
  EXPECT_EQ(back->command, Command::set);
  EXPECT_EQ(back->parameter, 0x1000);
  EXPECT_EQ(back->data, (Bytes{1, 2, 3}));
  for (std::size_t n = 0; n < bytes.size(); ++n)
    EXPECT_FALSE(parse(std::span(bytes).first(n))) << n;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    Bytes wrong = bytes;
    wrong[i] ^= 0x10;
    EXPECT_FALSE(parse(wrong)) << i;
  }
}

TEST(RdmUid, IsWrittenAsPeopleWriteIt) {
  EXPECT_EQ(to_string(0x454e00000a01), "454e:00000a01");
  EXPECT_EQ(uid_in("454e:00000a01"), std::optional<Uid>(0x454e00000a01));
  for (const char* wrong : {"", "454e", "454e-00000a01", "454e:0000zzzz", "454e:00000a011"})
    EXPECT_FALSE(uid_in(wrong)) << wrong;
}

/// The coded answer to a unique branch.
Bytes branch_answer(Uid uid) {
  Bytes bytes(7, 0xfe);
  bytes.push_back(0xaa);
  unsigned sum = 0;
  const auto both = [&](unsigned value, bool counts) {
    for (const unsigned mask : {0xaau, 0x55u}) {
      bytes.push_back(static_cast<std::uint8_t>(value | mask));
      if (counts) sum += value | mask;
    }
  };
  for (int i = 5; i >= 0; --i) both(static_cast<unsigned>(uid >> (8 * i) & 0xff), true);
  const unsigned total = sum;
  both(total >> 8u & 0xffu, false);
  both(total & 0xffu, false);
  return bytes;
}

/// Lamps on a line: those that are not muted answer a branch together.
struct Lamps : Line {
  std::set<Uid> all, muted;
  std::set<Uid> identified;
  int exchanges = 0, lose = 0;
  bool gone = false;

  std::optional<Bytes> exchange(std::span<const std::uint8_t> bytes, bool discovery) override {
    ++exchanges;
    if (gone) return std::nullopt;
    const auto asked = parse(bytes);
    if (!asked) return Bytes{};
    if (lose > 0 && !discovery && asked->to != kEverybody) return --lose, Bytes{};
    if (asked->parameter == 3) muted.clear();
    if (discovery) return branch(*asked);
    if (!all.contains(asked->to)) return Bytes{};
    if (asked->parameter == 2) muted.insert(asked->to);
    if (asked->parameter == 0x1000)
      asked->data[0] == 1 ? (void)identified.insert(asked->to) : (void)identified.erase(asked->to);
    Message answer{asked->from,    asked->to, asked->number,    0,
                   asked->command, true,      asked->parameter, {}};
    if (asked->parameter == 0x60)
      answer.data = bytes_of({1, 0, 0x12, 0x34, 1, 1, 0, 0, 2, 5, 0, 4, 2, 3, 0, 100, 0, 0, 0});
    if (asked->parameter == 0x82) answer.data = {'K', 'e', 'y', 7};
    if (asked->parameter == 0x81) answer.port = 2;  // a refusal
    return packet(answer);
  }
  Bytes branch(const Message& asked) const {
    Uid least = 0, most = 0;
    for (std::size_t i = 0; i < 6; ++i) {
      least = least << 8u | asked.data[i];
      most = most << 8u | asked.data[6 + i];
    }
    Bytes together;
    for (const Uid uid : all) {
      if (uid < least || uid > most || muted.contains(uid)) continue;
      const Bytes one = branch_answer(uid);
      together.resize(one.size());
      for (std::size_t i = 0; i < one.size(); ++i)
        together[i] = static_cast<std::uint8_t>(together[i] | one[i]);
    }
    return together;
  }
};

TEST(RdmBranchAnswer, IsDecodedWithFewerLeadingBytesToo) {
  Bytes bytes = branch_answer(0x454e12345678);
  EXPECT_EQ(parse_branch_answer(bytes), std::optional<Uid>(0x454e12345678));
  bytes.erase(bytes.begin(), bytes.begin() + 3);
  EXPECT_EQ(parse_branch_answer(bytes), std::optional<Uid>(0x454e12345678));
  bytes[10] ^= 1;
  EXPECT_FALSE(parse_branch_answer(bytes));
  EXPECT_FALSE(parse_branch_answer(Bytes(3, 0xfe)));
}

TEST(RdmDiscovery, FindsEveryLampHoweverCloseTheirNumbersAre) {
  for (const std::set<Uid>& all :
       {std::set<Uid>{},
        {0x454e00000001},
        {1, 2, 3, 4, 5},
        {0, kEverybody - 1},
        {0x454e00000001, 0x454e00000002, 0x4c5500000001, 0x7ff012345678, 0x454e80000000}}) {
    Lamps lamps;
    lamps.all = all;
    Controller controller(lamps, 0x7ff000000001);
    const auto found = controller.discover();
    ASSERT_TRUE(found);
    EXPECT_EQ(*found, std::vector<Uid>(all.begin(), all.end()));
  }
}

TEST(RdmDiscovery, OfSixtyFourLampsTakesFewMessages) {
  Lamps lamps;
  for (Uid i = 0; i < 64; ++i) lamps.all.insert(0x454e00000000 + i * 977);
  Controller controller(lamps, 1);
  EXPECT_EQ(controller.discover()->size(), 64u);
  EXPECT_LT(lamps.exchanges, 700);
}

TEST(RdmDiscovery, EndsWhenTheAdapterIsPulled) {
  Lamps lamps;
  lamps.gone = true;
  Controller controller(lamps, 1);
  EXPECT_FALSE(controller.discover());
}

TEST(RdmController, AsksALampWhoItIsAndLetsItShowItself) {
  Lamps lamps;
  lamps.all = {0x454e00000007};
  lamps.lose = 2;  // messages get lost
  Controller controller(lamps, 1);
  const auto device = controller.ask(0x454e00000007);
  ASSERT_TRUE(device);
  EXPECT_TRUE(device->answered);
  EXPECT_EQ(device->model, 0x1234);
  EXPECT_EQ(device->footprint, 4);
  EXPECT_EQ(device->address, 100);
  EXPECT_EQ(device->mode, 2);
  EXPECT_EQ(device->modes, 3);
  EXPECT_EQ(device->label, "Key");
  EXPECT_EQ(device->maker, "") << "it refuses to say";
  EXPECT_TRUE(controller.identify(0x454e00000007, true));
  EXPECT_EQ(lamps.identified.size(), 1u);
  EXPECT_TRUE(controller.identify(0x454e00000007, false));
  EXPECT_TRUE(lamps.identified.empty());
  EXPECT_FALSE(controller.identify(0x454e00000008, true));
}

/// The dongle between: messages wrapped and unwrapped, a timeout told by label 12.
TEST(UsbProRdm, CarriesQuestionsAndAnswersWhereTheFirmwareHasIt) {
  support::StageForOutputs stage("usbpro");
  Lamps lamps;
  lamps.all = {0x454e00000001, 0x454e00000002};
  int firmware = 2;
  stage.serial()->answer = [&](std::span<const std::uint8_t> asked) {
    const std::span<const std::uint8_t> inside = asked.subspan(4, asked.size() - 5);
    const auto wrap = [](int label, const Bytes& data) {
      return usbpro::message(static_cast<usbpro::Label>(label), data);
    };
    if (asked[1] == 3) return wrap(3, {1, static_cast<std::uint8_t>(firmware), 17, 2, 40});
    const auto answer = lamps.exchange(inside, asked[1] == 11);
    if (answer->empty()) return wrap(12, {});
    Bytes data{0};
    data.insert(data.end(), answer->begin(), answer->end());
    return wrap(5, data);
  };
  {
    auto line = usbpro::open_rdm(stage.settings().device, stage.around());
    ASSERT_TRUE(line) << core::to_string(line.problems());
    Controller controller(**line, 1);
    EXPECT_EQ(controller.discover()->size(), 2u);
    EXPECT_EQ(controller.ask(0x454e00000002)->label, "Key");
  }
  firmware = 1;
  const auto refused = usbpro::open_rdm(stage.settings().device, stage.around());
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.problems()[0].what.find("DMX alone"), std::string::npos);
}

}  // namespace
}  // namespace chiaro::drivers::rdm
