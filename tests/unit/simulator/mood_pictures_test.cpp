// SPDX-License-Identifier: Apache-2.0
// The shipped mood pictures as an outsider sees them: a face detector trained on photographs, and
// the marks that name each pattern of light. And drawing itself, small.
#include <algorithm>
#include <deque>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iterator>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <opencv2/objdetect.hpp>
#include <set>
#include <sstream>
#include <yaml-cpp/yaml.h>

#include "controller/core/picture_file.h"
#include "simulator/moods/draw.h"
#include "simulator/moods/mood_file.h"
#include "tests/support/fake_world.h"

namespace chiaro::simulator {
namespace {

namespace fs = std::filesystem;
const studio::Folders kFolders{fs::path(CHIARO_SOURCE) / "config"};

std::vector<std::string> moods() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(kFolders.moods()))
    if (fs::exists(entry.path() / "recipe.yaml")) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}
core::EncodedPicture picture(const std::string& mood) {
  return *core::read_picture(kFolders.moods() / mood / "picture.png");
}

std::vector<cv::Rect> faces(const core::EncodedPicture& seen, bool equalised) {
  static cv::CascadeClassifier cascade(
      "/usr/share/opencv4/haarcascades/haarcascade_frontalface_default.xml");
  cv::Mat grey(seen.size.height, seen.size.width, CV_8U);
  for (int y = 0; y < seen.size.height; ++y)
    for (int x = 0; x < seen.size.width; ++x) {
      const auto& p = seen.at(x, y);
      grey.at<std::uint8_t>(y, x) =
          static_cast<std::uint8_t>((p[0] * 54 + p[1] * 183 + p[2] * 19) >> 8);
    }
  if (equalised) cv::equalizeHist(grey, grey);
  std::vector<cv::Rect> found;
  cascade.detectMultiScale(grey, found, 1.1, 3, 0, {60, 60});
  return found;
}

/// The detector's square about the bust's face, in the shipped portrait framing.
bool is_the_face(const cv::Rect& r) {
  const double x = r.x + r.width / 2.0, y = r.y + r.height / 2.0;
  return std::abs(x - 240) < 40 && std::abs(y - 165) < 45 && r.width > 90 && r.width < 240;
}

TEST(MoodPictures, TheFaceIsFoundInEveryMoodWhoseStyleShowsBothHalves) {
  // Some hide half of the face or all of it on purpose, or turn it away, and the detector was
  // trained on whole ones that look at the camera.
  const std::set<std::string> hidden{"split",      "broad",     "short",  "rim",
                                     "silhouette", "film-noir", "horror", "low-key"};
  for (const std::string& mood : moods()) {
    if (hidden.contains(mood)) continue;
    const core::EncodedPicture seen = picture(mood);
    const std::vector<cv::Rect> plain = faces(seen, false), even = faces(seen, true);
    EXPECT_TRUE(std::any_of(plain.begin(), plain.end(), is_the_face) ||
                std::any_of(even.begin(), even.end(), is_the_face))
        << mood;
  }
}

TEST(MoodPictures, HaveOneSizeAndAFairFileSize) {
  for (const std::string& mood : moods()) {
    EXPECT_EQ(picture(mood).size, kDrawnSize) << mood;
    EXPECT_LT(fs::file_size(kFolders.moods() / mood / "picture.png"), 300'000u) << mood;
  }
}

TEST(MoodPictures, MoodFilesRepeatTheirRecipesWordsAndCarryTargets) {
  for (const std::string& mood : moods()) {
    const auto recipe = load_recipe(kFolders.moods() / mood / "recipe.yaml", kFolders);
    ASSERT_TRUE(recipe);
    const YAML::Node file = YAML::LoadFile((kFolders.moods() / mood / "mood.yaml").string());
    EXPECT_EQ(file["title"].as<std::string>(), recipe->title);
    EXPECT_EQ(file["sentence"].as<std::string>(), recipe->sentence);
    EXPECT_EQ(file["attainable"].as<bool>(), recipe->attainable);
    EXPECT_EQ(file["tags"]["pattern"].as<std::string>(), recipe->tags.pattern);
    EXPECT_EQ(file["words"].as<std::vector<std::string>>(), recipe->words);
    EXPECT_TRUE(file["exposure"] && file["white_balance"] && file["sitter_turn"]) << mood;
    const auto shares = file["targets"]["histogram"].as<std::vector<double>>();
    ASSERT_EQ(shares.size(), 256u);
    EXPECT_NEAR(std::accumulate(shares.begin(), shares.end(), 0.0), 1, 1e-2) << mood;
    for (const char* name : {"edge", "mean", "gradient", "variance", "contrast"})
      EXPECT_TRUE(file["targets"][name]) << mood << " " << name;
  }
}

TEST(MoodFile, QuotesWhatPeopleWrite) {
  Recipe recipe;
  recipe.title = "The \"film\" light: \\ soft";
  recipe.words = {"a, b", "c"};
  const YAML::Node file = YAML::Load(mood_yaml(recipe, {}));
  EXPECT_EQ(file["title"].as<std::string>(), recipe.title);
  EXPECT_EQ(file["words"].as<std::vector<std::string>>(), recipe.words);
}

/// Mean L* of the picture in a box given as fractions of it.
double lightness(const core::EncodedPicture& seen, double x0, double y0, double x1, double y1) {
  double sum = 0;
  int n = 0;
  for (int y = static_cast<int>(y0 * seen.size.height); y < static_cast<int>(y1 * seen.size.height);
       ++y)
    for (int x = static_cast<int>(x0 * seen.size.width); x < static_cast<int>(x1 * seen.size.width);
         ++x, ++n) {
      const auto& p = seen.at(x, y);
      sum += core::lightness(
          core::luminance({core::srgb_linear(p[0] / 255.0), core::srgb_linear(p[1] / 255.0),
                           core::srgb_linear(p[2] / 255.0)}));
    }
  return sum / n;
}

TEST(MoodPictures, ToneAndColourAreWhatTheirNamesSay) {
  const auto whole = [](const char* mood) { return lightness(picture(mood), 0, 0, 1, 1); };
  EXPECT_GT(whole("high-key"), 70);
  EXPECT_LT(whole("low-key"), 30);
  // Split: the cheek towards the lamp against the other.
  const core::EncodedPicture split = picture("split");
  EXPECT_GT(lightness(split, 0.44, 0.40, 0.49, 0.48) - lightness(split, 0.51, 0.40, 0.56, 0.48),
            25);
  const core::EncodedPicture golden = picture("golden-hour");
  double red = 0, blue = 0;
  for (const auto& p : golden.values) red += p[0], blue += p[2];
  EXPECT_GT(red, 1.5 * blue);
}

/// Runs chiaro-draw on the shipped config with a state folder of its own.
struct Drawing {
  support::TemporaryFolder folder;
  support::FakeClock clock;
  support::FakeNetwork network;
  support::FakeWorld fake{clock, network, folder.path()};

  ports::Exit run(std::vector<std::string> arguments) {
    fake.world.config_folder = kFolders.config;
    return run_draw(arguments, fake.world);
  }
  std::string bytes(const std::string& file) const {
    std::ifstream in(folder.path() / file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
};

TEST(Drawing, SameSeedWritesTheSameBytes) {
  std::vector<std::string> drawn;
  for (const char* threads : {"1", "2"}) {
    Drawing drawing;
    EXPECT_EQ(drawing.run({"--only", "golden-hour", "--samples", "2", "--size", "64", "48",
                           "--threads", threads, "--out", drawing.folder.path().string()}),
              ports::Exit::done)
        << drawing.fake.err.str();
    drawn.push_back(drawing.bytes("golden-hour/picture.png") +
                    drawing.bytes("golden-hour/mood.yaml"));
    EXPECT_THAT(drawn.back(), ::testing::HasSubstr("Golden hour"));
  }
  EXPECT_EQ(drawn[0], drawn[1]);
}

TEST(Drawing, NamesTheNearestMoodWhenThereIsNone) {
  Drawing drawing;
  EXPECT_EQ(drawing.run({"--only", "rembrant"}), ports::Exit::input_has_problems);
  EXPECT_THAT(drawing.fake.err.str(), ::testing::HasSubstr("did you mean 'rembrandt'"));
}

TEST(Drawing, WrongOptionIsAUsageErrorAndHelpIsNot) {
  Drawing drawing;
  EXPECT_EQ(drawing.run({"--smaples", "3"}), ports::Exit::usage);
  EXPECT_EQ(drawing.run({"--help"}), ports::Exit::done);
  EXPECT_THAT(drawing.fake.out.str(), ::testing::HasSubstr("--samples"));
}

TEST(Drawing, SaysWhereItCannotWrite) {
  Drawing drawing;
  EXPECT_EQ(drawing.run({"--only", "split", "--samples", "1", "--size", "32", "24", "--out",
                         "/proc/no/such"}),
            ports::Exit::input_has_problems);
  EXPECT_THAT(drawing.fake.err.str(), ::testing::HasSubstr("/proc/no/such/split"));
}

// ---------------------------------------------------------------------------------------------
// The Rembrandt triangle, on the geometry: direct light of the key alone, seen close.

struct CloseUp {
  core::Plane lit;  ///< direct light, 1 = the brightest of the face
  core::Grid<std::uint8_t> subject;
  studio::Camera camera;

  std::pair<int, int> pixel(core::Vec3 p) const {
    const core::Vec3 forward = core::unit(camera.look_at - camera.at);
    const core::Vec3 right = core::unit(core::cross(forward, {0, 0, 1}));
    const core::Vec3 up = core::cross(right, forward), d = p - camera.at;
    const double scale =
        lit.size.height / 2.0 / std::tan(camera.vertical_fov / 2) / core::dot(d, forward);
    return {static_cast<int>(lit.size.width / 2.0 + scale * core::dot(d, right)),
            static_cast<int>(lit.size.height / 2.0 - scale * core::dot(d, up))};
  }
};

CloseUp close_up(const StudioSet& set, const twin::Light& key) {
  CloseUp out;
  out.camera = set.studio.main_camera();
  out.camera.look_at = {0, 0, 1.535};
  out.camera.vertical_fov = core::radians(5.0);
  const auto tracer = std::make_shared<const render::Tracer>(set.scene.geometry);
  const render::View view = render::see(tracer, out.camera, {360, 360});
  out.subject = core::planes(view.buffer).subject;
  out.lit = core::luminance(
      render::layer(view, key, set.scene.exposure_gain, render::Shadows::soft).diffuse);
  const float most = *std::max_element(out.lit.values.begin(), out.lit.values.end());
  for (float& v : out.lit.values) v /= most;
  return out;
}

/// Lit pixels of the subject connected with `seed`.
std::vector<std::pair<int, int>> island(const CloseUp& face, std::pair<int, int> seed,
                                        float least) {
  core::Grid<std::uint8_t> seen(face.lit.size);
  const auto open = [&](int x, int y) {
    return x >= 0 && y >= 0 && x < seen.size.width && y < seen.size.height && !seen.at(x, y) &&
           face.subject.at(x, y) && face.lit.at(x, y) >= least;
  };
  std::vector<std::pair<int, int>> found;
  std::deque<std::pair<int, int>> todo;
  if (open(seed.first, seed.second)) {
    seen.at(seed.first, seed.second) = 1;
    todo.push_back(seed);
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

void expect_triangle(const CloseUp& face, float least) {
  const auto in_studio = [](double x, double y, double z) { return core::Vec3{x, y, z + 1.05}; };
  const auto shadow_cheek = island(face, face.pixel(in_studio(0.037, -0.075, 0.470)), least);
  const auto lit_cheek = island(face, face.pixel(in_studio(-0.037, -0.075, 0.470)), least);
  ASSERT_FALSE(shadow_cheek.empty()) << "the shadow cheek is dark";
  ASSERT_FALSE(lit_cheek.empty());
  // Closed: nowhere joined with the lit side.
  EXPECT_EQ(std::find(lit_cheek.begin(), lit_cheek.end(), shadow_cheek.front()), lit_cheek.end());
  EXPECT_GT(lit_cheek.size(), 4 * shadow_cheek.size());
  EXPECT_GT(shadow_cheek.size(), 300u) << "a patch, not a speck";
  // Between nose and cheekbone, below the eye, above the mouth's height; wide above, pointed below.
  int least_y = 10000, most_y = 0;
  for (const auto& [x, y] : shadow_cheek) {
    least_y = std::min(least_y, y);
    most_y = std::max(most_y, y);
    EXPECT_GT(x, face.pixel(in_studio(0.004, -0.1, 0.470)).first);
  }
  EXPECT_GT(least_y, face.pixel(in_studio(0.03, -0.08, 0.512)).second);
  EXPECT_LT(most_y, face.pixel(in_studio(0.03, -0.08, 0.415)).second);
  const int height = most_y - least_y + 1;
  std::vector<int> width(static_cast<std::size_t>(height));
  for (const auto& at : shadow_cheek) ++width[static_cast<std::size_t>(at.second - least_y)];
  const auto mean_width = [&](double from, double to) {
    const auto a = width.begin() + static_cast<int>(from * height),
               b = width.begin() + static_cast<int>(to * height);
    return std::accumulate(a, b, 0.0) / static_cast<double>(b - a);
  };
  EXPECT_GT(mean_width(0.15, 0.5), 1.5 * mean_width(0.7, 1.0));
}

TEST(RembrandtTriangle, IsClosedInTheShippedMood) {
  const auto recipe = load_recipe(kFolders.moods() / "rembrandt" / "recipe.yaml", kFolders);
  ASSERT_TRUE(recipe);
  const auto set = set_up(*recipe, kFolders, {});
  ASSERT_TRUE(set);
  expect_triangle(close_up(*set, set->scene.lights.front()), 0.2f);
}

TEST(RembrandtTriangle, IsClosedUnderABareLampAtFortyFiveByFortyFive) {
  const auto recipe = load_recipe(kFolders.moods() / "rembrandt" / "recipe.yaml", kFolders);
  ASSERT_TRUE(recipe);
  const auto set = set_up(*recipe, kFolders, {});
  ASSERT_TRUE(set);
  twin::Light key;
  key.position =
      core::position(set->scene.geometry->aim, {core::radians(-45), core::radians(45), 1.6});
  key.candela = 1000;
  expect_triangle(close_up(*set, key), 0.2f);
}

TEST(RembrandtTriangle, IsNotThereUnderALampInFront) {
  const auto recipe = load_recipe(kFolders.moods() / "rembrandt" / "recipe.yaml", kFolders);
  ASSERT_TRUE(recipe);
  const auto set = set_up(*recipe, kFolders, {});
  ASSERT_TRUE(set);
  twin::Light key;
  key.position = core::position(set->scene.geometry->aim, {0, core::radians(10), 1.6});
  key.candela = 1000;
  const CloseUp face = close_up(*set, key);
  const auto right = island(face, face.pixel({0.037, -0.075, 1.52}), 0.2f);
  const auto left = island(face, face.pixel({-0.037, -0.075, 1.52}), 0.2f);
  EXPECT_EQ(right.size(), left.size());  // one and the same
}

}  // namespace
}  // namespace chiaro::simulator
