// SPDX-License-Identifier: Apache-2.0
#include "simulator/virtual_studio/stagehand.h"

#include <gtest/gtest.h>

#include "controller/core/units.h"

namespace chiaro::simulator {
namespace {

using namespace std::chrono_literals;
using core::Dof;

ports::TimePoint at(ports::Duration since) { return ports::TimePoint(since); }

Task task(const std::string& fixture, double metres) {
  Task result{fixture, {}};
  result.to.set(Dof::distance, metres);
  return result;
}

TEST(StagehandTasks, AreReadFromTheDaemonsState) {
  const auto tasks = tasks_in(R"({"version": 3, "instructions": [
    {"fixture": "key", "words": "move key", "to":
     {"azimuth_deg": -47, "elevation_deg": 38, "distance_m": 1.6, "intensity": 1, "colour": "x"}}]})");
  ASSERT_TRUE(tasks);
  ASSERT_EQ(tasks->size(), 1u);
  EXPECT_EQ(tasks->front().fixture, "key");
  EXPECT_NEAR(tasks->front().to.get(Dof::azimuth), core::radians(-47), 1e-12);
  EXPECT_EQ(tasks->front().to.get(Dof::distance), 1.6);
  EXPECT_FALSE(tasks->front().to.has(Dof::intensity));
}

TEST(StagehandTasks, KnowWhereTheStandsWereLeft) {
  const auto places = places_in(R"({"fixtures": [
    {"name": "key", "placed": {"distance_m": 1.6}}, {"name": 3}, {"name": "wall", "placed": {}}]})");
  ASSERT_TRUE(places);
  ASSERT_EQ(places->size(), 2u);
  EXPECT_EQ(places->front(), task("key", 1.6));
  EXPECT_EQ(places->back().to, core::FixtureState());
}

TEST(StagehandTasks, NonsenseIsAProblem) {
  for (const auto* text : {"", "[]", "{", "{}", R"({"instructions": 3})"}) {
    EXPECT_FALSE(tasks_in(text)) << text;
    EXPECT_FALSE(places_in(text)) << text;
  }
}

TEST(StagehandTasks, GoBackInTheSameUnits) {
  const auto text = placed_json(task("key", 1.6).to);
  EXPECT_EQ(text, R"({"distance_m":1.6})");
}

TEST(Stagehand, TakesItsTimeForEachStand) {
  Stagehand hand(2s);
  EXPECT_FALSE(hand.work({task("key", 1), task("fill", 2)}, at(10s)));
  EXPECT_FALSE(hand.work({task("key", 1), task("fill", 2)}, at(11900ms)));
  EXPECT_EQ(hand.work({task("key", 1), task("fill", 2)}, at(12s)), task("key", 1));
  EXPECT_FALSE(hand.work({task("fill", 2)}, at(12s)));
  EXPECT_EQ(hand.work({task("fill", 2)}, at(14s)), task("fill", 2));
  EXPECT_FALSE(hand.work({}, at(20s)));
}

TEST(Stagehand, StartsAfreshWhenToldOtherwise) {
  Stagehand hand(2s);
  EXPECT_FALSE(hand.work({task("key", 1)}, at(0s)));
  EXPECT_FALSE(hand.work({task("key", 1.5)}, at(1s)));
  EXPECT_FALSE(hand.work({task("key", 1.5)}, at(2500ms)));
  EXPECT_EQ(hand.work({task("key", 1.5)}, at(3s)), task("key", 1.5));
}

TEST(Stagehand, DoesItAgainWhenTheDaemonDidNotHear) {
  Stagehand hand(1s);
  EXPECT_FALSE(hand.work({task("key", 1)}, at(0s)));
  EXPECT_TRUE(hand.work({task("key", 1)}, at(1s)));
  EXPECT_FALSE(hand.work({task("key", 1)}, at(1100ms)));
  EXPECT_TRUE(hand.work({task("key", 1)}, at(2100ms)));
}

}  // namespace
}  // namespace chiaro::simulator
