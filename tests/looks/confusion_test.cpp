// SPDX-License-Identifier: Apache-2.0
// Does a look designed towards a mood look like that mood, and not like another? The virtual
// studio's camera (path traced, lamps and stands a little off, sensor noise) takes each look's
// picture; a measure that no objective of ours uses says whose exemplar it is nearest: the
// illumination on a ball, fitted as nine spherical harmonics to the picture and the sitter's
// normals (Ramamoorthi and Hanrahan 2001), and the colour of the background, both in CIE Lab.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <gtest/gtest.h>

#include "controller/core/picture_file.h"
#include "controller/design/design.h"
#include "controller/design/moods.h"
#include "controller/render/view.h"
#include "controller/studio/load.h"
#include "controller/twin/scene.h"
#include "simulator/virtual_studio/camera.h"
#include "simulator/virtual_studio/noise.h"
#include "simulator/virtual_studio/stage.h"
#include "tests/support/fake_world.h"

namespace chiaro::end_to_end {
namespace {

namespace fs = std::filesystem;
using core::Rgb;
using core::Vec3;

const studio::Folders kFolders{fs::path(CHIARO_SOURCE) / "config"};
const fs::path kAssets = fs::path(CHIARO_SOURCE) / "build/assets";
constexpr core::Size kSize{160, 120};
constexpr std::size_t kTerms = 9;
using Terms = std::array<double, kTerms>;

/// Real spherical harmonics up to order two, unnormalised: the fit takes up the factors.
Terms harmonics(Vec3 n) {
  return {
      1, n.x, n.y, n.z, n.x * n.y, n.y * n.z, n.x * n.z, n.x * n.x - n.y * n.y, 3 * n.z * n.z - 1};
}

/// Solves the symmetric positive system by Gauss; `a` and `b` are used up.
Terms solved(std::array<Terms, kTerms> a, Terms b) {
  for (std::size_t i = 0; i < kTerms; ++i)
    for (std::size_t r = i + 1; r < kTerms; ++r) {
      const double factor = a[r][i] / a[i][i];
      for (std::size_t c = i; c < kTerms; ++c) a[r][c] -= factor * a[i][c];
      b[r] -= factor * b[i];
    }
  Terms x{};
  for (std::size_t i = kTerms; i-- > 0;) {
    double sum = b[i];
    for (std::size_t c = i + 1; c < kTerms; ++c) sum -= a[i][c] * x[c];
    x[i] = sum / a[i][i];
  }
  return x;
}

/// What a mid-grey ball and the background look like in that light.
struct Impression {
  std::vector<core::Lab> ball, background;
};

struct Sums {
  std::array<Terms, kTerms> matrix{};
  std::array<Terms, 3> vector{};
  void add(const Terms& h, const std::array<double, 3>& light) {
    for (std::size_t i = 0; i < kTerms; ++i) {
      for (std::size_t j = 0; j < kTerms; ++j) matrix[i][j] += h[i] * h[j];
      for (std::size_t c = 0; c < 3; ++c) vector[c][i] += h[i] * light[c];
    }
  }
};

std::vector<core::Lab> ball(Sums sums) {
  for (std::size_t i = 0; i < kTerms; ++i) sums.matrix[i][i] += 1;  // normals fill half a sphere
  std::array<Terms, 3> fit;
  for (std::size_t c = 0; c < 3; ++c) fit[c] = solved(sums.matrix, sums.vector[c]);
  std::vector<core::Lab> out;
  for (int i = -4; i <= 4; ++i)
    for (int k = -4; k <= 4; ++k) {
      const double x = i / 5.0, z = k / 5.0;
      if (x * x + z * z > 0.8) continue;
      const Terms h = harmonics({x, -std::sqrt(1 - x * x - z * z), z});
      std::array<double, 3> light{};
      for (std::size_t c = 0; c < 3; ++c) {
        for (std::size_t t = 0; t < kTerms; ++t) light[c] += fit[c][t] * h[t];
        light[c] = std::clamp(0.5 * light[c], 0.0, 1.0);
      }
      out.push_back(core::lab_of({light[0], light[1], light[2]}));
    }
  return out;
}

/// The backdrop in six fields, three across and two down, where it shows.
std::size_t field(std::uint32_t pixel) {
  const std::uint32_t width = kSize.width, x = pixel % width, y = pixel / width;
  return std::min<std::size_t>(2, 3 * x / width) + 3 * (2 * y / kSize.height);
}

Impression impression(const core::Picture& picture, const core::GBuffer& view) {
  Sums sums;
  std::array<Rgb, 6> colour{};
  std::array<double, 6> count{};
  for (std::size_t i = 0; i < view.samples(); ++i) {
    const auto x = static_cast<int>(view.pixel[i] % kSize.width);
    const auto y = static_cast<int>(view.pixel[i] / kSize.width);
    const Rgb seen = picture.at(x, y);
    if (!view.objects[view.object[i] - 1u].subject) {
      colour[field(view.pixel[i])] = colour[field(view.pixel[i])] + seen;
      count[field(view.pixel[i])] += 1;
      continue;
    }
    const std::array<float, 3> albedo{view.diffuse_r[i], view.diffuse_g[i], view.diffuse_b[i]};
    if (*std::min_element(albedo.begin(), albedo.end()) < 0.08f) continue;
    sums.add(harmonics({view.normal_x[i], view.normal_y[i], view.normal_z[i]}),
             {seen.r / albedo[0], seen.g / albedo[1], seen.b / albedo[2]});
  }
  Impression out{ball(sums), {}};
  for (std::size_t k = 0; k < colour.size(); ++k)
    out.background.push_back(
        core::lab_of(count[k] > 0 ? (1 / count[k]) * colour[k] : Rgb{0, 0, 0}));
  return out;
}

double difference(const std::vector<core::Lab>& a, const std::vector<core::Lab>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double l = a[i].l - b[i].l, g = a[i].a - b[i].a, y = a[i].b - b[i].b;
    sum += l * l + g * g + y * y;
  }
  return std::sqrt(sum / static_cast<double>(a.size()));
}
/// The sitter counts more than what is behind.
double distance(const Impression& a, const Impression& b) {
  return 0.7 * difference(a.ball, b.ball) + 0.3 * difference(a.background, b.background);
}

/// A studio with everything that stays while moods change.
struct Room {
  studio::Studio studio;
  studio::Camera camera;
  std::shared_ptr<const twin::Geometry> geometry;
  std::shared_ptr<const render::Tracer> tracer;
  core::GBuffer view;
};

Room room(studio::Studio studio, const fs::path& cache) {
  Room out{std::move(studio), {}, {}, {}, {}};
  out.camera = out.studio.main_camera();
  out.camera.size = kSize;
  auto geometry = twin::build_geometry(out.studio, cache);
  if (!geometry) {
    ADD_FAILURE() << core::to_string(geometry.problems());
    return out;
  }
  out.geometry = *geometry;
  out.tracer = std::make_shared<const render::Tracer>(out.geometry);
  out.view = render::see(out.tracer, out.camera, kSize).buffer;
  return out;
}

studio::Studio portrait() {
  return studio::load_studio(kFolders.studios() / "portrait.yaml", kFolders)->studio;
}

std::vector<design::Mood> attainable() {
  std::vector<design::Mood> moods;
  for (const design::Mood& mood : design::load_moods(kFolders.moods()).moods)
    if (mood.attainable) moods.push_back(mood);
  return moods;
}

/// Stands are put where the look says, lamps are asked what it says, and the camera looks.
core::Picture photograph(const Room& room, const studio::Rig& rig) {
  simulator::VirtualStage stage(room.studio, room.geometry->aim, simulator::Departures{}, 7);
  for (std::size_t i = 0; i < rig.states.size(); ++i) stage.put(i, rig.states[i]);
  stage.ask(rig);
  stage.advance(5);
  simulator::CameraOptions options;
  options.renderer = simulator::Renderer::path;
  options.samples = 8;
  simulator::VirtualCamera camera(room.studio, room.camera, room.tracer, options);
  return core::linear(simulator::exposed(camera.picture(stage.lit()), simulator::Sensor{}, 3, 0));
}

void print(const std::vector<design::Mood>& moods, const std::vector<std::vector<double>>& matrix) {
  std::printf("%14s", "look\\exemplar");
  for (const design::Mood& mood : moods) std::printf("%12s", mood.name.c_str());
  std::printf("\n");
  for (std::size_t i = 0; i < matrix.size(); ++i) {
    std::printf("%14s", moods[i].name.c_str());
    for (const double d : matrix[i]) std::printf("%12.1f", d);
    std::printf("\n");
  }
}

void expect_each_look_nearest_its_own_mood(const studio::Studio& sitter) {
  const support::TemporaryFolder cache;
  const Room bust = room(portrait(), cache.path());
  const Room own = room(sitter, cache.path());
  ASSERT_TRUE(own.tracer);
  const auto layers = design::geometric_layers(own.studio, {.mesh_cache = cache.path()});
  ASSERT_TRUE(layers) << core::to_string(layers.problems());
  const std::vector<design::Mood> moods = attainable();
  ASSERT_GE(moods.size(), 5u);
  std::vector<Impression> exemplars;
  std::vector<std::vector<double>> matrix;
  for (const design::Mood& mood : moods) {
    const auto picture = core::read_picture(mood.picture);
    ASSERT_TRUE(picture);
    exemplars.push_back(impression(core::resized(core::linear(*picture), kSize), bust.view));
  }
  for (const design::Mood& mood : moods) {
    design::Options options;
    options.trials = 400;
    const auto goal = design::goal_of(mood, design::Objective::wavelet);
    ASSERT_TRUE(goal);
    const auto look = design::design(own.studio, **layers, *goal, options);
    ASSERT_TRUE(look) << core::to_string(look.problems());
    const Impression seen = impression(photograph(own, look->wanted), own.view);
    matrix.emplace_back();
    for (const Impression& exemplar : exemplars) matrix.back().push_back(distance(seen, exemplar));
  }
  print(moods, matrix);
  for (std::size_t i = 0; i < matrix.size(); ++i) {
    const auto nearest = std::min_element(matrix[i].begin(), matrix[i].end()) - matrix[i].begin();
    EXPECT_EQ(moods[static_cast<std::size_t>(nearest)].name, moods[i].name);
  }
}

TEST(Confusion, LooksOnTheBustAreNearestTheirOwnMood) {
  expect_each_look_nearest_its_own_mood(portrait());
}

TEST(Confusion, LooksOnAPersonThatNoMoodShowsAreNearestTheirOwnMood) {
  studio::Studio studio = portrait();
  studio::Subject& person = studio.subjects.front();
  person.mesh = kAssets / "scopia/mannequinMale/mannequinMale.obj";
  ASSERT_TRUE(fs::exists(person.mesh))
      << "fetch it with: tests/support/fetch_assets.sh build/assets";
  person.height = 1.75;
  person.at = {0, 0, 0};
  person.material.reset();
  expect_each_look_nearest_its_own_mood(studio);
}

}  // namespace
}  // namespace chiaro::end_to_end
