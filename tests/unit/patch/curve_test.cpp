// SPDX-License-Identifier: Apache-2.0
#include "controller/patch/curve.h"

#include <gtest/gtest.h>

namespace chiaro::patch {
namespace {

using studio::DimmerCurve;
using Law = DimmerCurve::Law;

DimmerCurve curve(Law law, double gamma = 2.2, std::vector<double> table = {}) {
  return {law, gamma, std::move(table)};
}

TEST(DimmerCurve, GivesTheLightOfEachLaw) {
  EXPECT_DOUBLE_EQ(light_of_drive(curve(Law::linear), 0.3), 0.3);
  EXPECT_DOUBLE_EQ(light_of_drive(curve(Law::square), 0.3), 0.09);
  EXPECT_NEAR(light_of_drive(curve(Law::gamma), 0.5), 0.217638, 1e-6);   // 2^-2.2
  EXPECT_DOUBLE_EQ(light_of_drive(curve(Law::s_curve), 0.25), 0.15625);  // 3/16 - 2/64
  EXPECT_DOUBLE_EQ(light_of_drive(curve(Law::table, 0, {0, 0.1, 1}), 0.75), 0.55);
}

TEST(DimmerCurve, ComesBackFromEveryLightToItsDriveAt24Bit) {
  for (const auto& law :
       {curve(Law::linear), curve(Law::square), curve(Law::gamma), curve(Law::gamma, 0.45),
        curve(Law::s_curve), curve(Law::table, 0, {0, 0.02, 0.2, 0.7, 1})})
    for (int i = 0; i <= 4096; ++i) {
      const double drive = i / 4096.0;
      EXPECT_NEAR(drive_of_light(law, light_of_drive(law, drive)), drive, 0.4 / 16777215.0)
          << static_cast<int>(law.law) << " at " << drive;
    }
}

TEST(DimmerCurve, TakesTheLeastDriveOfAPlateauAndClampsBeyondTheEnds) {
  const auto flat = curve(Law::table, 0, {0, 0.5, 0.5, 1});
  EXPECT_NEAR(drive_of_light(flat, 0.5), 1.0 / 3, 1e-12);
  EXPECT_EQ(drive_of_light(flat, 2), 1);
  EXPECT_EQ(drive_of_light(flat, -1), 0);
  EXPECT_EQ(light_of_drive(curve(Law::square), 7), 1);
}

}  // namespace
}  // namespace chiaro::patch
