// SPDX-License-Identifier: Apache-2.0
#include "simulator/virtual_studio/noise.h"

#include <cmath>
#include <cstdlib>
#include <gtest/gtest.h>

namespace chiaro::simulator {
namespace {

core::Picture grey(double value) {
  core::Picture picture(core::Size{128, 128});
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 128; ++x) picture.set(x, y, {value, value, value});
  return picture;
}

struct Spread {
  double mean = 0, deviation = 0;
};
Spread spread(const core::EncodedPicture& picture) {
  double sum = 0, squares = 0;
  for (const auto& pixel : picture.values)
    for (const auto byte : pixel) {
      const double linear = core::srgb_linear(byte / 255.0);
      sum += linear;
      squares += linear * linear;
    }
  const double n = 3.0 * static_cast<double>(picture.values.size());
  return {sum / n, std::sqrt(squares / n - sum * sum / n / n)};
}

TEST(Sensor, SwitchedOffOnlyEncodes) {
  const auto picture = exposed(grey(0.1842), {.on = false}, 1, 1);
  EXPECT_EQ(picture, core::encoded(grey(0.1842)));
}

TEST(Sensor, NoiseHasTheSizeThatShotAndReadNoiseGive) {
  for (const double value : {0.05, 0.1842, 0.6}) {
    const Sensor sensor;
    EXPECT_NEAR(noise_at(sensor, value),
                std::sqrt(value * sensor.full_well + 36) / sensor.full_well, 1e-12);
    const auto seen = spread(exposed(grey(value), sensor, 1, 1));
    EXPECT_NEAR(seen.mean, value, 0.02 * value);
    EXPECT_NEAR(seen.deviation, noise_at(sensor, value), 0.15 * noise_at(sensor, value));
  }
}

TEST(Sensor, EveryFrameHasItsOwnNoiseAndEverySeedRepeatsIt) {
  const auto picture = grey(0.3);
  EXPECT_EQ(exposed(picture, {}, 1, 7), exposed(picture, {}, 1, 7));
  EXPECT_NE(exposed(picture, {}, 1, 7), exposed(picture, {}, 1, 8));
  EXPECT_NE(exposed(picture, {}, 1, 7), exposed(picture, {}, 2, 7));
}

TEST(Sensor, ClipsAtWhite) {
  for (const auto& pixel : exposed(grey(40), {.on = false}, 1, 1).values) EXPECT_EQ(pixel[0], 255);
}

}  // namespace
}  // namespace chiaro::simulator
