// SPDX-License-Identifier: Apache-2.0
// The fused SIMD passes against plain loops, on every SIMD target of the machine.
#include "controller/measure/kernels.h"

#include <cmath>
#include <gtest/gtest.h>

#include "controller/core/colour.h"
#include "controller/core/random.h"
#include "controller/measure/filters.h"
#include "controller/measure/gram.h"
#include "controller/measure/measure.h"

namespace chiaro::measure {
namespace {

core::Plane noise(core::Size size, std::uint64_t seed, float most) {
  core::Random random(seed);
  core::Plane out(size);
  for (float& v : out.values) v = most * static_cast<float>(random.uniform());
  return out;
}

/// Blobs of types and parts, so that rows and columns have many runs.
PixelMap patchwork(core::Size size, std::uint64_t seed) {
  core::Random random(seed);
  core::Grid<PixelType> type(size);
  core::Grid<std::uint8_t> external(size, 0);
  core::Grid<std::uint16_t> part(size);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const bool edge = random.below(9) == 0;
      const bool outside = (x / 5 + y / 3) % 4 == 0;
      type.at(x, y) = edge ? PixelType::edge : outside ? PixelType::background : PixelType::surface;
      part.at(x, y) = static_cast<std::uint16_t>(outside ? (x / 10) % 2 * 2 : 1);
    }
  return pixel_map_of(type, external, part);
}

double plain_contrast(const core::Plane& values, const PixelMap& map) {
  std::vector<double> sums(map.index.run_length.size());
  const PixelIndex& index = map.index;
  const int w = values.size.width, h = values.size.height;
  for (int y = 0; y < h; ++y)
    for (auto k = index.row_runs_row[static_cast<std::size_t>(y)];
         k < index.row_runs_row[static_cast<std::size_t>(y) + 1]; ++k)
      for (auto x = index.row_runs[k].begin; x < index.row_runs[k].end; ++x)
        sums[index.row_runs[k].slot] += values.at(static_cast<int>(x), y);
  std::vector<double> column(static_cast<std::size_t>(w));
  for (int y = 0; y < h; ++y) {
    const auto line = static_cast<std::size_t>(y);
    for (auto k = index.column_begins_row[line]; k < index.column_begins_row[line + 1]; ++k)
      column[index.column_begins[k]] = 0;
    for (int x = 0; x < w; ++x) column[static_cast<std::size_t>(x)] += values.at(x, y);
    for (auto k = index.column_ends_row[line]; k < index.column_ends_row[line + 1]; ++k)
      sums[index.column_ends[k].slot] = column[index.column_ends[k].x];
  }
  double total = 0;
  for (const auto [i, j] : index.crossings) {
    const double a = sums[i] / index.run_length[i], b = sums[j] / index.run_length[j];
    total += a + b > 0 ? std::abs(a - b) / (a + b) : 0;
  }
  return index.crossings.empty() ? 0 : total / static_cast<double>(index.crossings.size());
}

Components plain_components(const core::Plane& values, const PixelMap& map,
                            const core::Plane* lit) {
  Components out;
  const core::Plane g = sobel_magnitude(values);
  double weight = 0, sum = 0, squares = 0, edge_all = 0, edge_found = 0;
  for (std::size_t i = 0; i < values.values.size(); ++i) {
    const double v = values.values[i], l = lit ? lit->values[i] : 1, s = g.values[i];
    const PixelType type = map.type.values[i];
    if (type == PixelType::surface) weight += l, sum += l * v, squares += s * s;
    if (type == PixelType::edge) edge_all += 2 - l, edge_found += s > 8 ? 2 - l : 0;
    if (type != PixelType::background)
      out.histogram[static_cast<std::size_t>(std::nearbyint(v))] +=
          1.0 / static_cast<double>(map.surfaces + map.edges);
  }
  out.mean = weight > 0 ? sum / weight : 0;
  double off = 0;
  for (std::size_t i = 0; i < values.values.size(); ++i)
    if (map.type.values[i] == PixelType::surface)
      off += (lit ? double{lit->values[i]} : 1.0) * std::pow(values.values[i] - out.mean, 2);
  out.variance = weight > 0 ? std::sqrt(off / weight) : 0;
  out.gradient = map.surfaces ? std::sqrt(squares / static_cast<double>(map.surfaces)) : 0;
  out.edge = edge_all > 0 ? edge_found / edge_all : 0;
  out.contrast = plain_contrast(values, map);
  return out;
}

void expect_same(const Components& a, const Components& b) {
  EXPECT_NEAR(a.edge, b.edge, 1e-5);
  EXPECT_NEAR(a.mean, b.mean, 1e-3);
  EXPECT_NEAR(a.gradient, b.gradient, 1e-3);
  EXPECT_NEAR(a.variance, b.variance, 1e-3);
  EXPECT_NEAR(a.contrast, b.contrast, 1e-5);
  for (std::size_t k = 0; k < 256; ++k) EXPECT_NEAR(a.histogram[k], b.histogram[k], 1e-9) << k;
}

class EveryTarget : public testing::TestWithParam<std::int64_t> {
 protected:
  void SetUp() override { kernels::use_target(GetParam()); }
  void TearDown() override { kernels::use_target(0); }
};

TEST_P(EveryTarget, LightnessStaysWithinATenThousandthOfTheExactCurve) {
  core::Plane y({100003, 1});
  for (std::size_t i = 0; i < y.values.size(); ++i)
    y.values[i] = static_cast<float>(i) / 100000.0f - 0.00001f;
  const core::Plane out = working_scalar(y);
  double worst = 0;
  for (std::size_t i = 0; i < y.values.size(); ++i) {
    const double exact = 2.55 * core::lightness(std::min(1.0, double{y.values[i]}));
    worst = std::max(worst, std::abs(exact - double{out.values[i]}));
  }
  EXPECT_LT(worst, 1e-4);
  RecordProperty("worst", std::to_string(worst));
}

TEST_P(EveryTarget, LightnessRisesWithLuminance) {
  core::Plane y({20001, 1});
  for (std::size_t i = 0; i < y.values.size(); ++i)
    y.values[i] = 0.0085f + static_cast<float>(i) * 5e-8f;  // across the knee
  const core::Plane out = working_scalar(y);
  for (std::size_t i = 1; i < out.values.size(); ++i)
    ASSERT_GE(out.values[i], out.values[i - 1] - 2e-5f) << i;
}

TEST_P(EveryTarget, LightnessOfNotANumberIsBlack) {
  core::Plane y({20, 1}, std::nanf(""));
  for (const float v : working_scalar(y).values) EXPECT_EQ(v, 0);
}

TEST_P(EveryTarget, FusedPassEqualsPlainLoopsAtOddSizes) {
  for (const core::Size size : {core::Size{64, 64}, {37, 11}, {1, 1}, {3, 50}, {130, 7}}) {
    SCOPED_TRACE(testing::Message() << size.width << "x" << size.height);
    const core::Plane values = noise(size, 7, 255), lit = noise(size, 8, 1);
    const PixelMap map = patchwork(size, 9);
    expect_same(components(values, map), plain_components(values, map, nullptr));
    expect_same(components(values, map, &lit), plain_components(values, map, &lit));
    const PixelMap flat = flat_pixel_map(size);
    expect_same(components(values, flat), plain_components(values, flat, nullptr));
  }
}

TEST_P(EveryTarget, LuminancePassEqualsTwoSteps) {
  const core::Plane luminance = noise({61, 40}, 3, 1.2f);
  const PixelMap map = patchwork({61, 40}, 4);
  expect_same(components_of_luminance(luminance, map), components(working_scalar(luminance), map));
}

TEST_P(EveryTarget, AConstantPictureHasNoSpreadAndNoShading) {
  const Components c = components(core::Plane({100, 90}, 201.7f), flat_pixel_map({100, 90}));
  EXPECT_NEAR(c.mean, 201.7, 1e-4);
  EXPECT_EQ(c.variance, 0);
  EXPECT_EQ(c.gradient, 0);
}

TEST_P(EveryTarget, HaarCoefficientsAreDifferencesOfHalves) {
  const core::Plane values = noise({64, 64}, 5, 255);
  const HaarSpectrum s = haar_spectrum(values, 64);
  const auto mean = [&](int x0, int y0, int w, int h) {
    double sum = 0;
    for (int y = y0; y < y0 + h; ++y)
      for (int x = x0; x < x0 + w; ++x) sum += double{values.at(x, y)};
    return sum / (w * h);
  };
  EXPECT_NEAR(s.mean, mean(0, 0, 64, 64), 1e-3);
  for (int level = 0; level < 6; ++level) {
    const int nodes = 1 << level, n = 64 >> level;
    for (int j = 0; j < nodes; ++j)
      for (int i = 0; i < nodes; ++i) {
        const auto k = static_cast<std::size_t>(j * nodes + i);
        const int x = i * n, y = j * n, half = n / 2;
        EXPECT_NEAR(s.horizontal[static_cast<std::size_t>(level)][k],
                    mean(x, y, half, n) - mean(x + half, y, half, n), 1e-3);
        EXPECT_NEAR(s.vertical[static_cast<std::size_t>(level)][k],
                    mean(x, y, n, half) - mean(x, y + half, n, half), 1e-3);
      }
  }
}

TEST_P(EveryTarget, GramFormsAgreeWithThePicturesThemselves) {
  const core::Size size{32, 32};
  for (const std::size_t n : {1u, 2u, 3u, 5u, 9u}) {
    SCOPED_TRACE(n);
    std::vector<core::Plane> layers;
    for (std::size_t k = 0; k < n; ++k) layers.push_back(noise(size, 20 + k, 1));
    const core::Plane offset = noise(size, 50, 0.2f), target = noise(size, 51, 2),
                      weight = noise(size, 52, 1);
    std::vector<const core::Plane*> columns;
    core::Random random(60 + n);
    std::vector<double> x;
    core::Plane picture = offset;
    for (const core::Plane& layer : layers) {
      columns.push_back(&layer);
      x.push_back(random.uniform());
      for (std::size_t i = 0; i < picture.values.size(); ++i)
        picture.values[i] += static_cast<float>(x.back()) * layer.values[i];
    }
    const double haar = haar_distance(haar_spectrum(picture, 32), haar_spectrum(target, 32));
    EXPECT_NEAR(haar_form(columns, offset, target).at(x), haar * haar, 1e-5 * haar * haar);

    double plain = 0, weighted = 0;
    for (std::size_t i = 0; i < picture.values.size(); ++i) {
      const double d = double{picture.values[i]} - double{target.values[i]};
      plain += d * d;
      weighted += double{weight.values[i]} * d * d;
    }
    EXPECT_NEAR(least_squares_form(columns, offset, target, nullptr).at(x), plain, 1e-5 * plain);
    EXPECT_NEAR(least_squares_form(columns, offset, target, &weight).at(x), weighted,
                1e-5 * weighted);

    const PixelMap map = patchwork(size, 70);
    const Components c = components(picture, map);
    const MomentForms forms = moment_forms(columns, offset, map);
    double mean = forms.mean[n];
    for (std::size_t k = 0; k < n; ++k) mean += forms.mean[k] * x[k];
    EXPECT_NEAR(mean, c.mean, 1e-5);
    EXPECT_NEAR(forms.variance.at(x), c.variance * c.variance, 1e-5);
    EXPECT_NEAR(forms.squared_gradient.at(x), c.gradient * c.gradient, 1e-5);
  }
}

INSTANTIATE_TEST_SUITE_P(Simd, EveryTarget, testing::ValuesIn(kernels::targets()),
                         [](const auto& target) {
                           return "target" + std::to_string(target.param);
                         });

}  // namespace
}  // namespace chiaro::measure
