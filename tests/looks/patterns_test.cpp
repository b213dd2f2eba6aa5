// SPDX-License-Identifier: Apache-2.0
// The marks by which photographers name a light, measured on results: each mood is designed on the
// shipped studio, the virtual studio carries the look out with its small errors, and a close
// picture of the bust, path traced, must show the pattern. The bust's own anatomy says where to
// look (config/subjects/bust.yaml).
#include <cmath>
#include <deque>
#include <numeric>

#include "simulator/moods/recipe.h"
#include "tests/looks/stage.h"

namespace chiaro::looks {
namespace {

using core::Vec3;
constexpr core::Size kClose{192, 192};
constexpr double kBase = 1.05;  // of the bust in the shipped studio

struct Result {
  design::Look look;
  studio::Studio studio;
  studio::Camera camera;
  double turn = 0;
  core::Picture picture;  ///< the whole frame, as the camera gives it
  core::Plane light;      ///< close, luminance
  core::Grid<std::uint8_t> subject;

  /// A place of the bust's own frame, in the close picture.
  std::pair<int, int> pixel(Vec3 p) const {
    const Vec3 at{p.x * std::cos(turn) - p.y * std::sin(turn),
                  p.x * std::sin(turn) + p.y * std::cos(turn), p.z + kBase};
    const Vec3 forward = core::unit(camera.look_at - camera.at);
    const Vec3 right = core::unit(core::cross(forward, {0, 0, 1}));
    const Vec3 up = core::cross(right, forward), d = at - camera.at;
    const double scale =
        kClose.height / 2.0 / std::tan(camera.vertical_fov / 2) / core::dot(d, forward);
    return {static_cast<int>(kClose.width / 2.0 + scale * core::dot(d, right)),
            static_cast<int>(kClose.height / 2.0 - scale * core::dot(d, up))};
  }
  /// Mean luminance of a small spot there.
  double at(Vec3 p) const {
    const auto [x, y] = pixel(p);
    double sum = 0;
    for (int dy = -2; dy <= 2; ++dy)
      for (int dx = -2; dx <= 2; ++dx) sum += light.at(x + dx, y + dy);
    return sum / 25;
  }
  /// The share of a box of the face (metres, bust frame, seen from the front) above `least`.
  double share_above(double x0, double x1, double z0, double z1, double least) const {
    const auto [left, bottom] = pixel({x0, -0.085, z0});
    const auto [right, top] = pixel({x1, -0.085, z1});
    int above = 0, all = 0;
    for (int y = top; y < bottom; ++y)
      for (int x = left; x < right; ++x, ++all) above += light.at(x, y) >= least;
    return double(above) / std::max(all, 1);
  }
};

constexpr Vec3 kLeftCheek{-0.037, -0.075, 0.470}, kRightCheek{0.037, -0.075, 0.470};  // camera's
constexpr Vec3 kUnderNose{0, -0.093, 0.445}, kForehead{0, -0.0955, 0.540},
    kChin{0, -0.0886, 0.4025};

/// 3 x 3 means: what is left of the noise must not make or break a shadow.
core::Plane smoothed(const core::Plane& plane) {
  core::Plane out = plane;
  for (int y = 1; y + 1 < plane.size.height; ++y)
    for (int x = 1; x + 1 < plane.size.width; ++x) {
      float sum = 0;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) sum += plane.at(x + dx, y + dy);
      out.at(x, y) = sum / 9;
    }
  return out;
}

/// Key to fill within half a stop of what the recipe set up.
void expect_ratio(const design::Mood& mood, const Result& result) {
  const auto recipe = simulator::load_recipe(mood.picture.parent_path() / "recipe.yaml", kFolders);
  ASSERT_TRUE(recipe);
  for (const simulator::RecipeLamp& lamp : recipe->lamps) {
    if (lamp.role != studio::Role::fill || !lamp.stops_below_key) continue;
    const auto ratio = design::key_fill_ratio(result.studio, result.look.wanted);
    ASSERT_TRUE(ratio) << mood.name;
    EXPECT_NEAR(std::log2(*ratio), *lamp.stops_below_key, 0.5) << mood.name << ", stops";
  }
}

Result result_of(const std::string& name) {
  const support::TemporaryFolder cache;
  const auto all = moods();
  const auto mood =
      std::find_if(all.begin(), all.end(), [&](const auto& each) { return each.name == name; });
  if (mood == all.end()) throw std::runtime_error("no mood " + name);
  const Room stage = room(turned(portrait(), *mood), cache.path());
  auto look = designed(stage, *mood, 0, cache.path());
  if (!look) throw std::runtime_error(core::to_string(look.problems()));
  Result out{*std::move(look), stage.studio, stage.camera, mood->sitter_turn, {}, {}, {}};
  out.picture = photograph(stage, out.look.wanted, stage.camera);
  out.camera.look_at = {0, 0, 1.535};
  out.camera.vertical_fov = core::radians(5.5);
  out.camera.size = kClose;
  out.light = smoothed(core::luminance(photograph(stage, out.look.wanted, out.camera, 24)));
  const render::View view = render::see(stage.tracer, out.camera, kClose);
  out.subject = core::planes(view.buffer).subject;
  std::printf("%s: %s, %s\n", name.c_str(),
              std::string(name_of(out.look.judgement.verdict)).c_str(),
              design::place_in_words({out.look.wanted.states[0].get(core::Dof::azimuth),
                                      out.look.wanted.states[0].get(core::Dof::elevation),
                                      out.look.wanted.states[0].get(core::Dof::distance)})
                  .c_str());
  expect_ratio(*mood, out);
  return out;
}

/// Pixels of the sitter connected with the seed, all lit (or all dark) against `limit`.
std::vector<std::pair<int, int>> island(const Result& face, Vec3 seed, double limit, bool lit) {
  core::Grid<std::uint8_t> seen(kClose);
  const auto open = [&](int x, int y) {
    return x >= 0 && y >= 0 && x < kClose.width && y < kClose.height && !seen.at(x, y) &&
           face.subject.at(x, y) && (face.light.at(x, y) >= limit) == lit;
  };
  std::vector<std::pair<int, int>> found;
  std::deque<std::pair<int, int>> todo;
  const auto [sx, sy] = face.pixel(seed);
  if (open(sx, sy)) {
    seen.at(sx, sy) = 1;
    todo.emplace_back(sx, sy);
  }
  while (!todo.empty()) {
    const auto [x, y] = todo.front();
    todo.pop_front();
    found.emplace_back(x, y);
    for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}})
      if (open(x + dx, y + dy)) {
        seen.at(x + dx, y + dy) = 1;
        todo.emplace_back(x + dx, y + dy);
      }
  }
  return found;
}
bool holds(const std::vector<std::pair<int, int>>& pixels, std::pair<int, int> pixel) {
  return std::find(pixels.begin(), pixels.end(), pixel) != pixels.end();
}

TEST(Patterns, RembrandtHasAClosedTriangleOnTheShadowCheek) {
  const Result face = result_of("rembrandt");
  const double limit = 0.42 * face.at(kLeftCheek);
  const auto triangle = island(face, kRightCheek, limit, true);
  const auto lit = island(face, kLeftCheek, limit, true);
  EXPECT_GT(triangle.size(), 60u) << "a patch of light, not a speck";
  EXPECT_LT(triangle.size(), lit.size() / 4);
  EXPECT_FALSE(holds(lit, face.pixel(kRightCheek))) << "open: joined with the lit side";
  int top = kClose.height, bottom = 0;
  for (const auto& pixel : triangle) {
    top = std::min(top, pixel.second);
    bottom = std::max(bottom, pixel.second);
  }
  EXPECT_GT(top, face.pixel({0.03, -0.08, 0.515}).second) << "it reaches above the eye";
  EXPECT_LT(bottom, face.pixel({0.03, -0.08, 0.412}).second) << "it reaches below the mouth";
}

TEST(Patterns, LoopHasASmallShadowOfTheNoseThatStandsAlone) {
  const Result face = result_of("loop");
  const double cheek = face.at(kLeftCheek);
  EXPECT_GT(face.at(kRightCheek), 0.55 * cheek) << "the far cheek is lit";
  // From the nose outwards: its shadow, then the lit cheek before the head's own shadow side.
  int rows = 0;
  const int top = face.pixel({0, -0.09, 0.458}).second,
            bottom = face.pixel({0, -0.09, 0.436}).second;
  for (int y = top; y <= bottom; ++y) {
    int x = face.pixel({0.003, -0.09, 0.45}).first;
    const int end = face.pixel({0.055, -0.07, 0.45}).first;
    while (x < end && face.light.at(x, y) >= 0.55 * cheek) ++x;
    int shadow = 0, light = 0;
    for (; x < end && face.light.at(x, y) < 0.55 * cheek; ++x) ++shadow;
    for (; x < end && face.light.at(x, y) >= 0.55 * cheek; ++x) ++light;
    rows += shadow >= 3 && light >= 6;
  }
  EXPECT_GE(rows, 3) << "no shadow of the nose with lit cheek beside it";
}

TEST(Patterns, ButterflyIsSymmetricWithAShadowUnderTheNose) {
  const Result face = result_of("butterfly");
  const double cheeks = (face.at(kLeftCheek) + face.at(kRightCheek)) / 2;
  EXPECT_LT(face.at(kUnderNose), 0.7 * cheeks);
  const auto [left, bottom] = face.pixel({-0.055, -0.085, 0.42});
  const auto [right, top] = face.pixel({0.055, -0.085, 0.545});
  double difference = 0, sum = 0;
  for (int y = top; y < bottom; ++y)
    for (int x = left; x <= right; ++x) {
      difference += std::abs(face.light.at(x, y) - face.light.at(left + right - x, y));
      sum += face.light.at(x, y);
    }
  EXPECT_LT(difference / sum, 0.15);
}

TEST(Patterns, ClamshellFillsTheShadowUnderNoseAndChin) {
  const Result face = result_of("clamshell");
  const double cheeks = (face.at(kLeftCheek) + face.at(kRightCheek)) / 2;
  EXPECT_GT(face.at(kUnderNose), 0.5 * cheeks);
  EXPECT_NEAR(face.at(kLeftCheek) / face.at(kRightCheek), 1, 0.25);
}

TEST(Patterns, SplitLightsOneHalfOfTheFaceOnly) {
  const Result face = result_of("split");
  const double limit = 0.3 * face.at(kLeftCheek);
  EXPECT_GT(face.share_above(-0.055, -0.015, 0.42, 0.54, limit), 0.8);
  EXPECT_LT(face.share_above(0.015, 0.055, 0.42, 0.54, limit), 0.15);
}

/// Mean luminance of the head's left and right third at the height of the cheeks.
std::pair<double, double> outer_thirds(const Result& face) {
  double left = 0, right = 0;
  int lefts = 0, rights = 0;
  const int top = face.pixel({0, -0.085, 0.50}).second,
            bottom = face.pixel({0, -0.085, 0.46}).second;
  for (int y = top; y < bottom; ++y) {
    int from = kClose.width, to = 0;
    for (int x = 0; x < kClose.width; ++x)
      if (face.subject.at(x, y)) from = std::min(from, x), to = std::max(to, x);
    const int third = (to - from) / 3;
    for (int x = from + 2; x < from + third; ++x, ++lefts) left += face.light.at(x, y);
    for (int x = to - third; x < to - 2; ++x, ++rights) right += face.light.at(x, y);
  }
  return {left / std::max(lefts, 1), right / std::max(rights, 1)};
}

TEST(Patterns, BroadLightsTheNearSideOfATurnedHeadAndShortLeavesItInShadow) {
  // Both are turned to camera left: the left third is the far side of the face.
  const auto [broad_far, broad_near] = outer_thirds(result_of("broad"));
  EXPECT_GT(broad_near, 0.5 * broad_far);
  const auto [short_far, short_near] = outer_thirds(result_of("short"));
  EXPECT_GT(short_far, 3 * short_near);
}

TEST(Patterns, RimDrawsTheEdgeAndLeavesTheFaceDark) {
  const Result face = result_of("rim");
  // The brightest tenth of the sitter against the face.
  std::vector<float> sitter;
  for (std::size_t i = 0; i < face.light.values.size(); ++i)
    if (face.subject.values[i] != 0) sitter.push_back(face.light.values[i]);
  std::sort(sitter.begin(), sitter.end());
  EXPECT_GT(sitter[sitter.size() * 97 / 100], 4 * face.at(kForehead));
  EXPECT_LT(core::lightness(face.at(kForehead)), 40);
}

TEST(Patterns, SilhouetteIsADarkShapeBeforeABrightWall) {
  const Result face = result_of("silhouette");
  const double wall = core::luminance(face.picture.at(8, 60));
  EXPECT_GT(core::lightness(wall), 60);
  EXPECT_LT(core::lightness(face.at(kForehead)), 12);
}

double mean_lightness(const core::Picture& picture) {
  const core::Plane y = core::luminance(picture);
  double sum = 0;
  for (const float value : y.values) sum += core::lightness(std::min(value, 1.0f));
  return sum / static_cast<double>(y.values.size());
}

TEST(Patterns, HighKeyIsBrightAndLowKeyIsDark) {
  EXPECT_GT(mean_lightness(result_of("high-key").picture), 75);
  EXPECT_LT(mean_lightness(result_of("low-key").picture), 30);
}

TEST(Patterns, HorrorComesFromBelow) {
  const Result face = result_of("horror");
  EXPECT_GT(face.at(kUnderNose), face.at(kForehead));
  EXPECT_GT(face.at(kChin), face.at(kForehead));
}

TEST(Patterns, FilmNoirLeavesNothingInItsShadows) {
  const Result face = result_of("film-noir");
  const double limit = 0.2 * face.at(kRightCheek);
  EXPECT_LT(face.share_above(-0.055, -0.015, 0.42, 0.54, limit), 0.75);
  EXPECT_LT(face.at({-0.0315, -0.0764, 0.4992}), limit) << "the far eye lies in the dark";
}

double red_to_blue(const core::Picture& picture) {
  double red = 0, blue = 0;
  for (std::size_t i = 0; i < picture.red.values.size(); ++i) {
    red += picture.red.values[i];
    blue += picture.blue.values[i];
  }
  return red / blue;
}

TEST(Patterns, GoldenHourAndCandlelightMeasureWarmerAndMoonlightCoolerThanDaylight) {
  const double daylight = red_to_blue(result_of("loop").picture);
  EXPECT_GT(red_to_blue(result_of("golden-hour").picture), 1.5 * daylight);
  EXPECT_GT(red_to_blue(result_of("candlelight").picture), 1.5 * daylight);
  EXPECT_LT(red_to_blue(result_of("moonlight").picture), daylight / 1.5);
}

}  // namespace
}  // namespace chiaro::looks
