// SPDX-License-Identifier: Apache-2.0
// A gallery on the analytic twin: looks that differ, usable ones, the same for any threads.
#include "controller/design/gallery.h"

#include <gtest/gtest.h>

#include "tests/support/analytic_layers.h"

namespace chiaro::design {
namespace {

class Galleries : public testing::Test {
 protected:
  Galleries() : studio_(support::analytic_studio()) {
    studio_.fixtures = {support::stand_lamp("key", studio::Role::key,
                                            {core::radians(-40), core::radians(30), 1.8}, 6000),
                        support::stand_lamp("fill", studio::Role::fill,
                                            {core::radians(40), core::radians(10), 2.0}, 3000),
                        support::fixed_lamp("wall", studio::Role::background, {0, 0.9, 0.2}, 500)};
    options_.looks = 5;
    options_.samples = 150;
    options_.sample_size = options_.picture_size = {32, 32};
    options_.threads = 1;
  }
  Gallery made(const GalleryOptions& options) const {
    const support::AnalyticSource twin(studio_);
    auto found = gallery(studio_, twin, options);
    EXPECT_TRUE(found) << core::to_string(found.problems());
    return found ? *std::move(found) : Gallery{};
  }
  studio::Studio studio_;
  GalleryOptions options_;
};

TEST_F(Galleries, LooksAreFartherApartThanSamplesAndStandForAllOfThem) {
  const Gallery found = made(options_);
  ASSERT_EQ(found.looks.size(), 5u);
  EXPECT_GT(found.usable, 50u);
  EXPECT_GT(found.mean_apart, 1.3 * found.mean_random);
  double share = 0;
  for (const GalleryLook& each : found.looks) {
    EXPECT_GE(each.apart, found.least_apart);
    EXPECT_GT(each.share, 0);
    share += each.share;
    for (std::size_t i = 0; i < 3; ++i) {
      const double level = each.look.wanted.states[i].get(core::Dof::intensity);
      EXPECT_GE(level, 0);
      EXPECT_LE(level, 1);
    }
  }
  EXPECT_NEAR(share, 1, 1e-9);
}

TEST_F(Galleries, AreTheSameForOneAndThreeThreads) {
  const Gallery one = made(options_);
  options_.threads = 3;
  const Gallery three = made(options_);
  ASSERT_EQ(one.looks.size(), three.looks.size());
  for (std::size_t i = 0; i < one.looks.size(); ++i)
    EXPECT_EQ(one.looks[i].look.wanted, three.looks[i].look.wanted);
}

TEST_F(Galleries, LockedLampsStayAndAllLockedIsSaid) {
  options_.locked = {"key"};
  for (const GalleryLook& each : made(options_).looks)
    EXPECT_EQ(each.look.wanted.states[0], studio::placed_rig(studio_).states[0]);
  options_.locked = {"key", "fill", "wall"};
  const support::AnalyticSource twin(studio_);
  EXPECT_FALSE(gallery(studio_, twin, options_));
}

TEST_F(Galleries, AnUnlitSubjectIsNoGallery) {
  for (auto& fixture : studio_.fixtures) fixture.limits.most = 0;
  const support::AnalyticSource twin(studio_);
  const auto none = gallery(studio_, twin, options_);
  ASSERT_FALSE(none);
  EXPECT_NE(none.problems()[0].what.find("usable picture"), std::string::npos);
}

TEST(Dispersion, ChoosesTheCornersOfASquareOutOfItsPoints) {
  std::vector<std::vector<float>> points;
  for (int y = 0; y <= 4; ++y)
    for (int x = 0; x <= 4; ++x) points.push_back({static_cast<float>(x), static_cast<float>(y)});
  auto chosen = most_dispersed(points, 4);
  std::sort(chosen.begin(), chosen.end());
  EXPECT_EQ(chosen, (std::vector<std::size_t>{0, 4, 20, 24}));
  EXPECT_EQ(most_dispersed(points, 40).size(), 25u);
  EXPECT_TRUE(most_dispersed({}, 4).empty());
}

TEST_F(Galleries, TheSheetShowsEveryLook) {
  const Gallery found = made(options_);
  const core::Picture sheet = contact_sheet(found);
  EXPECT_EQ(sheet.size(), (core::Size{3 * 38 + 6, 2 * 38 + 6}));
  EXPECT_EQ(sheet.at(6, 6), found.looks[0].look.picture.at(0, 0));
  EXPECT_EQ(sheet.at(6 + 38, 6 + 38), found.looks[4].look.picture.at(0, 0));
}

}  // namespace
}  // namespace chiaro::design
