// SPDX-License-Identifier: Apache-2.0
// A contract over the folders: whatever is shipped loads, without a word of complaint.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>

#include "controller/studio/load.h"
#include "controller/studio/profiles/profiles.h"

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
  for (const std::string& name : profile_names(kShipped)) {
    const auto profile = load_profile(name, kShipped);
    for (const Mode& mode : profile->modes)
      for (const Channel& channel : mode.channels) bytes.push_back(channel.bytes);
  }
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

/// The first fenced example of a page.
std::string example_in(const std::filesystem::path& page) {
  std::ifstream in(page);
  const std::string text((std::istreambuf_iterator<char>(in)), {});
  const std::size_t begin = text.find("```yaml\n") + 8;
  return text.substr(begin, text.find("```", begin) - begin);
}

TEST(ShippedPages, TheirExamplesLoad) {
  const auto studio =
      parse_studio(example_in(kShipped.studios() / "README.md"), kShipped.studios(), kShipped);
  EXPECT_TRUE(studio.ok()) << core::to_string(studio.problems());
  const auto profile = profiles::parse_profile(example_in(kShipped.fixtures() / "README.md"),
                                               "maker/model-name", "README.md");
  EXPECT_TRUE(profile.ok()) << core::to_string(profile.problems());
}

}  // namespace
}  // namespace chiaro::studio
