// SPDX-License-Identifier: Apache-2.0
#include "simulator/virtual_studio/noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "controller/core/random.h"

namespace chiaro::simulator {
namespace {

constexpr std::size_t kDraws = 1u << 16u;  // a power of two: indices wrap by a mask

/// Normal numbers drawn once: a fresh Box-Muller per pixel and frame would cost more than the
/// picture. Rows start at random places in the table, so no pattern repeats in sight.
const std::vector<float>& normals() {
  static const auto kTable = [] {
    core::Random random(0x5eed);
    std::vector<float> table(kDraws);
    for (auto& x : table) x = static_cast<float>(random.normal());
    return table;
  }();
  return kTable;
}

/// sRGB bytes of linear values 0..1 in steps fine enough for 8 bits near black.
const std::vector<std::uint8_t>& encoding() {
  static const auto kTable = [] {
    std::vector<std::uint8_t> table(16384);
    for (std::size_t i = 0; i < table.size(); ++i)
      table[i] = static_cast<std::uint8_t>(
          std::lround(255 * core::srgb_encoded(static_cast<double>(i) / 16383.0)));
    return table;
  }();
  return kTable;
}

}  // namespace

double noise_at(const Sensor& sensor, double linear) {
  if (!sensor.on) return 0;
  const double electrons = std::max(0.0, linear) * sensor.full_well;
  return std::sqrt(electrons + sensor.read_noise * sensor.read_noise) / sensor.full_well;
}

core::EncodedPicture exposed(const core::Picture& linear, const Sensor& sensor, std::uint64_t seed,
                             std::uint64_t frame) {
  const auto size = linear.size();
  core::EncodedPicture result(size);
  const core::Plane* const planes[] = {&linear.red, &linear.green, &linear.blue};
  const auto& table = normals();
  const auto& bytes = encoding();
  core::Random random(seed, frame);
  const auto well = static_cast<float>(sensor.full_well);
  const auto read = static_cast<float>(sensor.read_noise * sensor.read_noise);
  for (int y = 0; y < size.height; ++y) {
    for (std::size_t c = 0; c < 3; ++c) {
      std::size_t at = random.next();
      const std::size_t stride = (random.next() & (kDraws - 1)) | 1u;
      const float* from = planes[c]->row(y);
      for (int x = 0; x < size.width; ++x) {
        float value = std::clamp(from[x], 0.0f, 1.0f);
        if (sensor.on) {
          at += stride;
          value += std::sqrt(value * well + read) / well * table[at & (kDraws - 1)];
          value = std::clamp(value, 0.0f, 1.0f);
        }
        result.at(x, y)[c] = bytes[static_cast<std::size_t>(value * 16383.0f + 0.5f)];
      }
    }
  }
  return result;
}

}  // namespace chiaro::simulator
