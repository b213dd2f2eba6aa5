// SPDX-License-Identifier: Apache-2.0
// A user's own profiles stand beside the studio file.
#include <algorithm>
#include <fstream>
#include <gtest/gtest.h>

#include "controller/studio/load.h"
#include "tests/support/fake_world.h"
#include "tests/support/studios.h"

namespace chiaro::studio {
namespace {

constexpr const char* kProfile = R"(profile: own/old-panel
maker: Own
model: Old panel
output: 4000 cd
optic: {rectangle: [0.3, 0.3]}
emitter: {dimmer: {cct: 3200 K}}
modes:
  1ch:
    - {controls: intensity}
)";

class OwnProfiles : public testing::Test {
 protected:
  OwnProfiles() {
    std::filesystem::create_directories(folder_.path() / "fixtures/own");
    std::ofstream(folder_.path() / "fixtures/own/old-panel.yaml") << kProfile;
    std::ofstream(file_) << support::studio_text(
        support::fixture_line("a", "own/old-panel", "1ch", 1, 1));
  }
  support::TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_.path() / "studio.yaml";
  const Folders folders_{std::filesystem::path(CHIARO_SOURCE) / "config"};
};

TEST_F(OwnProfiles, AreFoundBesideTheStudioFile) {
  const auto loaded = load_studio(file_, folders_);
  ASSERT_TRUE(loaded) << core::to_string(loaded.problems());
  EXPECT_EQ(loaded->studio.fixtures[0].profile.model, "Old panel");
}

TEST_F(OwnProfiles, CountInTheFingerprint) {
  const auto before = load_studio(file_, folders_);
  std::ofstream(folder_.path() / "fixtures/own/old-panel.yaml", std::ios::app) << "body: 0.2 m\n";
  const auto after = load_studio(file_, folders_);
  ASSERT_TRUE(before && after);
  EXPECT_NE(before->studio.fingerprint, after->studio.fingerprint);
}

TEST_F(OwnProfiles, AreListedWithTheShippedOnes) {
  Folders folders = folders_;
  folders.own = folder_.path() / "fixtures";
  const auto names = profile_names(folders);
  EXPECT_EQ(std::count(names.begin(), names.end(), "own/old-panel"), 1);
  EXPECT_EQ(std::count(names.begin(), names.end(), "generic/dimmer"), 1);
}

}  // namespace
}  // namespace chiaro::studio
