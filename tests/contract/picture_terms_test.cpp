// SPDX-License-Identifier: Apache-2.0
// What every line of picture_terms.def promises, and what each means, on a bumpy ball lit from one
// side.
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <limits>
#include <set>

#include "controller/core/geometry.h"
#include "controller/core/random.h"
#include "controller/measure/picture_terms/picture_term.h"
#include "tests/support/studio_text.h"

namespace chiaro::measure::terms {
namespace {

using core::Vec3;

constexpr core::Size kSize{64, 64};

/// A ball with a fine relief before nothing.
core::GeometryPlanes ball() {
  core::GeometryPlanes planes;
  planes.depth = core::Plane(kSize, std::numeric_limits<float>::infinity());
  planes.normal_x = planes.normal_y = planes.normal_z = core::Plane(kSize);
  planes.object = core::Grid<std::uint16_t>(kSize);
  planes.subject = core::Grid<std::uint8_t>(kSize);
  for (int y = 0; y < kSize.height; ++y)
    for (int x = 0; x < kSize.width; ++x) {
      const double a = (x - 31.5) / 26, b = (31.5 - y) / 26, rest = 1 - a * a - b * b;
      if (rest <= 0) continue;
      Vec3 normal{a, -std::sqrt(rest), b};
      normal.x += 0.05 * std::sin(1.7 * x);
      normal = core::unit(normal);
      planes.depth.at(x, y) = static_cast<float>(3 - std::sqrt(rest));
      planes.normal_x.at(x, y) = static_cast<float>(normal.x);
      planes.normal_y.at(x, y) = static_cast<float>(normal.y);
      planes.normal_z.at(x, y) = static_cast<float>(normal.z);
      planes.object.at(x, y) = 1;
      planes.subject.at(x, y) = 1;
    }
  return planes;
}

/// Lit from `towards`, matt, with so much light from everywhere.
core::Plane lit(const core::GeometryPlanes& planes, Vec3 towards, double light, double ambient) {
  core::Plane out(kSize);
  for (int y = 0; y < kSize.height; ++y)
    for (int x = 0; x < kSize.width; ++x) {
      const Vec3 n{planes.normal_x.at(x, y), planes.normal_y.at(x, y), planes.normal_z.at(x, y)};
      if (planes.object.at(x, y) != 0)
        out.at(x, y) =
            static_cast<float>(ambient + light * std::max(0.0, core::dot(n, core::unit(towards))));
    }
  return out;
}

struct Scene {
  core::GeometryPlanes planes = ball();
  PixelMap map = pixel_map(planes);
  core::Plane curvature = curvature_of(planes);
  core::Plane luminance;
  core::Picture colour{kSize};
  Seen seen;
  explicit Scene(Vec3 towards, double light = 0.6, double ambient = 0.02)
      : luminance(lit(planes, towards, light, ambient)) {
    colour.red = colour.green = colour.blue = luminance;
    seen.luminance = &luminance;
    seen.map = &map;
    seen.curvature = &curvature;
    seen.colour = &colour;
    seen.key = 800;
    seen.fill = 200;
    seen.exemplar_chroma = core::Lab{0, 0, 0};
  }
};

double cost(std::string_view name, const Scene& scene, double wanted) {
  return picture_term(name)->cost(scene.seen, wanted).value();
}

class EveryPictureTerm : public testing::TestWithParam<PictureTerm> {};

TEST_P(EveryPictureTerm, CostsNothingToOneWhateverIsSeenAndWanted) {
  core::Random random(3);
  Scene scene({-1, -1, 1});
  for (int i = 0; i < 30; ++i) {
    for (std::size_t p = 0; p < scene.luminance.values.size(); ++p) {
      scene.luminance.values[p] = static_cast<float>(random.uniform(0, 1.5));
      scene.colour.red.values[p] = static_cast<float>(random.uniform());
    }
    scene.seen.key = random.uniform(0, 1000);
    scene.seen.fill = random.uniform(0, 1000);
    const double wanted = random.uniform(GetParam().wanted.least, GetParam().wanted.most);
    const auto now = GetParam().cost(scene.seen, wanted);
    ASSERT_TRUE(now);
    EXPECT_GE(*now, 0);
    EXPECT_LE(*now, 1);
  }
}

TEST_P(EveryPictureTerm, SurvivesBlackAndWhiteAndAnEmptyView) {
  for (const float light : {0.0f, 1.0f, 5.0f}) {
    Scene scene({0, -1, 0});
    for (float& y : scene.luminance.values) y = light;
    scene.colour.red = scene.colour.green = scene.colour.blue = scene.luminance;
    scene.seen.key = scene.seen.fill = 0;
    EXPECT_TRUE(std::isfinite(GetParam().cost(scene.seen, GetParam().usual).value_or(0)));
  }
  const core::Plane black(kSize);
  const PixelMap nothing =
      pixel_map_of(core::Grid<PixelType>(kSize), core::Grid<std::uint8_t>(kSize),
                   core::Grid<std::uint16_t>(kSize));
  Seen seen;
  seen.luminance = &black;
  seen.map = &nothing;
  EXPECT_TRUE(std::isfinite(GetParam().cost(seen, GetParam().usual).value_or(0)));
}

TEST_P(EveryPictureTerm, WhatIsUsualMayBeWanted) {
  EXPECT_TRUE(GetParam().wanted.contains(GetParam().usual));
  EXPECT_FALSE(GetParam().summary.empty());
  EXPECT_EQ(picture_term(GetParam().name)->summary, GetParam().summary);
}

INSTANTIATE_TEST_SUITE_P(Def, EveryPictureTerm,
                         testing::ValuesIn(picture_terms().begin(), picture_terms().end()),
                         [](const auto& term) { return std::string(term.param.name); });

TEST(PictureTermList, AgreesWithItsFolder) {
  std::set<std::string> files, listed{"picture_term"};
  const auto folder = support::shipped_folders().config / ".." / "controller/measure/picture_terms";
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    files.insert(entry.path().stem().string());
  for (const PictureTerm& term : picture_terms()) listed.insert(std::string(term.name));
  EXPECT_EQ(files, listed);
}

constexpr Vec3 kHeadOn{0, -1, 0}, kAside{-1, -1, 0.5};

TEST(PictureTerms, EntropyPrefersModellingToFlatLight) {
  EXPECT_LT(cost("entropy", Scene(kAside), 1), cost("entropy", Scene(kHeadOn, 0, 0.3), 1) - 0.2);
}

TEST(PictureTerms, ReliefPrefersRakingLight) {
  // A wall with ripples.
  core::GeometryPlanes wall = ball();
  for (int y = 0; y < kSize.height; ++y)
    for (int x = 0; x < kSize.width; ++x) {
      const Vec3 normal = core::unit(Vec3{0.06 * std::sin(1.7 * x), -1, 0.06 * std::sin(1.3 * y)});
      wall.normal_x.at(x, y) = static_cast<float>(normal.x);
      wall.normal_y.at(x, y) = static_cast<float>(normal.y);
      wall.normal_z.at(x, y) = static_cast<float>(normal.z);
    }
  double costs[2];
  for (const Vec3 from : {kHeadOn, Vec3{-1, -0.3, 0}}) {
    Scene scene(from);
    scene.curvature = curvature_of(wall);
    scene.luminance = lit(wall, from, 0.6, 0);
    costs[from.x < 0] = cost("relief", scene, 1);
  }
  EXPECT_LT(costs[1], costs[0] - 0.4);
}

TEST(PictureTerms, SilhouettePrefersALightBackOfTheOutline) {
  Scene rim(kHeadOn, 0, 0.3);  // bright everywhere before black
  EXPECT_LT(cost("silhouette", rim, 1), 0.2);
  EXPECT_GT(cost("silhouette", Scene(kHeadOn, 0, 0), 1), 0.9);
}

TEST(PictureTerms, CurvatureLightPrefersLightWhereItBends) {
  Scene bends(kHeadOn), other(kHeadOn);
  for (std::size_t i = 0; i < bends.curvature.values.size(); ++i) {
    bends.luminance.values[i] = bends.curvature.values[i];
    other.luminance.values[i] = 1 - bends.curvature.values[i];
  }
  EXPECT_LT(cost("curvature_light", bends, 1), 0.1);
  EXPECT_GT(cost("curvature_light", other, 1), 0.9);
}

TEST(PictureTerms, KeyToFillIsCountedInStops) {
  Scene scene(kAside);
  EXPECT_EQ(cost("key_fill", scene, 4), 0);
  EXPECT_NEAR(cost("key_fill", scene, 8), 0.25, 1e-12);
  scene.seen.fill = 0;
  EXPECT_EQ(cost("key_fill", scene, 4), 1);
}

TEST(PictureTerms, ClippedCountsBurntSurface) {
  EXPECT_EQ(cost("clipped", Scene(kAside, 0.5), 0), 0);
  EXPECT_GT(cost("clipped", Scene(kAside, 3), 0), 0.5);
}

TEST(PictureTerms, CoolWarmPrefersWarmLightAndCoolShade) {
  Scene gooch(kAside), grey(kAside);
  for (std::size_t i = 0; i < gooch.luminance.values.size(); ++i) {
    const bool light = gooch.luminance.values[i] > 0.2f;
    (light ? gooch.colour.blue : gooch.colour.red).values[i] *= 0.5f;
  }
  EXPECT_LT(cost("cool_warm", gooch, 20), cost("cool_warm", grey, 20) - 0.15);
  gooch.seen.colour = nullptr;
  EXPECT_FALSE(picture_term("cool_warm")->cost(gooch.seen, 20)) << "no colour, no opinion";
}

TEST(PictureTerms, ChromaIsMetByTheExemplarsOwnColourAtAnyBrightness) {
  Scene scene(kAside);
  for (float& y : scene.colour.red.values) y *= 1.4f;
  scene.seen.exemplar_chroma = chroma_of({0.7, 0.5, 0.5});
  EXPECT_NEAR(cost("chroma", scene, 0), 0, 1e-3);
  scene.seen.exemplar_chroma = chroma_of({0.3, 0.5, 0.8});
  EXPECT_GT(cost("chroma", scene, 0), 0.3);
}

}  // namespace
}  // namespace chiaro::measure::terms
