// SPDX-License-Identifier: Apache-2.0
// Goals by hand on the analytic twin: paint is followed, bounds hold, highlights go where they are
// wanted, impressions come out as described, what is impossible is said.
#include "controller/design/by_hand.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numeric>

#include "controller/design/asked_levels.h"
#include "tests/support/analytic_layers.h"
#include "tests/support/rigs.h"

namespace chiaro::design {
namespace {

constexpr core::Size kSize{64, 64};

class ByHand : public testing::Test {
 protected:
  ByHand() : studio_(support::analytic_studio()) {
    studio_.fixtures = {support::stand_lamp("key", studio::Role::key,
                                            {core::radians(-45), core::radians(20), 1.8}, 6000),
                        support::stand_lamp("fill", studio::Role::fill,
                                            {core::radians(45), core::radians(10), 2.0}, 6000),
                        support::fixed_lamp("wall", studio::Role::background, {0, 0.9, 0.2}, 500)};
    twin_ = std::make_unique<support::AnalyticSource>(studio_);
  }

  studio::Rig lit(double key, double fill, double wall) const {
    studio::Rig rig = studio::placed_rig(studio_);
    const double levels[] = {key, fill, wall};
    for (std::size_t i = 0; i < 3; ++i) rig.states[i].set(core::Dof::intensity, levels[i]);
    return rig;
  }

  core::Result<Look> solved(const std::string& json, const studio::Rig& from,
                            std::optional<Goal> like = std::nullopt) const {
    const auto hand = goal_from_json(json, "goal.json", studio_, std::filesystem::path("."));
    if (!hand) return hand.problems();
    Options options;
    options.search_size = options.polish_size = options.full_size = kSize;
    options.trials = 120;
    options.threads = 1;
    return design_by_hand(studio_, *twin_, *hand, like, from, options);
  }

  static double level(const Look& look, std::size_t fixture) {
    return look.wanted.states[fixture].get(core::Dof::intensity);
  }
  static double component(const Look& look, const std::string& name) {
    for (const Component& each : look.components)
      if (each.name == name) return each.value;
    ADD_FAILURE() << "no component " << name;
    return 0;
  }

  studio::Studio studio_;
  std::unique_ptr<support::AnalyticSource> twin_;
};

// Schoeneman and others 1993.
TEST_F(ByHand, PaintingAllOfThePictureAStopLighterDoublesEveryLevel) {
  const auto look =
      solved(R"({"paint": [{"region": "everything", "stops": 1}]})", lit(0.3, 0.1, 0.2));
  ASSERT_TRUE(look) << core::to_string(look.problems());
  EXPECT_NEAR(level(*look, 0), 0.6, 0.01);
  EXPECT_NEAR(level(*look, 1), 0.2, 0.01);
  EXPECT_NEAR(level(*look, 2), 0.4, 0.02);
  EXPECT_EQ(look->judgement.verdict, Verdict::reached);
  EXPECT_LT(look->judgement.residual, 0.05);
}

TEST_F(ByHand, PaintOnOneSideIsFollowedByTheLampOfThatSideAndNoStandMoves) {
  const studio::Rig from = lit(0.3, 0.3, 0.2);
  const auto look = solved(
      R"({"paint": [{"region": {"rectangle": [0.36, 0.3, 0.1, 0.4]}, "stops": 0.8}], "hold": 0.5})",
      from);
  ASSERT_TRUE(look) << core::to_string(look.problems());
  EXPECT_GT(level(*look, 0), 0.36);  // the key stands on the picture's left
  EXPECT_GT(level(*look, 0) / level(*look, 1), 1.3);
  EXPECT_EQ(look->wanted.states[0].get(core::Dof::azimuth), from.states[0].get(core::Dof::azimuth));
  EXPECT_GT(component(*look, "lightness of a rectangle"), 0);
}

TEST_F(ByHand, PaintOnAMoodGoesOnWhatTheLampsMakeOfIt) {
  const auto picture = support::photographed(studio_, *twin_, lit(0.5, 0.2, 0.3), kSize);
  const auto plain = solved(R"({"paint": [{"region": "everything", "stops": -1}]})", lit(0, 0, 0),
                            Goal(support::like(picture)));
  ASSERT_TRUE(plain) << core::to_string(plain.problems());
  EXPECT_NEAR(core::luminance(plain->picture).at(32, 32), core::luminance(picture).at(32, 32) / 2,
              0.03);
}

TEST_F(ByHand, PaintOnBlackOrOutsideOfTheSquareIsRefusedWithARemedy) {
  const auto black = solved(R"({"paint": [{"region": "everything", "stops": 1}]})", lit(0, 0, 0));
  ASSERT_FALSE(black);
  EXPECT_NE(core::to_string(black.problems()).find("design a look first"), std::string::npos);
  const auto outside = solved(
      R"({"paint": [{"region": {"rectangle": [0, 0, 0.05, 1]}, "stops": 1}]})", lit(1, 1, 1));
  ASSERT_FALSE(outside);
  EXPECT_NE(core::to_string(outside.problems()).find("middle square"), std::string::npos);
}

// Poulin and Fournier 1992.
TEST_F(ByHand, AHighlightIsWhereItIsWished) {
  const auto look = solved(
      R"({"like": "placed", "hold": 0, "move": true, "wishes": [{"highlight": [0.45, 0.42]}]})",
      lit(0.5, 0.2, 0.2));
  ASSERT_TRUE(look) << core::to_string(look.problems());
  EXPECT_LT(component(*look, "highlight at 0.45, 0.42"), 2);  // degrees from the mirror direction
}

TEST_F(ByHand, BoundsHoldWhateverTheGoalWants) {
  const auto picture = support::photographed(studio_, *twin_, lit(0.9, 0.6, 0.8), kSize);
  const auto look =
      solved(R"({"bounds": {"power": {"at_most": 0.2}, "levels": {"fill": {"at_least": 0.1}}}})",
             lit(0, 0, 0), Goal(support::like(picture)));
  ASSERT_TRUE(look) << core::to_string(look.problems());
  EXPECT_LE(component(*look, "at most 20 % power"), 0.2001);
  EXPECT_GE(level(*look, 1), 0.0999);
  EXPECT_GT(level(*look, 0) + level(*look, 1), 0.15) << "what is allowed is used";
}

TEST_F(ByHand, EnoughLuxOnTheFaceIsKeptAndWhatCannotBeKeptIsSaid) {
  const auto picture = support::photographed(studio_, *twin_, lit(0.1, 0.05, 0.1), kSize);
  const auto look = solved(R"({"bounds": {"lux_on_face": {"at_least": 900}}})", lit(0, 0, 0),
                           Goal(support::like(picture)));
  ASSERT_TRUE(look) << core::to_string(look.problems());
  EXPECT_GE(component(*look, "at least 900 lx on the face"), 899);
  const auto never = solved(R"({"bounds": {"lux_on_face": {"at_least": 50000}}})", lit(0, 0, 0),
                            Goal(support::like(picture)));
  ASSERT_TRUE(never);
  ASSERT_FALSE(never->warnings.empty());
  EXPECT_NE(never->warnings[0].find("at least 50000 lx on the face cannot be kept: it is "),
            std::string::npos)
      << never->warnings[0];
  EXPECT_EQ(never->judgement.verdict, Verdict::not_reachable);
}

TEST_F(ByHand, ImpressionsComeOutAsTheyAreDescribed) {
  double subject[2], background[2];
  const char* names[] = {"private", "clear"};
  for (int i = 0; i < 2; ++i) {
    const auto look =
        solved(std::string(R"({"impressions": {")") + names[i] + R"(": 1}})", lit(0, 0, 0));
    ASSERT_TRUE(look) << core::to_string(look.problems());
    subject[i] = component(*look, "lightness of the subject");
    background[i] = component(*look, "lightness of the background");
  }
  EXPECT_NEAR(subject[0], 28, 6);
  EXPECT_GT(background[0], subject[0]) << "private: brighter away from people";
  EXPECT_NEAR(subject[1], 68, 8);
  EXPECT_GT(background[1], background[0]);
}

TEST(Bounds, LevelsMoveAsLittleAsNeedBe) {
  Columns columns;
  columns.bounds = {{0, 1}, {0, 1}, {0, 0.1}};
  LinearBound bound;
  bound.per_level = {1, 1, 1};
  bound.least = 1;
  bound.most = std::numeric_limits<double>::infinity();
  columns.linear = {bound};
  std::vector<double> levels{0.2, 0.4, 0.1};
  EXPECT_EQ(lay_on_bounds(columns, levels), 0);
  EXPECT_NEAR(std::accumulate(levels.begin(), levels.end(), 0.0), 1, 1e-6);
  EXPECT_NEAR(levels[0] - 0.2, levels[1] - 0.4, 1e-6);
  EXPECT_EQ(levels[2], 0.1);
  columns.linear[0].least = 9;
  EXPECT_NEAR(lay_on_bounds(columns, levels), (9 - 2.1) / 9, 1e-6);
}

TEST(Shadows, AreSharedByTheLightThatLampsThrow) {
  ShadowShare share;
  share.light = {300, 100};
  share.hidden = {150, 0};
  EXPECT_DOUBLE_EQ(share.share(std::vector<double>{1, 0}), 0.5);
  EXPECT_DOUBLE_EQ(share.share(std::vector<double>{1, 3}), 0.25);
  EXPECT_DOUBLE_EQ(share.share(std::vector<double>{0, 0}), 1) << "no light: all is shadow";
}

}  // namespace
}  // namespace chiaro::design
