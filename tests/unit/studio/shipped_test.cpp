// SPDX-License-Identifier: Apache-2.0
// A contract over the folders: whatever is shipped loads, without a word of complaint.
#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>

#include "controller/studio/load.h"

namespace chiaro::studio {
namespace {

const Folders kShipped{std::filesystem::path(CHIARO_SOURCE) / "config"};

TEST(ShippedProfiles, EveryOneLoadsAndCallsItselfByItsPath) {
  const auto names = profile_names(kShipped);
  ASSERT_GE(names.size(), 4u);
  for (const std::string& name : names) {
    const auto profile = load_profile(name, kShipped);
    ASSERT_TRUE(profile.ok()) << core::to_string(profile.problems());
    EXPECT_EQ(profile->name, name);
    EXPECT_FALSE(profile->modes.empty());
  }
}

TEST(ShippedProfiles, TheGenericOnesOfferEightSixteenAndTwentyFourBits) {
  std::vector<int> bytes;
  for (const std::string& name : profile_names(kShipped))
    for (const Mode& mode : load_profile(name, kShipped)->modes)
      for (const Channel& channel : mode.channels) bytes.push_back(channel.bytes);
  for (const int each : {1, 2, 3})
    EXPECT_NE(std::find(bytes.begin(), bytes.end(), each), bytes.end()) << each << " bytes";
}

TEST(ShippedStudios, EveryOneLoadsWithoutWarnings) {
  int seen = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kShipped.studios())) {
    if (entry.path().extension() != ".yaml") continue;
    const auto loaded = load_studio(entry.path(), kShipped);
    ASSERT_TRUE(loaded.ok()) << core::to_string(loaded.problems());
    EXPECT_TRUE(loaded->warnings.empty()) << core::to_string(loaded->warnings);
    ++seen;
  }
  EXPECT_GE(seen, 1);
}

}  // namespace
}  // namespace chiaro::studio
