// SPDX-License-Identifier: Apache-2.0
#include "controller/rig/cue_stack.h"

#include <gtest/gtest.h>

namespace chiaro::rig {
namespace {

using core::Dof;
using namespace std::chrono_literals;

const ports::TimePoint kStart{100s};

Cue cue(double number, double level, std::optional<double> follow = std::nullopt) {
  Cue cue;
  cue.number = number;
  cue.follow_s = follow;
  cue.state.fixtures.resize(1);
  cue.state.fixtures[0].set(Dof::intensity, level);
  cue.state.fixtures[0].set(Dof::pan, number);
  return cue;
}

std::unique_ptr<CueList> list_of(std::vector<Cue> cues) {
  auto list = std::make_unique<CueList>();
  for (Cue& each : cues) list->put(std::move(each));
  list->look_ahead();
  return list;
}

class CueStackTest : public testing::Test {
 protected:
  void take(std::vector<Cue> cues) {
    auto list = list_of(std::move(cues));
    stack_.take(list);
  }
  CueStack stack_;
};

TEST_F(CueStackTest, KeepsCuesInTheOrderOfTheirNumbersAndReplacesByNumber) {
  const auto list = list_of({cue(3, 0.3), cue(1, 0.1), cue(2.5, 0.2), cue(1, 0.9)});
  ASSERT_EQ(list->cues.size(), 3u);
  EXPECT_EQ(list->cues[0].state.fixtures[0].get(Dof::intensity), 0.9);
  EXPECT_EQ(list->cues[1].number, 2.5);
  EXPECT_TRUE(list->remove(2.5));
  EXPECT_FALSE(list->remove(2.5));
}

TEST_F(CueStackTest, GoesForwardAndBackAndStopsAtBothEnds) {
  take({cue(1, 0.1), cue(2, 0.2), cue(3, 0.3)});
  EXPECT_EQ(stack_.back(kStart), nullptr);
  EXPECT_EQ(stack_.go(kStart)->number, 1);
  EXPECT_EQ(stack_.back(kStart), nullptr);
  EXPECT_EQ(stack_.go(kStart)->number, 2);
  EXPECT_EQ(stack_.go(kStart)->number, 3);
  EXPECT_EQ(stack_.go(kStart), nullptr);
  EXPECT_EQ(stack_.state(kStart).playing, 2);
  EXPECT_EQ(stack_.back(kStart)->number, 2);
  EXPECT_EQ(stack_.to(1, kStart)->number, 1);
  EXPECT_EQ(stack_.to(1.5, kStart), nullptr);
  stack_.off();
  EXPECT_EQ(stack_.go(kStart)->number, 1);
}

TEST_F(CueStackTest, FollowsByTheClockUnlessAPersonWentBack) {
  take({cue(1, 0.1, 2), cue(2, 0.2, 3), cue(3, 0.3)});
  stack_.go(kStart);
  EXPECT_EQ(stack_.due(kStart + 1900ms), nullptr);
  EXPECT_NEAR(stack_.state(kStart + 1500ms).follow_s, 0.5, 1e-9);
  EXPECT_EQ(stack_.due(kStart + 2s)->number, 2);
  EXPECT_EQ(stack_.due(kStart + 4s), nullptr);
  EXPECT_EQ(stack_.due(kStart + 5s)->number, 3);
  EXPECT_EQ(stack_.state(kStart + 5s).follow_s, -1);
  EXPECT_EQ(stack_.due(kStart + 60s), nullptr);
  stack_.back(kStart + 60s);
  EXPECT_EQ(stack_.due(kStart + 600s), nullptr);
}

TEST_F(CueStackTest, KeepsItsPlaceByNumberWhenTheListChanges) {
  take({cue(1, 0.1), cue(3, 0.3, 5)});
  stack_.to(3, kStart);
  take({cue(1, 0.1), cue(2, 0.2), cue(3, 0.3, 5), cue(4, 0.4)});
  EXPECT_EQ(stack_.state(kStart).playing, 2);
  EXPECT_EQ(stack_.due(kStart + 5s)->number, 4);
  take({cue(1, 0.1)});
  EXPECT_EQ(stack_.state(kStart).playing, -1);
}

TEST_F(CueStackTest, SetsDarkLampsAheadToWhereTheNextCueLightsThem) {
  const auto list = list_of({cue(1, 0), cue(2, 0.5), cue(3, 0.6)});
  EXPECT_EQ(list->cues[0].state.fixtures[0].get(Dof::pan), 1);
  EXPECT_EQ(list->cues[0].ahead.fixtures[0].get(Dof::pan), 2);
  EXPECT_EQ(list->cues[0].ahead.fixtures[0].get(Dof::intensity), 0);
  EXPECT_EQ(list->cues[1].ahead.fixtures[0].get(Dof::pan), 2);  // lit: stays
}

}  // namespace
}  // namespace chiaro::rig
