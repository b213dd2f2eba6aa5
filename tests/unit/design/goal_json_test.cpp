// SPDX-License-Identifier: Apache-2.0
// A goal by hand as it is written: what is understood, and every problem with place and remedy.
#include "controller/design/goal_json.h"

#include <fstream>
#include <gtest/gtest.h>

#include "tests/support/analytic_layers.h"
#include "tests/support/studio_text.h"

namespace chiaro::design {
namespace {

studio::Studio studio_with_key() {
  studio::Studio studio = support::analytic_studio();
  studio.fixtures = {support::fixed_lamp("key", studio::Role::key, {-1, -1, 2}, 6000)};
  return studio;
}

core::Result<GoalByHand> read(const std::string& text) {
  return goal_from_json(text, "goal.json", studio_with_key(), std::filesystem::path("."));
}
std::string problems(const std::string& text) { return core::to_string(read(text).problems()); }

TEST(GoalJson, ReadsEverythingThatCanBeAsked) {
  const auto goal = read(R"({
    "like": {"mood": "rembrandt"}, "objective": "perceptual",
    "paint": [{"region": {"rectangle": [0.4, 0.2, 0.2, 0.1]}, "stops": 0.5, "mired": -20}],
    "hold": 0.5, "move": true,
    "wishes": [{"no_shadow": "face"}, {"highlight": [0.5, 0.4], "lamp": "key", "weight": 2},
               {"lightness": 60, "region": {"polygon": [[0.1, 0.1], [0.9, 0.1], [0.5, 0.9]]}}],
    "impressions": {"relaxed": 1},
    "bounds": {"lux_on_face": {"at_least": 500, "at_most": 900}, "power": {"at_most": 0.3},
               "levels": {"key": {"at_most": 0.8}}}})");
  ASSERT_TRUE(goal) << core::to_string(goal.problems());
  EXPECT_EQ(goal->like, GoalByHand::Like::mood);
  EXPECT_EQ(goal->name, "rembrandt");
  EXPECT_EQ(goal->objective, Objective::perceptual);
  ASSERT_EQ(goal->strokes.size(), 1u);
  EXPECT_DOUBLE_EQ(goal->strokes[0].region.x, 0.5);  // a rectangle's corner becomes its centre
  EXPECT_DOUBLE_EQ(goal->strokes[0].region.y, 0.25);
  EXPECT_EQ(goal->strokes[0].mired, -20);
  EXPECT_EQ(goal->hold, 0.5);
  ASSERT_EQ(goal->wishes->wishes.size(), 3u + 4u);  // an impression is four wishes
  EXPECT_EQ(goal->wishes->wishes[1].kind, Wish::Kind::highlight);
  EXPECT_EQ(goal->wishes->wishes[1].lamp, "key");
  EXPECT_EQ(goal->wishes->wishes[1].weight, 2);
  EXPECT_EQ(goal->wishes->bounds.size(), 4u);
  EXPECT_GT(goal->wishes->warmth_mired, 0);
}

TEST(GoalJson, EveryProblemIsSaidAtOnceWithItsPlaceAndRemedy) {
  const std::string all = problems(R"({
  "like": {"mod": "rembrandt"},
  "paint": [{"region": {"elipse": [0.5, 0.5, 0.1, 0.1]}, "stops": "1"}],
  "wishes": [{"highlight": [1.5, 0.3], "lamp": "kye"}],
  "impressions": {"relaxing": 1},
  "bounds": {"lux_on_face": {"at_least": 900, "at_most": 500}, "power": {"at_most": 30}},
  "mve": true
})");
  for (const char* each :
       {"goal.json:2:12: 'mod'", "did you mean 'mood'?", "goal.json:3:25: 'elipse'",
        "did you mean 'ellipse'?", "'stops' is '1', expected a number",
        "goal.json:4:29: ", "did you mean 'key'?", "relaxing", "at least 900 and at most 500",
        "'at_most' is '30'", "did you mean 'move'?"})
    EXPECT_NE(all.find(each), std::string::npos) << each << " is not in\n" << all;
}

TEST(GoalJson, WhatAsksForNothingOrIsNoJsonIsRefused) {
  EXPECT_NE(problems("{}").find("asks for nothing"), std::string::npos);
  EXPECT_NE(problems(R"({"paint": [{"region": "face"}]})").find("changes nothing"),
            std::string::npos);
  EXPECT_NE(problems(R"({"wishes": [{"weight": 1}]})").find("a wish is one of"), std::string::npos);
  EXPECT_FALSE(read("{\"like\": "));
  EXPECT_FALSE(read("[]"));
  EXPECT_FALSE(read(""));
}

TEST(GoalJson, OverTheNetworkNoFileOfThisMachineIsNamed) {
  const auto goal = goal_from_json(
      R"({"like": {"exemplar": "/etc/passwd"}, "wishes": [{"no_shadow": {"mask": "m.png"}}]})",
      "goal", studio_with_key(), std::nullopt);
  ASSERT_FALSE(goal);
  EXPECT_EQ(goal.problems().size(), 2u) << core::to_string(goal.problems());
  EXPECT_NE(goal.problems()[0].what.find("cannot name files"), std::string::npos);
  EXPECT_TRUE(goal_from_json(R"({"like": "live", "impressions": {"clear": 1}})", "goal",
                             studio_with_key(), std::nullopt));
}

TEST(GoalJson, ShippedGoalsAreValid) {
  const auto loaded = studio::load_studio(support::shipped_folders().studios() / "portrait.yaml",
                                          support::shipped_folders());
  ASSERT_TRUE(loaded);
  int count = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(support::shipped_folders().config / "goals")) {
    if (entry.path().extension() != ".json") continue;
    ++count;
    std::ifstream in(entry.path());
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    const auto goal =
        goal_from_json(text, entry.path().string(), loaded->studio, entry.path().parent_path());
    EXPECT_TRUE(goal) << core::to_string(goal.problems());
  }
  EXPECT_GE(count, 3);
}

TEST(Regions, AreInTheWholeFrameOfWhichDesignsSeeTheMiddleSquare) {
  const studio::Studio studio = studio_with_key();
  Region left;
  left.kind = Region::Kind::rectangle;
  left.x = 0.25;
  left.width = 0.5;  // the left half of the frame is the left half of its middle square
  const core::Plane mask = mask_of(left, studio, nullptr, {8, 8});
  EXPECT_EQ(mask.at(0, 4), 1);
  EXPECT_EQ(mask.at(3, 4), 1);
  EXPECT_EQ(mask.at(4, 4), 0);
  const auto [x, y] = in_square(studio.main_camera(), 0, 0.5);
  EXPECT_LT(x, 0) << "the frame's edge is outside of the square of a wide picture";
  EXPECT_EQ(y, 0.5);
}

TEST(Regions, PolygonsKeepToTheirCorners) {
  Region triangle;
  triangle.kind = Region::Kind::polygon;
  triangle.points = {{0.3, 0.1}, {0.7, 0.1}, {0.5, 0.9}};
  const core::Plane mask = mask_of(triangle, studio_with_key(), nullptr, {32, 32});
  EXPECT_EQ(mask.at(16, 8), 1);
  EXPECT_EQ(mask.at(16, 30), 0);
  EXPECT_EQ(mask.at(3, 8), 0);
  EXPECT_GT(mask.at(16, 8), 0);
}

}  // namespace
}  // namespace chiaro::design
