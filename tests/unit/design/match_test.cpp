// SPDX-License-Identifier: Apache-2.0
// Exemplars of every kind laid on the shipped sitter. Faces are those of the shipped moods: drawn,
// so that no picture of a person is needed.
#include "controller/design/match.h"

#include <cmath>
#include <gtest/gtest.h>

#include "controller/core/picture_file.h"
#include "controller/design/moods.h"
#include "controller/design/words.h"
#include "controller/studio/load.h"
#include "tests/support/fake_world.h"

namespace chiaro::design {
namespace {

namespace fs = std::filesystem;
const fs::path kConfig = fs::path(CHIARO_SOURCE) / "config";
constexpr OurFace kOurs{{0.5, 0.484, 0.39}, true, 0};

core::Picture mood_picture(const char* name) {
  return core::linear(*core::read_picture(kConfig / "moods" / name / "picture.png"));
}
ExampleGoal like(core::Picture picture) {
  ExampleGoal goal;
  goal.name = "test";
  goal.exemplar = std::move(picture);
  return goal;
}
std::string all_of(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += word + "\n";
  return text;
}
/// Beside each other.
core::Picture pair_of(const core::Picture& a, const core::Picture& b) {
  core::Picture both({a.size().width + b.size().width, a.size().height});
  for (int y = 0; y < a.size().height; ++y)
    for (int x = 0; x < both.size().width; ++x)
      both.set(x, y, x < a.size().width ? a.at(x, y) : b.at(x - a.size().width, y));
  return both;
}
/// Black strokes in rows on white: what a page or a poster is to a camera.
core::Picture poster() {
  core::Picture page({300, 300});
  for (int y = 0; y < 300; ++y)
    for (int x = 0; x < 300; ++x) {
      const bool ink = y % 30 > 12 && (x * 7 + (y / 30) * 13) % 11 < 5 && x > 20 && x < 280;
      const double v = ink ? 0.02 : 0.9;
      page.set(x, y, {v, v, v});
    }
  return page;
}

TEST(MatchedFace, OfADrawnPictureIsFoundWhereItIs) {
  const Alignment alignment = aligned(like(mood_picture("high-key")), kOurs);
  ASSERT_EQ(alignment.by, Alignment::By::face) << all_of(alignment.words);
  EXPECT_NEAR(alignment.theirs.x, 0.5, 0.05);
  EXPECT_NEAR(alignment.theirs.y, face_of_drawn_moods().y, 0.05);
  EXPECT_NEAR(alignment.theirs.side / face_of_drawn_moods().side, 1, 0.25);
}

TEST(MatchedFace, OfSeveralTheLargestIsFollowedAndItIsSaid) {
  const core::Picture one = core::resized(mood_picture("high-key"), {320, 240});
  const Alignment alignment = aligned(like(pair_of(one, one)), kOurs);
  ASSERT_EQ(alignment.by, Alignment::By::face);
  EXPECT_NE(all_of(alignment.words).find("2 faces"), std::string::npos) << all_of(alignment.words);
}

TEST(MatchedFace, IsFoundInBlackAndWhite) {
  core::Picture grey = mood_picture("high-key");
  const core::Plane light = core::luminance(grey);
  grey.red = grey.green = grey.blue = light;
  EXPECT_EQ(aligned(like(grey), kOurs).by, Alignment::By::face);
}

TEST(MatchedFace, MissingOnAPosterWithTextIsSaid) {
  const Alignment alignment = aligned(like(poster()), kOurs);
  EXPECT_NE(alignment.by, Alignment::By::face);
  EXPECT_NE(all_of(alignment.words).find("no face was found"), std::string::npos);
}

TEST(MatchedFace, MissingInAnExtremeCropIsSaid) {
  const core::Picture cheek =
      seen_through(mood_picture("high-key"), {0.53, 0.47, 0.06}, {128, 128});
  const Alignment alignment = aligned(like(cheek), kOurs);
  EXPECT_NE(alignment.by, Alignment::By::face);
  EXPECT_NE(all_of(alignment.words).find("no face was found"), std::string::npos);
}

TEST(MatchedFace, OfTheShippedMoodsIsKnownWithoutLooking) {
  ExampleGoal goal = like(core::Picture({8, 8}));
  goal.drawn_here = true;
  EXPECT_EQ(aligned(goal, kOurs).by, Alignment::By::own_framing);
  OurFace elsewhere = kOurs;
  elsewhere.box.side = 0.15;
  const Alignment there = aligned(goal, elsewhere);
  EXPECT_EQ(there.by, Alignment::By::face);
  EXPECT_NEAR(there.window.side, face_of_drawn_moods().side / 0.15, 1e-9);
}

TEST(LikelySkin, SharesWhatIsUnusualBetweenLightAndSkin) {
  const double usual = likely_skin(0.92 * 0.36);
  EXPECT_NEAR(usual, 0.36, 1e-9);
  const double darker = likely_skin(0.92 * 0.36 / 4);  // two stops
  EXPECT_LT(darker, usual);
  EXPECT_GT(darker, usual / 4);
  EXPECT_GT(likely_skin(1), usual);
}

/// The shipped studio, small pictures and few trials.
class OnTheShippedStudio : public testing::Test {
 protected:
  OnTheShippedStudio()
      : studio(studio::load_studio(kConfig / "studios/portrait.yaml", studio::Folders{kConfig})
                   ->studio) {
    options.align = options.normalise = true;
    options.trials = 60;
    options.search_size = {32, 32};
    options.polish_size = options.full_size = {64, 64};
    options.move_stands = false;
  }
  Look look_at(const ExampleGoal& goal, double reflectance) {
    studio::Studio other = studio;
    studio::Material& material = *other.subjects.front().material;
    material.diffuse = (reflectance / core::luminance(material.diffuse)) * material.diffuse;
    GeometricOptions geometric;
    geometric.mesh_cache = folder.path();
    const auto twin = geometric_layers(other, geometric);
    return *design(other, **twin, goal, options);
  }
  support::TemporaryFolder folder;
  studio::Studio studio;
  Options options;
};

TEST_F(OnTheShippedStudio, AnotherSkinMovesNoLamp) {
  const Moods moods = load_moods(kConfig / "moods");
  const auto mood = std::find_if(moods.moods.begin(), moods.moods.end(),
                                 [](const Mood& each) { return each.name == "rembrandt"; });
  ASSERT_NE(mood, moods.moods.end());
  const ExampleGoal shipped = *goal_of(*mood, Objective::wavelet);
  ASSERT_TRUE(shipped.drawn_here);
  ExampleGoal foreign = like(mood_picture("loop"));
  for (const ExampleGoal& goal : {shipped, foreign}) {
    const Look fair = look_at(goal, 0.45);
    for (const double skin : {0.06, 0.18}) {
      const Look other = look_at(goal, skin);
      for (std::size_t i = 0; i < studio.fixtures.size(); ++i) {
        const double was = lux_at_face(studio, fair.wanted, i),
                     is = lux_at_face(studio, other.wanted, i);
        if (was < 20 && is < 20) continue;  // lx: a fortieth of the exposure
        EXPECT_LT(std::abs(std::log2(is / was)), 1.0 / 3)
            << goal.name << ", " << studio.fixtures[i].name << ", skin " << skin;
      }
    }
  }
}

TEST_F(OnTheShippedStudio, ItsOwnFaceStandsWhereTheMoodsWereDrawn) {
  GeometricOptions geometric;
  geometric.mesh_cache = folder.path();
  const auto twin = geometric_layers(studio, geometric);
  const auto face = our_face(studio, *(*twin)->at({256, 256}).geometry());
  ASSERT_TRUE(face);
  EXPECT_TRUE(face->of_the_bust);
  EXPECT_NEAR(face->box.x, face_of_drawn_moods().x, 0.01);
  EXPECT_NEAR(face->box.y, face_of_drawn_moods().y, 0.01);
  EXPECT_NEAR(face->box.side / face_of_drawn_moods().side, 1, 0.03);
}

}  // namespace
}  // namespace chiaro::design
