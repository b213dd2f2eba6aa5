// SPDX-License-Identifier: Apache-2.0
#include "controller/core/merge.h"

#include <gtest/gtest.h>
#include <limits>

namespace chiaro::core {
namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();

Picture grey(float value) {
  Picture picture({3, 1});
  for (Plane* p : {&picture.red, &picture.green, &picture.blue}) p->values.assign(3, value);
  return picture;
}
Plane depths(std::vector<float> values) {
  Plane plane({3, 1});
  plane.values = std::move(values);
  return plane;
}

// [I-37]
TEST(Merged, NearerPartsCoverFartherOnesAndNothingIsBlack) {
  const Picture head = grey(0.8f), table = grey(0.2f);
  const Plane at_head = depths({1, kFar, kFar}), at_table = depths({2, 2, kFar});
  const Part parts[] = {{&table, &at_table}, {&head, &at_head}};
  const auto out = merged(parts);
  ASSERT_TRUE(out);
  EXPECT_EQ(out->red.values, (std::vector<float>{0.8f, 0.2f, 0}));
  EXPECT_EQ(out->blue.values, (std::vector<float>{0.8f, 0.2f, 0}));
}

TEST(Merged, AHiddenPartIsLeftOutByItsCaller) {
  const Picture table = grey(0.2f);
  const Plane at_table = depths({2, 2, kFar});
  const Part parts[] = {{&table, &at_table}};
  EXPECT_EQ(merged(parts)->green.values, (std::vector<float>{0.2f, 0.2f, 0}));
}

TEST(Merged, RefusesPicturesFromDifferentCameras) {
  const Picture picture = grey(1);
  const Plane other({2, 1});
  const Part parts[] = {{&picture, &other}};
  EXPECT_FALSE(merged(parts));
  EXPECT_FALSE(merged({}));
}

}  // namespace
}  // namespace chiaro::core
