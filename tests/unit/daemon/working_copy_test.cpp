// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/demo/working_copy.h"

#include <fstream>
#include <gtest/gtest.h>
#include <iterator>

#include "tests/support/fake_world.h"

namespace chiaro::daemon {
namespace {

namespace fs = std::filesystem;

class WorkingCopyTest : public testing::Test {
 protected:
  static void write(const fs::path& file, const std::string& text) {
    fs::create_directories(file.parent_path());
    std::ofstream(file) << text;
  }
  static std::string read(const fs::path& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  }
  support::TemporaryFolder folder_;
  const fs::path shipped_ = folder_.path() / "config/portrait.yaml",
                 state_ = folder_.path() / "state/studio";
};

TEST_F(WorkingCopyTest, KeepsWhatWasAddedAndLeavesTheShippedFileAlone) {
  write(shipped_, "studio: as shipped\n");
  const auto first = working_copy(shipped_, state_);
  ASSERT_TRUE(first) << core::to_string(first.problems());
  EXPECT_EQ(read(*first), "studio: as shipped\n");
  write(*first, "studio: with a lamp\n");
  const auto again = working_copy(shipped_, state_);
  ASSERT_TRUE(again);
  EXPECT_EQ(*again, *first);
  EXPECT_EQ(read(*again), "studio: with a lamp\n");
  EXPECT_EQ(read(shipped_), "studio: as shipped\n");
}

TEST_F(WorkingCopyTest, StartsAfreshFromANewerShippedFile) {
  write(shipped_, "studio: old\n");
  const auto first = working_copy(shipped_, state_);
  ASSERT_TRUE(first);
  write(*first, "studio: old, with a lamp\n");
  write(shipped_, "studio: new\n");
  const auto again = working_copy(shipped_, state_);
  ASSERT_TRUE(again);
  EXPECT_EQ(read(*again), "studio: new\n");
}

TEST_F(WorkingCopyTest, SaysWhereItCannotWrite) {
  write(shipped_, "studio: as shipped\n");
  write(folder_.path() / "state", "a file where the folder should be");
  const auto copy = working_copy(shipped_, state_);
  ASSERT_FALSE(copy);
  EXPECT_NE(core::to_string(copy.problems()).find("CHIARO_STATE"), std::string::npos);
}

}  // namespace
}  // namespace chiaro::daemon
