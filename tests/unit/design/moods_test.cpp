// SPDX-License-Identifier: Apache-2.0
#include "controller/design/moods.h"

#include <fstream>
#include <gtest/gtest.h>

#include "controller/core/picture_file.h"

namespace chiaro::design {
namespace {

class MoodFolder : public testing::Test {
 protected:
  MoodFolder()
      : folder_(std::filesystem::path(testing::TempDir()) /
                testing::UnitTest::GetInstance()->current_test_info()->name()) {
    std::filesystem::remove_all(folder_);
  }
  ~MoodFolder() override { std::filesystem::remove_all(folder_); }
  void add(const std::string& name, const std::string& yaml, bool picture = true) {
    std::filesystem::create_directories(folder_ / name);
    std::ofstream(folder_ / name / "mood.yaml") << yaml;
    if (!picture) return;
    ASSERT_TRUE(core::write_png(folder_ / name / "picture.png",
                                core::EncodedPicture(core::Size{4, 4}, {9, 9, 9})));
  }
  const std::filesystem::path folder_;
};

TEST_F(MoodFolder, LoadsInNameOrderWithEverything) {
  add("split", "title: Split\n");
  add("low-key",
      "title: Low key\nsentence: Out of the dark.\ntags: {pattern: short, tone: low key}\n"
      "words: [dark, quiet]\nattainable: false\nsitter_turn: -35 deg\nwhite_balance: 3200 K\n"
      "exposure: -1.25 stops\n"
      "targets: {mean: 40.5, edge: 0.7}\n");
  const Moods moods = load_moods(folder_);
  EXPECT_TRUE(moods.problems.empty()) << core::to_string(moods.problems);
  ASSERT_EQ(moods.moods.size(), 2u);
  const Mood& low = moods.moods[0];
  EXPECT_EQ(low.name, "low-key");
  EXPECT_EQ(low.title, "Low key");
  EXPECT_EQ(low.sentence, "Out of the dark.");
  EXPECT_EQ(low.tags.words(), (std::vector<std::string>{"short", "low key"}));
  EXPECT_EQ(low.words, (std::vector<std::string>{"dark", "quiet"}));
  EXPECT_NEAR(low.sitter_turn, core::radians(-35), 1e-12);
  EXPECT_EQ(low.white_balance->value, 3200);
  EXPECT_EQ(low.exposure_stops, -1.25);
  EXPECT_FALSE(low.attainable);
  ASSERT_TRUE(low.targets.has_value());
  EXPECT_EQ(low.targets->mean, 40.5);
  EXPECT_FALSE(low.targets->histogram.has_value());
  EXPECT_TRUE(moods.moods[1].attainable);
}

TEST_F(MoodFolder, ABrokenMoodIsAProblemWithItsPlaceAndTheOthersLoad) {
  add("bad", "title: Bad\nsentense: oops\ntags: {a: b}\n");
  add("blind", "title: Blind\n", false);
  add("good", "title: Good\n");
  add("torn", "title: [\n");
  add("short", "targets: {histogram: [1, 2]}\n");
  const Moods moods = load_moods(folder_);
  ASSERT_EQ(moods.moods.size(), 1u);
  EXPECT_EQ(moods.moods[0].name, "good");
  ASSERT_EQ(moods.problems.size(), 5u) << core::to_string(moods.problems);
  EXPECT_EQ(moods.problems[0].where.line, 2);
  EXPECT_EQ(moods.problems[0].remedy, "did you mean \"sentence\"?");
  EXPECT_EQ(moods.problems[1].where.line, 3);
}

TEST_F(MoodFolder, TagsAndQuantitiesAreChecked) {
  add("a", "tags: {pattern: rembrant}\n");
  add("b", "tags: [loop, warm]\n");
  add("c", "tags: {patern: loop}\n");
  add("d", "sitter_turn: 35\n");
  add("e", "white_balance: 3200 lx\n");
  add("f", "exposure: 50 stops\n");
  const Moods moods = load_moods(folder_);
  EXPECT_TRUE(moods.moods.empty());
  ASSERT_EQ(moods.problems.size(), 6u) << core::to_string(moods.problems);
  EXPECT_EQ(moods.problems[0].remedy, "did you mean \"rembrandt\"?");
  EXPECT_EQ(moods.problems[0].where.column, 17);
  EXPECT_EQ(moods.problems[2].remedy, "did you mean \"pattern\"?");
  EXPECT_NE(moods.problems[3].what.find("a number in deg"), std::string::npos);
}

TEST(TurnInWords, SaysTheSideAndNothingWhenTheSitterFacesTheCamera) {
  EXPECT_EQ(turn_in_words(core::radians(-35)), "35° to camera left");
  EXPECT_EQ(turn_in_words(core::radians(20)), "20° to camera right");
  EXPECT_EQ(turn_in_words(0.001), "");
}

TEST_F(MoodFolder, GivesAGoalWithItsPictureAndTargets) {
  add("low-key", "targets: {mean: 40.5, edge: 0.7}\n");
  const auto goal = goal_of(load_moods(folder_).moods.at(0), Objective::perceptual);
  ASSERT_TRUE(goal.ok());
  EXPECT_EQ(goal->name, "low-key");
  EXPECT_EQ(goal->objective, Objective::perceptual);
  EXPECT_EQ(goal->exemplar.size(), (core::Size{4, 4}));
  EXPECT_EQ(goal->targets3d->edge, 0.7);
}

TEST_F(MoodFolder, TargetsComeFromAMoodOrAlone) {
  add("a", "title: A\ntargets: {mean: 40.5}\n");
  add("b", "mean: 41.5\n");
  add("c", "title: none\n");
  EXPECT_EQ(load_targets(folder_ / "a" / "mood.yaml")->mean, 40.5);
  EXPECT_EQ(load_targets(folder_ / "b" / "mood.yaml")->mean, 41.5);
  EXPECT_FALSE(load_targets(folder_ / "c" / "mood.yaml").ok());
  EXPECT_FALSE(load_targets(folder_ / "d" / "mood.yaml").ok());
}

TEST_F(MoodFolder, NoFolderMeansNoMoods) { EXPECT_TRUE(load_moods(folder_).moods.empty()); }

}  // namespace
}  // namespace chiaro::design
