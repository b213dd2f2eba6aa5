// SPDX-License-Identifier: Apache-2.0
#include "controller/studio/register_map.h"

#include <gtest/gtest.h>

namespace chiaro::studio {
namespace {

const std::filesystem::path kShipped = CHIARO_SOURCE "/config/modbus";

core::Result<RegisterMap> parse(const std::string& channels) {
  return parse_register_map("map: a/b\nmaker: A\ndevice: B\nchannels: " + channels, "a/b",
                            "b.yaml");
}

TEST(RegisterMaps, ThatAreShippedAllLoad) {
  const auto names = register_map_names(kShipped);
  EXPECT_GE(names.size(), 6u);
  for (const auto& name : names) {
    const auto map = load_register_map(name, {}, kShipped);
    ASSERT_TRUE(map) << core::to_string(map.problems());
    EXPECT_FALSE(map->channels.empty() && map->axes.empty()) << name;
  }
}

TEST(RegisterMaps, OfTheNamedDevicesSayWhatTheirMakersSay) {
  const auto waveshare = load_register_map("waveshare/analog-output-8ch", {}, kShipped);
  ASSERT_TRUE(waveshare);
  ASSERT_EQ(waveshare->channels.size(), 8u);
  EXPECT_EQ(waveshare->slots, 16);
  EXPECT_EQ(waveshare->channels[7].address, 7);
  EXPECT_EQ(waveshare->channels[7].slot, 14);
  EXPECT_EQ(waveshare->channels[7].to, 10000);
  const auto wiren = load_register_map("wiren-board/rgbw-dimmer", {}, kShipped);
  ASSERT_TRUE(wiren);
  EXPECT_EQ(wiren->channels[0].name, "green");  // by address; red has the first slot all the same
  EXPECT_EQ(wiren->channels[0].slot, 1);
  EXPECT_EQ(wiren->channels[1].slot, 0);
  const auto intesis = load_register_map("intesis/dali-gateway", {}, kShipped);
  ASSERT_TRUE(intesis);
  EXPECT_EQ(intesis->channels[63].address, 6315);
  EXPECT_NEAR(intesis->gap_s, 0.032, 1e-9);
}

TEST(RegisterMaps, ReadMotorsAfterTheChannels) {
  const auto map = parse_register_map(
      "map: a/b\nmaker: A\ndevice: B\nchannels: [{register: 40, bits: 16}]\naxes:\n"
      "  - {target: {register: 0, words: 2, order: low_first, means: [-500, 500]}, actual: "
      "{register: 10, input: yes}, status: {register: 12, moving: 3, fault: 15}, home: {register: "
      "20, write: 7}, stop: {register: 21}}\n",
      "a/b", "b.yaml");
  ASSERT_TRUE(map) << core::to_string(map.problems());
  EXPECT_EQ(map->slots, 4);
  const RegisterAxis& axis = map->axes.at(0);
  EXPECT_EQ(axis.slot, 2);
  EXPECT_EQ(axis.words, 2);
  EXPECT_TRUE(axis.low_word_first);
  EXPECT_EQ(axis.from, -500);
  EXPECT_EQ(axis.actual, 10);
  EXPECT_TRUE(axis.actual_is_input);
  EXPECT_EQ(axis.moving_bit, 3);
  EXPECT_EQ(axis.homed_bit, -1);
  EXPECT_EQ(axis.fault_bit, 15);
  EXPECT_EQ(axis.home_value, 7);
  EXPECT_EQ(axis.stop, 21);
  EXPECT_EQ(axis.stop_value, 1);
  const auto bad = parse_register_map(
      "map: a/b\nmaker: A\ndevice: B\nchannels: [{register: 1}]\naxes: [{target: {register: 0, "
      "words: 2, means: [5, 5]}}]\n",
      "a/b", "b.yaml");
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.problems().size(), 2u) << core::to_string(bad.problems());
}

TEST(RegisterMaps, ReportEveryMistakeWithItsPlace) {
  const auto map = parse("\n  - {register: 70000}\n  - {regster: 1}\n  - {register: 5, words: 3}");
  ASSERT_FALSE(map);
  EXPECT_GE(map.problems().size(), 3u);
  for (const auto& problem : map.problems()) EXPECT_GT(problem.where.line, 4);
}

TEST(RegisterMaps, RefuseARegisterThatIsUsedTwiceAndADeviceLargerThanAUniverse) {
  EXPECT_FALSE(parse("[{register: 5}, {register: 4, words: 2}]"));
  EXPECT_FALSE(parse("[{register: 0, repeat: 300, bits: 16}]"));
  EXPECT_TRUE(parse("[{register: 0, repeat: 256, bits: 16}]"));
}

TEST(RegisterMaps, NameTheNearestWhenThereIsNone) {
  const auto map = load_register_map("waveshare/analog-output-8h", {}, kShipped);
  ASSERT_FALSE(map);
  EXPECT_NE(map.problems()[0].remedy.find("waveshare/analog-output-8ch"), std::string::npos);
  EXPECT_FALSE(load_register_map("../fixtures/generic/dimmer", {}, kShipped));
}

}  // namespace
}  // namespace chiaro::studio
