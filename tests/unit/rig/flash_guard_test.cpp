// SPDX-License-Identifier: Apache-2.0
#include "controller/rig/flash_guard.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace chiaro::rig {
namespace {

using namespace std::chrono_literals;

/// Counts opposing changes of a flash's depth in what came out, in every second.
std::size_t most_swings_in_a_second(const std::vector<double>& levels, double rate_hz) {
  std::vector<double> turns;
  double extreme = levels.front();
  int direction = 0;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const double move = levels[i] - extreme;
    if (direction != 0 && move * direction >= 0) {
      extreme = levels[i];
    } else if (std::abs(move) >= kFlashDepth) {
      direction = move > 0 ? 1 : -1;
      extreme = levels[i];
      turns.push_back(static_cast<double>(i) / rate_hz);
    }
  }
  std::size_t most = 0;
  for (std::size_t i = 0; i < turns.size(); ++i) {
    std::size_t count = 0;
    for (std::size_t j = i; j < turns.size() && turns[j] - turns[i] < 1 - 1e-9; ++j) ++count;
    most = std::max(most, count);
  }
  return most;
}

std::vector<double> guarded(double flash_hz, double low, double high) {
  FlashGuard guard(low);
  std::vector<double> levels;
  for (int i = 0; i < 400; ++i) {
    const double phase = i / 40.0 * flash_hz;
    const double wanted = phase - std::floor(phase) < 0.5 ? low : high;
    levels.push_back(guard.allow(wanted, ports::TimePoint(i * 25ms)));
  }
  return levels;
}

TEST(FlashGuard, LetsThreeFlashesASecondThrough) {
  const auto levels = guarded(2.5, 0, 1);
  EXPECT_EQ(most_swings_in_a_second(levels, 40), 5u);
  EXPECT_EQ(*std::max_element(levels.begin(), levels.end()), 1.0);
}

TEST(FlashGuard, KeepsAnyFasterFlashingToThreeASecond) {
  for (const double hz : {4.0, 6.0, 10.0, 20.0})
    EXPECT_LE(most_swings_in_a_second(guarded(hz, 0, 1), 40), 6u) << hz;
}

TEST(FlashGuard, LeavesSmallFlickerAndOneWayFadesAlone) {
  const auto small = guarded(20, 0.5, 0.55);
  EXPECT_EQ(small[1], 0.55);
  FlashGuard guard(0);
  for (int i = 0; i <= 40; ++i)
    EXPECT_EQ(guard.allow(i / 40.0, ports::TimePoint(i * 25ms)), i / 40.0);
}

TEST(FlashGuard, FollowsInTheEnd) {
  FlashGuard guard(0);
  for (int i = 0; i < 80; ++i) guard.allow(i % 2, ports::TimePoint(i * 25ms));
  EXPECT_EQ(guard.allow(1, ports::TimePoint(10s)), 1);
}

TEST(FlashGuard, DoesNotJudgeAPersonsOwnHand) {
  FlashGuard guard(0);
  for (int i = 0; i < 80; ++i) guard.follow(i % 2);
  EXPECT_EQ(guard.allow(0.5, ports::TimePoint(1s)), 0.5);
}

}  // namespace
}  // namespace chiaro::rig
