// SPDX-License-Identifier: Apache-2.0
// What a person saw of an unknown lamp, as a profile and a studio file that load.
#include "controller/daemon/interview/learnt.h"

#include <fstream>
#include <gtest/gtest.h>

#include "controller/studio/load.h"
#include "tests/support/fake_world.h"
#include "tests/support/studios.h"

namespace chiaro::daemon::interview {
namespace {

LearntLamp lamp(const std::vector<std::string>& seen) {
  LearntLamp lamp;
  lamp.profile = "own/old-panel";
  lamp.model = "Old panel";
  for (const std::string& sees : seen) lamp.slots.push_back({sees, 200});
  return lamp;
}

class LearntProfile : public testing::Test {
 protected:
  core::Result<studio::Profile> load(const LearntLamp& seen) {
    auto yaml = profile_yaml(seen);
    if (!yaml) return yaml.problems();
    std::filesystem::create_directories(folder_.path() / "own");
    std::ofstream(folder_.path() / "own/old-panel.yaml") << *yaml;
    return studio::load_profile("own/old-panel",
                                {std::filesystem::path(CHIARO_SOURCE) / "config", folder_.path()});
  }
  support::TemporaryFolder folder_;
};

TEST_F(LearntProfile, ADimmerWithItsFineHalf) {
  const auto profile = load(lamp({"dimmer", "fine"}));
  ASSERT_TRUE(profile) << core::to_string(profile.problems());
  const auto& mode = profile->modes.at(0);
  EXPECT_EQ(mode.name, kLearntMode);
  EXPECT_EQ(mode.footprint, 2);
  EXPECT_EQ(mode.channels.at(0).bytes, 2);
  EXPECT_EQ(mode.channels.at(0).dof, core::Dof::intensity);
}

TEST_F(LearntProfile, ABicolourPanelWithAnUnusedSlotBetween) {
  const auto profile = load(lamp({"dimmer", "nothing", "cct"}));
  ASSERT_TRUE(profile) << core::to_string(profile.problems());
  EXPECT_EQ(profile->emitter.kind, studio::Emitter::Kind::bicolour);
  EXPECT_EQ(profile->emitter.cct_range, (core::Range{3200, 5600}));
  EXPECT_EQ(profile->modes.at(0).footprint, 3);
}

TEST_F(LearntProfile, AColourWashWhoseSharesAddUp) {
  const auto profile = load(lamp({"red", "green", "blue", "white", "keep"}));
  ASSERT_TRUE(profile) << core::to_string(profile.problems());
  ASSERT_EQ(profile->emitter.primaries.size(), 4u);
  double sum = 0;
  for (const auto& primary : profile->emitter.primaries) sum += primary.share;
  EXPECT_NEAR(sum, 1, 1e-9);
  EXPECT_NEAR(profile->modes.at(0).channels.at(4).constant, 200 / 255.0, 1e-9);
}

TEST_F(LearntProfile, AMovingHeadRestsWhereItRests) {
  const auto profile = load(lamp({"pan", "fine", "tilt", "dimmer"}));
  ASSERT_TRUE(profile) << core::to_string(profile.problems());
  EXPECT_EQ(profile->modes.at(0).footprint, 4);
  EXPECT_EQ(profile->modes.at(0).channels.at(0).constant, 0);
}

TEST_F(LearntProfile, OneWhiteAloneIsADimmer) {
  const auto profile = load(lamp({"white"}));
  ASSERT_TRUE(profile) << core::to_string(profile.problems());
  EXPECT_EQ(profile->modes.at(0).channels.at(0).dof, core::Dof::intensity);
}

TEST_F(LearntProfile, SaysWhatCannotBe) {
  EXPECT_FALSE(profile_yaml(lamp({"fine", "dimmer"})));
  EXPECT_FALSE(profile_yaml(lamp({"nothing", "pan"})));
  EXPECT_FALSE(profile_yaml(lamp({"dimmer", "dimmer"})));
}

TEST(LearntName, BecomesAPath) {
  EXPECT_EQ(profile_name("Old panel, left"), "own/old-panel-left");
  EXPECT_EQ(profile_name("../x"), "own/x");
  EXPECT_EQ(profile_name("Ü"), "own/lamp");
}

TEST(WithFixture, TakesTheIndentationOfTheFileAndKeepsEveryLine) {
  const std::string entry = "  new:\n    role: key\n";
  const auto two = with_fixture("studio: x\nfixtures:\n  a: {}\n", entry);
  ASSERT_TRUE(two);
  EXPECT_EQ(*two, "studio: x\nfixtures:\n  new:\n    role: key\n  a: {}\n");
  const auto four = with_fixture("fixtures:   # mine\n    # first\n    a: {}\n", entry);
  ASSERT_TRUE(four);
  EXPECT_EQ(*four, "fixtures:   # mine\n    new:\n      role: key\n    # first\n    a: {}\n");
  EXPECT_FALSE(with_fixture("fixtures: {a: {}}\n", entry));
}

}  // namespace
}  // namespace chiaro::daemon::interview
