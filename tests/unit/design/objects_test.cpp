// SPDX-License-Identifier: Apache-2.0
// Two balls, each with a spot of its own; and each lit alone, put together by depth.
#include "controller/design/objects.h"

#include <gtest/gtest.h>

#include "controller/design/geometric_layers.h"
#include "tests/support/meshes.h"
#include "tests/support/rigs.h"

namespace chiaro::design {
namespace {

class Objects : public testing::Test {
 protected:
  Objects() : studio_(support::ball_studio(folder_.path(), 3)) {
    studio::Subject right = studio_.subjects.front();
    studio_.subjects.front().name = "left";
    right.name = "right";
    studio_.subjects.front().at.x -= 0.2;
    right.at.x += 0.2;
    studio_.subjects.push_back(right);
    const auto source = geometric_layers(studio_, {});
    EXPECT_TRUE(source) << core::to_string(source.problems());
    if (source) tracer_ = tracer_of(**source);
  }
  core::Result<std::vector<ObjectGoal>> read(const std::string& text, bool lamps = true) const {
    return objects_from_json(
        text, "objects.json", studio_, ".", lamps,
        [](const std::string& mood, const std::string&, Objective) {
          return core::Result<Goal>(core::Problem{{}, "no mood " + mood, "choose another"});
        });
  }
  support::Folder folder_;
  studio::Studio studio_;
  std::shared_ptr<const render::Tracer> tracer_;
};

// [I-36]
TEST_F(Objects, EachSpotHoldsItsObjectAndSparesTheOther) {
  const auto lit = light_objects(studio_, tracer_, {{0, 0, IdealGoal{}}, {1, 1, IdealGoal{}}});
  ASSERT_TRUE(lit) << core::to_string(lit.problems());
  ASSERT_EQ(lit->objects.size(), 2u);
  for (const LitObject& object : lit->objects) {
    EXPECT_GT(object.level, 0.01) << object.object;
    EXPECT_GT(object.covered, 0.25) << object.object;
    EXPECT_LT(object.stray, 0.15) << object.object;
    EXPECT_LT(core::degrees(object.cone.angle), 30);
    EXPECT_FALSE(object.instruction.empty());
  }
  EXPECT_LT(lit->objects[0].aim_at.x, lit->objects[1].aim_at.x);
}

TEST_F(Objects, EachHasItsOwnGoal) {
  ExampleGoal dark = support::like(core::Picture({32, 32}), Objective::perceptual);
  ExampleGoal bright = dark;
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x) {
      const double shade = 0.6 + 0.3 * x / 32;
      bright.exemplar.set(x, y, {shade, shade, shade});
      dark.exemplar.set(x, y, {shade / 20, shade / 20, shade / 20});
    }
  const auto lit = light_objects(studio_, tracer_, {{0, 0, dark}, {1, 1, bright}});
  ASSERT_TRUE(lit) << core::to_string(lit.problems());
  const core::Plane light = core::luminance(lit->look.picture);
  const auto source = geometric_layers(studio_, {});
  const auto& object = (*source)->at(light.size).geometry()->object;
  double left = 0, right = 0;
  for (std::size_t i = 0; i < light.values.size(); ++i) {
    if (object.values[i] == 1) left += double{light.values[i]};
    if (object.values[i] == 2) right += double{light.values[i]};
  }
  EXPECT_GT(right, 3 * left);
}

TEST_F(Objects, OneLampForTwoAndAnUnseenObjectAreRefused) {
  const auto one = light_objects(studio_, tracer_, {{0, 0, IdealGoal{}}, {1, 0, IdealGoal{}}});
  ASSERT_FALSE(one);
  EXPECT_NE(one.problems()[0].what.find("cannot light both left and right"), std::string::npos);
  studio_.cameras.front().look_at.x += 100;
  EXPECT_FALSE(light_objects(studio_, tracer_, {{0, 0, IdealGoal{}}}));
}

// [I-37]
TEST_F(Objects, HiddenOneByOneAndMergedByDepthEachKeepsItsOwnLight) {
  ExampleGoal black = support::like(core::Picture({32, 32}), Objective::perceptual);
  Options options;
  options.search_size = options.polish_size = options.full_size = {32, 32};
  options.trials = 20;
  options.threads = 1;
  const auto merged = merge_objects(studio_, {{0, 0, black}, {1, 0, IdealGoal{}}}, {}, options);
  ASSERT_TRUE(merged) << core::to_string(merged.problems());
  ASSERT_EQ(merged->looks.size(), 2u);
  const core::Plane light = core::luminance(merged->picture);
  double left = 0, right = 0;
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x) (x < 16 ? left : right) += double{light.at(x, y)};
  EXPECT_GT(right, 3 * left);
}

TEST_F(Objects, GoalsAreReadWithEveryProblemInItsPlace) {
  const auto goals = read(R"({"objects": {"left": {"lamp": "key", "like": "ideal"}}})");
  ASSERT_TRUE(goals) << core::to_string(goals.problems());
  EXPECT_EQ(goals->at(0).subject, 0u);
  const auto bad = read(R"({"objects": {"lft": {"like": "ideal"},
 "right": {"like": {"mood": "gloom"}, "lamp": "kye"}}})");
  ASSERT_FALSE(bad);
  const std::string all = core::to_string(bad.problems());
  for (const char* each :
       {"did you mean 'left'?", "objects.json:2:29: no mood gloom", "did you mean 'key'?"})
    EXPECT_NE(all.find(each), std::string::npos) << each << " is not in\n" << all;
  EXPECT_TRUE(read(R"({"objects": {"left": {"like": "ideal"}}})", false))
      << "merging needs no lamp";
  EXPECT_FALSE(read("{}"));
}

}  // namespace
}  // namespace chiaro::design
