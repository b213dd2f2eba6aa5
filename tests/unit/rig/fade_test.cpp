// SPDX-License-Identifier: Apache-2.0
#include "controller/rig/fade.h"

#include <gtest/gtest.h>

namespace chiaro::rig {
namespace {

using core::Dof;
using namespace std::chrono_literals;

const ports::TimePoint kStart{100s};

TEST(Fade, RunsLightEvenlyInLightness) {
  Fade fade(Dof::intensity, 0);
  fade.start(0, 1, kStart, 2);
  // L* 50 is Y = ((50 + 16) / 116)^3 = 0.184187; L* 25 is ((25 + 16) / 116)^3 = 0.044154.
  EXPECT_NEAR(fade.at(kStart + 1s), 0.184187, 1e-6);
  EXPECT_NEAR(fade.at(kStart + 500ms), 0.044154, 1e-6);
}

TEST(Fade, RunsColourTemperatureEvenlyInMired) {
  Fade fade(Dof::cct, 0);
  fade.start(2500, 5000, kStart, 1);  // 400 to 200 mired
  EXPECT_NEAR(fade.at(kStart + 500ms), 1e6 / 300, 1e-9);
}

TEST(Fade, IsExactAtBothEndsAndNeverTurnsBack) {
  Fade fade(Dof::intensity, 0);
  fade.start(0.123456789, 0.987654321, kStart, 1);
  EXPECT_EQ(fade.at(kStart), 0.123456789);
  EXPECT_EQ(fade.at(kStart + 1s), 0.987654321);
  EXPECT_EQ(fade.at(kStart + 1h), 0.987654321);
  double before = 0;
  for (auto t = 0ms; t <= 1000ms; t += 1ms) {
    const double now = fade.at(kStart + t);
    EXPECT_GE(now, before) << t.count();
    before = now;
  }
}

TEST(Fade, OfNoLengthJumps) {
  Fade fade(Dof::intensity, 0.2);
  fade.start(0.2, 0.7, kStart, 0);
  EXPECT_EQ(fade.at(kStart), 0.7);
}

}  // namespace
}  // namespace chiaro::rig
