// SPDX-License-Identifier: Apache-2.0
// What a design makes of pictures that show no face, are mirrored, or are no picture of a person.
#include <gtest/gtest.h>

#include "controller/design/align.h"
#include "controller/design/colours.h"
#include "controller/studio/load.h"
#include "tests/support/fake_world.h"

namespace chiaro::design {
namespace {

ExampleGoal like(core::Picture picture) {
  ExampleGoal goal;
  goal.name = "test";
  goal.exemplar = std::move(picture);
  return goal;
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

/// The shipped studio as it stands, small pictures and few trials.
class Followed : public testing::Test {
 protected:
  Followed()
      : world(clock, network, folder.path()),
        studio(studio::load_studio(world.world.config_folder / "studios/portrait.yaml",
                                   studio::Folders{world.world.config_folder})
                   ->studio) {
    options.align = options.normalise = true;
    options.trials = 60;
    options.search_size = {32, 32};
    options.polish_size = options.full_size = {64, 64};
    options.move_stands = false;
  }
  support::TemporaryFolder folder;
  support::FakeClock clock;
  support::FakeNetwork network;
  support::FakeWorld world;
  studio::Studio studio;
  Options options;
};

TEST_F(Followed, AReferenceWithoutAFaceIsNeverReached) {
  const auto twin = geometric_layers(studio, {});
  const auto look = design(studio, **twin, like(poster()), options);
  ASSERT_TRUE(look);
  EXPECT_EQ(look->judgement.verdict, Verdict::near) << look->judgement.residual;
}

TEST_F(Followed, WhatWasDecidedOfAMirroredPictureIsKept) {
  studio.subjects.front().facing = core::radians(30);
  const auto twin = geometric_layers(studio, {});
  studio::Rig rig = studio::placed_rig(studio);
  for (core::FixtureState& state : rig.states) state.set(core::Dof::intensity, 0.05);
  rig.states[*studio.fixture_index("key")].set(core::Dof::intensity, 0.3);
  const core::Picture seen = predicted(studio, (*twin)->at({256, 256}), rig, Accuracy::exact);
  const ExampleGoal goal = like(seen);
  for (const bool decided : {true, false}) {
    options.mirrored = decided;
    EXPECT_EQ(design(studio, **twin, goal, options)->mirrored, decided);
  }
}

TEST(MatchedFace, IsLookedForInTheMiddleOfAStrip) {
  // Brought to the cascades' size as a whole it would have two and a half thousand million pixels.
  EXPECT_TRUE(faces_in(core::Plane({16, 400'000}, 0.2f)).boxes.empty());
}

}  // namespace
}  // namespace chiaro::design
